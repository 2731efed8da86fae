"""Mounts out of tables, property files and input files of Nastran, put into a vehicle folder."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.errors import ModevizError, VehicleError, located, quoted
from modeviz.formats.component import UNIT_SYSTEMS, UnitSystem
from modeviz.formats.mounts.bushing import DIRECTIONS, Bushing
from modeviz.formats.mounts.into_folder import Target, add_bushings, near_bushings
from modeviz.formats.mounts.property_file import SUFFIXES as PROPERTIES
from modeviz.formats.mounts.property_file import read_property
from modeviz.formats.mounts.sheets import EXCEL_SUFFIXES, TEXT_SUFFIXES
from modeviz.formats.mounts.table import read_mount_table
from modeviz.formats.nastran.bushings import has_bushings, read_bushings
from modeviz.formats.poses import misfit_notes, parse_pose
from modeviz.formats.reading import read_component
from modeviz.report.tables import table
from modeviz.report.truncation import truncation_doubts
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats

DECK_SUFFIXES = (".bdf", ".dat", ".nas")

SUFFIXES = (*TEXT_SUFFIXES, *EXCEL_SUFFIXES, *PROPERTIES)
OURS = {"vertical": "z", "lateral": "y", "fore_aft": "x"}


@dataclass(frozen=True, kw_only=True)
class MountOptions:
    """What is asked for of mounts."""

    files: tuple[Path, ...]
    output: Path | None
    units: str | None
    frequency: float | None
    """Hz, at which rates over frequency are taken."""
    bodies: tuple[str, ...]
    """Of the first and the second grids of an input file; none if they are to be found."""
    pose: str | None
    """Where an input file stands in the vehicle, as `parse_pose` reads it."""


def holds_mounts(files: Sequence[Path], output: Path | None) -> bool:
    """Whether what is to be imported are mounts, and no body.

    An input file of Nastran holds mounts if it is alone, has springs, and goes into a folder.
    """
    if all(path.suffix.lower() in SUFFIXES for path in files):
        return True
    return output is not None and _is_deck_with_springs(files)


def _is_deck_with_springs(files: Sequence[Path]) -> bool:
    is_deck = len(files) == 1 and files[0].suffix.lower() in DECK_SUFFIXES
    return is_deck and has_bushings(files[0])


def springs_beside(files: Sequence[Path]) -> str | None:
    """Return what there is to say of springs in an input file that is only listed; None if nothing."""
    if not _is_deck_with_springs(files):
        return None
    return f"{files[0].name}: has CBUSH or CELAS; --output and --units put them into a vehicle"


def import_mounts(options: MountOptions) -> None:
    """Lists the mounts of a file, or puts them into a vehicle folder.

    Raises:
        ModevizError: there are several files, or it is none of mounts, or does not fit to the vehicle.
    """
    path, *others = options.files
    if others:
        raise ModevizError(f"found {len(options.files)} files of mounts, expected one at a time")
    if path.suffix.lower() in PROPERTIES:
        import_property(path, options.output)
        return
    target = Target.of(options.output) if options.output else None
    bushings = _read(path, options, target)
    if target is None:
        print_result(listing(bushings))
        return
    vehicle = add_bushings(bushings, target, path.name)
    for note in (*vehicle.notes, *truncation_doubts(vehicle)):
        remark(note)
    print_result(
        f"{options.output}: {len(bushings)} connections from {path.name}\n\n{listing(bushings)}"
    )


def _read(path: Path, options: MountOptions, target: Target | None) -> tuple[Bushing, ...]:
    """The mounts of a table or an input file."""

    def note(text: str) -> None:
        remark(f"{path.name}: {text}")

    units = _system(options.units)
    if path.suffix.lower() not in DECK_SUFFIXES:
        if options.frequency is not None or options.bodies or options.pose:
            raise ModevizError(
                "--frequency, --bodies and --pose are of an input file of Nastran, and this is a table"
            )
        return read_mount_table(path, units, target.named if target else OURS, note)
    if units is None:
        raise VehicleError(
            f"{path.name}: the file doesn't say its units, and they are not guessed; say them with "
            f"--units, one of {', '.join(UNIT_SYSTEMS)}"
        )
    bushings = read_bushings(path, units, options.frequency, options.bodies, note)
    if target is None:
        return bushings
    if options.pose is not None:
        with located("--pose"):
            pose = parse_pose(options.pose, read_component([path]), units.length, target.axes)
        for text in misfit_notes(pose):
            note(text)
        bushings = tuple(bushing.moved(pose) for bushing in bushings)
    return near_bushings(bushings, target, note)


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
