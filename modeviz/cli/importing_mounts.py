"""Mounts out of tables, property files and input files of Nastran, put into a vehicle folder."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError
from modeviz.formats.mounts.bushing import DIRECTIONS, Bushing
from modeviz.formats.mounts.imported import (
    MountSettings,
    is_deck_with_springs,
    put_mounts,
    read_mounts,
)
from modeviz.formats.mounts.property_file import SUFFIXES as PROPERTIES
from modeviz.formats.mounts.property_file import read_property
from modeviz.report.tables import table
from modeviz.report.truncation import truncation_doubts
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats


def springs_beside(files: Sequence[Path]) -> str | None:
    """Return what there is to say of springs in an input file that is only listed; None if nothing."""
    if not is_deck_with_springs(files):
        return None
    return f"{files[0].name}: has CBUSH or CELAS; --output and --units put them into a vehicle"


def import_mounts(files: Sequence[Path], output: Path | None, settings: MountSettings) -> None:
    """Lists the mounts of a file, or puts them into a vehicle folder.

    Raises:
        ModevizError: there are several files, or it is none of mounts, or does not fit to the vehicle.
    """
    path, *others = files
    if others:
        raise ModevizError(f"found {len(files)} files of mounts, expected one at a time")
    if path.suffix.lower() in PROPERTIES:
        import_property(path, output)
        return

    def note(text: str) -> None:
        remark(f"{path.name}: {text}")

    if output is None:
        print_result(listing(read_mounts(path, settings, note)))
        return
    bushings, vehicle = put_mounts(path, output, settings, note)
    for doubt in (*vehicle.notes, *truncation_doubts(vehicle)):
        remark(doubt)
    print_result(f"{output}: {len(bushings)} connections from {path.name}\n\n{listing(bushings)}")


def import_property(path: Path, output: Path | None) -> None:
    """Lists the rates of a property file; raises ModevizError if it is to be put into a folder."""
    if output:
        raise ModevizError(
            f"{path.name}: has rates, but neither bodies nor places; name it in the column property of "
            "a mount table"
        )
    read = read_property(path)
    rows = [[d, *_rate(read.stiffness[i], read.damping[i], i)] for i, d in enumerate(DIRECTIONS)]
    print_result(f"{path.name}\n\n{table(['direction', 'stiffness', 'damping'], rows)}")


def _rate(stiffness: float, damping: float, i: int) -> list[str]:
    if i < 3:
        return [f"{stiffness / factor('N/mm', 'stiffness'):.6g} N/mm", f"{damping:.6g} N s/m"]
    return [f"{stiffness:.6g} N m/rad", f"{damping:.6g} N m s/rad"]


def listing(bushings: Sequence[Bushing]) -> str:
    """Return bushings as a table, a line each."""
    headers = ["mount", "group", "x, y, z N/mm", "rx, ry, rz N m/rad", "loss factor"]
    rows = [
        [
            bushing.name,
            bushing.group or "not tuned",
            _numbers(bushing.stiffness[:3] / factor("N/mm", "stiffness")),
            _numbers(bushing.stiffness[3:]),
            f"{bushing.loss_factor:.3g}",
        ]
        for bushing in bushings
    ]
    return table(headers, rows)


def _numbers(values: Floats) -> str:
    return ", ".join(f"{value:.5g}" for value in np.asarray(values))
