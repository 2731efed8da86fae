"""Mounts out of another program's file, in one step: what the command and the page do."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.reading import Reading, SixRates
from modeviz.files.mount_tables.table import is_mount_table, read_mount_table
from modeviz.files.sheets import EXCEL_SUFFIXES, TEXT_SUFFIXES
from modeviz.formats.component import UNIT_SYSTEMS, UnitSystem
from modeviz.formats.effect import check_only
from modeviz.formats.mounts.into_folder import Target, add_bushings, near_bushings
from modeviz.formats.mounts.property_file import SUFFIXES as PROPERTIES
from modeviz.formats.mounts.property_file import read_property
from modeviz.formats.nastran.bushings import has_bushings, read_bushings
from modeviz.formats.poses import misfit_notes, parse_pose
from modeviz.formats.reading import read_component
from modeviz.vehicle.vehicle import Vehicle

DECK_SUFFIXES = (".bdf", ".dat", ".nas")

SUFFIXES = (*TEXT_SUFFIXES, *EXCEL_SUFFIXES, *PROPERTIES)
"""Of files that hold mounts and nothing else."""

OURS = {"vertical": "z", "lateral": "y", "fore_aft": "x"}


@dataclass(frozen=True, kw_only=True)
class MountSettings:
    """How mounts are read; texts are as the command has them."""

    units: str | None = None
    """One of `UNIT_SYSTEMS`; None: as the file says."""
    frequency: float | None = None
    """Hz, at which rates over frequency are taken."""
    bodies: tuple[str, ...] = ()
    """Of the first and the second grids of an input file; none if they are to be found."""
    pose: str | None = None
    """Where an input file stands in the vehicle, as `parse_pose` reads it."""


def holds_mounts(files: Sequence[Path], is_put: bool) -> bool:
    """Return whether what is to be imported are mounts, and no body.

    Args:
        files: those given together.
        is_put: whether it goes into a folder: an input file of Nastran then holds mounts if it is
            alone and has springs.

    Raises:
        VehicleError: there is a table of mounts among files of a body.
    """
    if all(path.suffix.lower() in SUFFIXES for path in files):
        return True
    check_no_mounts(files)
    return is_put and is_deck_with_springs(files)


def check_no_mounts(files: Sequence[Path]) -> None:
    """Checks that there is no table of mounts among files that are to be those of a body.

    Raises:
        VehicleError: there is one.
    """
    for path in files:
        if path.suffix.lower() in (*TEXT_SUFFIXES, *EXCEL_SUFFIXES) and is_mount_table(path):
            raise VehicleError(
                f"{path.name}: is a table of mounts; import the bodies first, then this alone: "
                f"modeviz import {path.name} --output FOLDER"
            )


def is_property(path: Path) -> bool:
    """Return whether a file is named as one of the rates of a bushing, without places."""
    return path.suffix.lower() in PROPERTIES


def is_deck_with_springs(files: Sequence[Path]) -> bool:
    """Return whether there is one file, and that is an input file of Nastran with CBUSH or CELAS."""
    is_deck = len(files) == 1 and files[0].suffix.lower() in DECK_SUFFIXES
    return is_deck and has_bushings(files[0])


def put_mounts(
    path: Path, folder: Path, settings: MountSettings, note: Callable[[str], None]
) -> tuple[tuple[Bushing, ...], Vehicle]:
    """Return the mounts of a file and the vehicle of a folder into which they are put.

    Args:
        path: of a table or an input file.
        folder: of a vehicle that has its bodies.
        settings: how it is read.
        note: told what is taken otherwise than it stands, a sentence at a time.

    Raises:
        ModevizError: the file is none of mounts, or does not fit to the vehicle; the folder is as it
            was then.
    """
    target = Target.of(folder)
    bushings = read_mounts(path, settings, note, target)
    return bushings, add_bushings(bushings, target, path.name)


def read_mounts(
    path: Path, settings: MountSettings, note: Callable[[str], None], target: Target | None = None
) -> tuple[Bushing, ...]:
    """Return the mounts of a table or an input file; arguments and errors as `put_mounts`.

    Without a target they are as the file has them.
    """
    units = _system(settings.units)
    if path.suffix.lower() not in DECK_SUFFIXES:
        check_only(vars(settings), "a table of mounts", "units")
        named = target.named if target else OURS
        return read_mount_table(path, Reading(named, note, units.factors if units else {}, _property))
    if units is None:
        raise VehicleError(
            f"{path.name}: the file doesn't say its units, and they are not guessed; say them with "
            f"--units, one of {', '.join(UNIT_SYSTEMS)}"
        )
    bushings = read_bushings(path, units, settings.frequency, settings.bodies, note)
    if target is None:
        return bushings
    if settings.pose is not None:
        with located("--pose"):
            pose = parse_pose(settings.pose, read_component([path]), units.length, target.axes)
        for text in misfit_notes(pose):
            note(text)
        bushings = tuple(bushing.moved(pose) for bushing in bushings)
    with located(path.name):
        return near_bushings(bushings, target, note)


def _property(path: Path) -> SixRates:
    """The rates in a property file."""
    read = read_property(path)
    return read.stiffness, read.damping


def _system(name: str | None) -> UnitSystem | None:
    if name is not None and name not in UNIT_SYSTEMS:
        raise VehicleError(f"found the units {quoted(name)}, expected one of {', '.join(UNIT_SYSTEMS)}")
    return UNIT_SYSTEMS.get(name or "")
