"""Mounts out of tables, property files and input files of Nastran, put into a vehicle folder."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from modeviz.cli.news import News
from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError
from modeviz.files.mount_tables.bushing import DIRECTIONS, Bushing
from modeviz.formats.component import UnitSystem
from modeviz.formats.mounts.imported import (
    MountSettings,
    is_deck_with_springs,
    is_property,
    put_mounts,
    read_mounts,
)
from modeviz.formats.mounts.property_file import read_property
from modeviz.formats.nastran.bushings import read_bushings
from modeviz.report.tables import table
from modeviz.report.truncation import truncation_doubts
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats

OF_THE_FILE = UnitSystem("of the file", 1.0, 1.0)
"""Numbers as they stand."""


def list_springs_beside(files: Sequence[Path]) -> None:
    """Lists the springs of an input file that is only listed, in its own units; nothing if none."""
    if not is_deck_with_springs(files):
        return
    (path,) = files
    remark(f"{path.name}: has CBUSH or CELAS; --output and --units put them into a vehicle")
    try:
        bushings = read_bushings(path, OF_THE_FILE, None, (), _note_of(path))
    except ModevizError as error:  # what is wrong with them is nothing to the body
        remark(str(error))
        return
    print_result(f"\nIts springs, in its own units:\n\n{_listing(bushings, '', '')}")


def import_mounts(files: Sequence[Path], output: Path | None, settings: MountSettings) -> None:
    """Lists the mounts of a file, or puts them into a vehicle folder.

    Raises:
        ModevizError: there are several files, or it is none of mounts, or does not fit to the vehicle.
    """
    path, *others = files
    if others:
        raise ModevizError(f"found {len(files)} files of mounts, expected one at a time")
    if is_property(path):
        import_property(path, output)
        return
    note = _note_of(path)
    if output is None:
        print_result(listing(read_mounts(path, settings, note)))
        return
    news = News(output, truncation_doubts)
    bushings, vehicle = put_mounts(path, output, settings, note)
    news.tell(vehicle)
    print_result(f"{output}: {len(bushings)} connections from {path.name}\n\n{listing(bushings)}")


def _note_of(path: Path) -> Callable[[str], None]:
    """What is told of a file."""
    return lambda text: remark(f"{path.name}: {text}")


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
    """Return bushings in SI as a table, a line each."""
    return _listing(bushings, "N/mm", "N m/rad", factor("N/mm", "stiffness"))


def _listing(bushings: Sequence[Bushing], along: str, about: str, one_along: float = 1.0) -> str:
    """A table with rates in units of those names, of which the first is so many of the bushings'."""
    headers = ["mount", "group", f"x, y, z {along}", f"rx, ry, rz {about}", "loss factor"]
    rows = [
        [
            bushing.name,
            bushing.group or "not tuned",
            _numbers(bushing.stiffness[:3] / one_along),
            _numbers(bushing.stiffness[3:]),
            f"{bushing.loss_factor:.3g}",
        ]
        for bushing in bushings
    ]
    return table([header.rstrip() for header in headers], rows)


def _numbers(values: Floats) -> str:
    return ", ".join(f"{value:.5g}" for value in np.asarray(values))
