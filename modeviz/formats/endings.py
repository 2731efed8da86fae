"""The endings of all files that are taken, of bodies, mounts and roads."""

from collections.abc import Sequence
from pathlib import Path

from modeviz.errors import VehicleError, quoted
from modeviz.files.meshes import READERS as MESHES
from modeviz.formats.mounts.imported import SUFFIXES as MOUNTS
from modeviz.formats.reading import ENDINGS
from modeviz.formats.roads.imported import SUFFIXES as ROADS

TAKEN = tuple(dict.fromkeys((*ENDINGS, *MOUNTS, *ROADS)))
"""Endings of the files that are read."""


def check_taken(paths: Sequence[Path]) -> None:
    """Checks that paths are named as files that are taken, or are at least of no folder.

    Raises:
        VehicleError: one is a folder, or of another kind; of meshes others say more.
    """
    for path in paths:
        if path.is_dir():
            raise VehicleError(f"{path}: is a folder, expected files that are to go into one")
        if path.suffix.lower() not in (*TAKEN, *MESHES):
            raise VehicleError(
                f"{path}: found {quoted(path.suffix)}, expected one of {', '.join(TAKEN)}"
            )
