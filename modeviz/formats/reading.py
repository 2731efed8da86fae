"""Files of other programs, read by the format that their names tell."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.disk import check_each_once
from modeviz.files.meshes import READERS as MESHES
from modeviz.formats.ansys import RESULTS, read_ansys
from modeviz.formats.component import Component
from modeviz.formats.matrices import SUFFIXES as MATRICES
from modeviz.formats.matrices import read_matrices
from modeviz.formats.nastran import SUFFIXES as NASTRAN
from modeviz.formats.nastran import has_punched_modes, read_nastran
from modeviz.formats.nastran.input_file import InputFile, read_input
from modeviz.formats.nastran.punch_modes import PUNCH
from modeviz.formats.nastran.reader import DECKS, MODES_ELSEWHERE
from modeviz.formats.universal import SUFFIXES as UNIVERSAL
from modeviz.formats.universal import read_universal

Reader = Callable[[Sequence[Path]], Component]

READERS: Mapping[str, Reader] = {
    **dict.fromkeys(UNIVERSAL, read_universal),
    **dict.fromkeys(NASTRAN, read_nastran),
    RESULTS: read_ansys,
}
"""By the ending of a file's name."""

ENDINGS = tuple(dict.fromkeys((*READERS, *MATRICES)))
"""Of all files that are read."""


def read_component(paths: Sequence[Path]) -> Component:
    """Return what files of one structure have of it, such as its geometry and its modes.

    Files with matrices may come with a file of another format that has the geometry.

    Raises:
        VehicleError: a file cannot be read, is a folder or there twice, or they are of several formats.
    """
    check_each_once(paths)
    if folders := [path for path in paths if path.is_dir()]:
        raise VehicleError(f"{folders[0]}: is a folder, expected the files of a component")
    matrices = [path for path in paths if _has_matrices(path)]
    others = [path for path in paths if path not in matrices]
    decks = others if all(path.suffix.lower() in DECKS for path in others) else []
    punched = [path for path in matrices if path.suffix.lower() == PUNCH]
    with np.errstate(invalid="ignore"):  # what is not finite is refused in the end
        inputs = [read_input(path) for path in (*decks, *punched)]
        if matrices or any(one.matrices for one in inputs) or not others:
            files = [path for path in matrices if path not in punched]
            component = read_matrices(files, _geometry(others, decks, inputs), inputs)
        elif len(decks) == 1:
            component = inputs[0].geometry(MODES_ELSEWHERE)
        else:
            component = _read_others(others)
    return replace(component, source=", ".join(path.name for path in paths))


def _has_matrices(path: Path) -> bool:
    """Whether a file is named as those with matrices, and has no modes, as a punch file may."""
    return path.suffix.lower() in MATRICES and not has_punched_modes(path)


def _geometry(
    others: Sequence[Path], decks: Sequence[Path], inputs: Sequence[InputFile]
) -> Component | None:
    """What files without matrices have; None if there are none."""
    if len(decks) == 1:
        return inputs[0].geometry()
    return _read_others(others) if others else None


def _read_others(paths: Sequence[Path]) -> Component:
    readers = {_reader(path) for path in paths}
    if len(readers) != 1:
        raise VehicleError(
            f"found {', '.join(path.name for path in paths)}, expected files of one format at a time"
        )
    return readers.pop()(paths)


def are_results(paths: Sequence[Path]) -> bool:
    """Return whether paths are named as files that can be read here, all of them and one at least."""
    return bool(paths) and all(is_read(path) and not path.is_dir() for path in paths)


def check_are_read(paths: Sequence[Path]) -> None:
    """Checks that those of paths which are files of other programs have a format that is read.

    Raises:
        VehicleError: one has not; the text says what are.
    """
    for path in paths:
        if path.is_file() and not is_read(path) and path.suffix != ".toml":
            _reader(path)


def is_read(path: Path) -> bool:
    """Return whether a file is named as one of a format that is read."""
    return path.suffix.lower() in ENDINGS


def _reader(path: Path) -> Reader:
    suffix = path.suffix.lower()
    if suffix in MESHES:
        raise VehicleError(
            f"{path}: is a mesh, which has no modes; give a component's files, and this one with --mesh"
        )
    if suffix not in READERS:
        raise VehicleError(f"{path}: found {quoted(suffix)}, expected one of {', '.join(ENDINGS)}")
    return READERS[suffix]
