"""Mounts out of tables, property files and input files of Nastran, put into a vehicle folder."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError, VehicleError, quoted
from modeviz.formats.component import UNIT_SYSTEMS, UnitSystem
from modeviz.formats.mounts.bushing import DIRECTIONS, Bushing
from modeviz.formats.mounts.into_folder import Target, add_bushings
from modeviz.formats.mounts.property_file import SUFFIXES as PROPERTIES
from modeviz.formats.mounts.property_file import read_property
from modeviz.formats.mounts.sheets import EXCEL_SUFFIXES, TEXT_SUFFIXES
from modeviz.formats.mounts.table import read_mount_table
from modeviz.report.tables import table
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats

SUFFIXES = (*TEXT_SUFFIXES, *EXCEL_SUFFIXES, *PROPERTIES)
OURS = {"vertical": "z", "lateral": "y", "fore_aft": "x"}


def holds_mounts(files: Sequence[Path]) -> bool:
    """Whether what is to be imported are mounts, and no body."""
    return all(path.suffix.lower() in SUFFIXES for path in files)


def import_mounts(files: Sequence[Path], output: Path | None, units: str | None) -> None:
    """Lists the mounts of a file, or puts them into a vehicle folder.

    Raises:
        ModevizError: there are several files, or it is none of mounts, or does not fit to the vehicle.
    """
    if len(files) > 1:
        raise ModevizError(f"found {len(files)} files of mounts, expected one at a time")
    (path,) = files
    if path.suffix.lower() in PROPERTIES:
        import_property(path, output)
        return
    target = Target.of(output) if output else None
    system = _system(units)
    bushings = read_mount_table(path, system, target.named if target else OURS, _remark_of(path))
    if target is None:
        print_result(listing(bushings))
        return
    vehicle = add_bushings(bushings, target, path.name)
    for note in vehicle.notes:
        remark(note)
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


def _system(name: str | None) -> UnitSystem | None:
    if name is not None and name not in UNIT_SYSTEMS:
        raise VehicleError(f"found the units {quoted(name)}, expected one of {', '.join(UNIT_SYSTEMS)}")
    return UNIT_SYSTEMS.get(name or "")


def _remark_of(path: Path):
    return lambda note: remark(f"{path.name}: {note}")


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
