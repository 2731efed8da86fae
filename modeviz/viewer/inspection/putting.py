"""What files that a page sent become in a vehicle folder: a body, mounts or a road."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, quoted
from modeviz.files.disk import confined_to
from modeviz.formats.component import Component
from modeviz.formats.effect import check_only
from modeviz.formats.imported import ImportSettings, import_body
from modeviz.formats.mounts.imported import MountSettings, holds_mounts, read_mounts
from modeviz.formats.mounts.into_folder import Target, add_bushings
from modeviz.formats.mounts.property_file import SUFFIXES as PROPERTIES
from modeviz.formats.reading import read_component
from modeviz.formats.roads.imported import RoadSettings, holds_road, import_road
from modeviz.report.truncation import import_notes, truncation_doubts


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What the page was told of the files; texts are as the command has them."""

    name: str | None = None
    """What somebody calls it."""
    usual_name: str = "body"
    """Of a body that nobody calls anything."""
    units: str | None = None
    attach: tuple[str, ...] = ()
    pose: str | None = None
    residual: tuple[str, ...] = ()
    replace: bool = False
    """Whether a body takes the place of that of its name."""


@dataclass(frozen=True)
class Put:
    """What was put into a folder."""

    what: str
    """Such as "body cab"."""
    notes: tuple[str, ...]
    body: str = ""
    """Its name, if it is one."""


def component_in(paths: Sequence[Path]) -> Component | None:
    """Return the component of files, which can be looked at before it is put anywhere.

    Nothing outside of their folder is read. Of mounts and roads it is None.

    Raises:
        VehicleError: they cannot be read.
    """
    with confined_to(paths[0].parent):
        if holds_road(paths) or holds_mounts(paths, is_put=True):
            return None
        return read_component(paths)


def put(paths: Sequence[Path], asked: Asked, folder: Path) -> Put:
    """Return what files became that are put into a vehicle folder.

    Nothing outside of their folder and that one is read.

    Raises:
        ModevizError: they cannot be read, or do not fit to the vehicle; the folder is as it was then.
    """
    component = component_in(paths)
    if component is not None:
        return _put_body(component, asked, folder)
    path, *others = [p for p in paths if p.suffix.lower() not in PROPERTIES] or paths
    if others:
        raise VehicleError(f"found {', '.join(p.name for p in paths)}, expected one file at a time")
    return _put_road(path, asked, folder) if holds_road([path]) else _put_mounts(path, asked, folder)


def _put_body(component: Component, asked: Asked, folder: Path) -> Put:
    if tables := [text for text in asked.residual if Path(text).suffix.lower() == ".csv"]:
        raise VehicleError(f"--residual: found {quoted(tables[0])}, expected NAME=X,Y,Z")
    settings = ImportSettings(
        units=asked.units,
        attach=asked.attach,
        pose=asked.pose,
        residual=asked.residual,
        replaces=asked.replace,
    )
    imported = import_body(component, asked.name or asked.usual_name, settings, folder)
    name = imported.body.name
    return Put(f"body {name}", (*imported.notes, *import_notes(imported.body)), name)


def _put_road(path: Path, asked: Asked, folder: Path) -> Put:
    check_only(vars(asked), "a road", "name", "usual_name")
    notes: list[str] = []
    road = import_road(path, folder, RoadSettings(name=asked.name), notes.append)
    return Put(f"road {road.name}", tuple(notes))


def _put_mounts(path: Path, asked: Asked, folder: Path) -> Put:
    check_only(vars(asked), "mounts", "units", "pose", "usual_name")
    notes: list[str] = []
    target = Target.of(folder)
    with confined_to(path.parent):
        settings = MountSettings(units=asked.units, pose=asked.pose)
        bushings = read_mounts(path, settings, notes.append, target)
    vehicle = add_bushings(bushings, target, path.name)
    standing = set(truncation_doubts(target.vehicle))
    doubts = (doubt for doubt in truncation_doubts(vehicle) if doubt not in standing)
    return Put(f"{len(bushings)} connections", (*notes, *doubts))
