"""What there is to look at in files of other programs, and in a vehicle that is not finished."""

from collections.abc import Sequence
from pathlib import Path

from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved
from modeviz.vehicle.unfinished import unfinished
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.inspection.state import Content
from modeviz.viewer.inspection.subject import subject_of_body, subject_of_component


def content_of_files(paths: Sequence[Path]) -> Content:
    """Return the component that files of another program have.

    Raises:
        VehicleError: they cannot be read.
    """
    component = solved(read_component(paths), Wanted())
    subject = subject_of_component(component, paths[0].stem, component.units)
    files = " ".join(path.name for path in paths)
    missing = (
        "This is a component by itself: nothing holds it, and no rates can be tuned. "
        f"modeviz import {files} --output FOLDER puts it into a vehicle."
    )
    return Content(paths[0].name, (subject,), (missing,))


def content_of_vehicle(vehicle: Vehicle) -> Content:
    """Return the bodies of a vehicle, and what it lacks."""
    subjects = tuple(subject_of_body(body) for body in vehicle.bodies)
    return Content(vehicle.name, subjects, (*unfinished(vehicle), *vehicle.notes))
