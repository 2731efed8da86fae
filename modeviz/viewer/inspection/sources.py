"""Where the page of bodies has them from: files of other programs, or a vehicle folder as it stands."""

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.files.survey import survey
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved
from modeviz.vehicle.unfinished import unfinished
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.inspection.state import Content
from modeviz.viewer.inspection.subject import subject_of_body, subject_of_component

EMPTY = "This folder is empty: drop a component's files onto the page, and it becomes a vehicle."


class Source(Protocol):
    """What is opened."""

    @property
    def folder(self) -> Path | None:
        """The vehicle folder into which bodies can be put; None if there is none."""
        ...

    def read(self) -> Content:
        """Return what there is now; raises VehicleError if it cannot be read."""
        ...


@dataclass(frozen=True)
class ResultFiles:
    """The files of one component."""

    paths: tuple[Path, ...]
    folder: None = None

    def read(self) -> Content:
        """Return their component.

        Raises:
            VehicleError: they cannot be read.
        """
        component = solved(read_component(self.paths), Wanted())
        subject = subject_of_component(component, self.paths[0].stem, component.units)
        files = " ".join(path.name for path in self.paths)
        missing = (
            "This is a component by itself: nothing holds it, and no rates can be tuned. "
            f"modeviz import {files} --output FOLDER puts it into a vehicle."
        )
        return Content(self.paths[0].name, (subject,), (missing,))


@dataclass(frozen=True)
class VehicleFolder:
    """A vehicle folder, finished or not, or one that is to become one."""

    path: Path
    is_ours: bool = False
    """Whether it comes with modeviz, so that nothing is put into it."""

    @property
    def folder(self) -> Path | None:
        """The folder, if bodies can be put into it."""
        return None if self.is_ours else self.path

    def read(self) -> Content:
        """Return the bodies in it, and what it lacks.

        Raises:
            VehicleError: there is no body that could be read.
        """
        if is_empty(self.path):
            return Content(self.path.resolve().name, (), (EMPTY,))
        found = survey(self.path)
        if found.vehicle is None:
            raise VehicleError("; ".join(map(str, found.problems)))
        subjects = tuple(subject_of_body(body) for body in found.bodies)
        problems = map(str, found.problems)
        missing = (*problems, *unfinished(found.vehicle))
        if not missing:
            missing = (f"All is there: modeviz view {self.path} opens it for tuning.",)
        return Content(found.vehicle.name, subjects, (*missing, *found.vehicle.notes))


def finished_vehicle(folder: Path) -> Vehicle | None:
    """Return the vehicle in a folder; None if it is not finished, but its bodies can be looked at.

    Raises:
        VehicleError: no body in it can be read.
    """
    if is_empty(folder):
        return None
    try:
        vehicle = read_vehicle(folder)
    except VehicleError:
        if not survey(folder).bodies:
            raise
        return None
    return vehicle if vehicle.all_connections else None


def is_empty(folder: Path) -> bool:
    """Return whether there is a folder with nothing in it."""
    return folder.is_dir() and not any(folder.iterdir())
