"""Response points put into a vehicle folder."""

from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located, quoted, unknown
from modeviz.files.folder import VEHICLE_FILE
from modeviz.files.records.record import tuples
from modeviz.files.records.vehicle import ResponsePointRecord, VehicleRecord
from modeviz.files.toml_reader import read_toml
from modeviz.formats.append import append_tables
from modeviz.formats.mounts.into_folder import Target
from modeviz.units import WRITTEN_UNITS, factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.vehicle import Vehicle


def add_response_point(folder: Path, name: str, body: str, place: str) -> Vehicle:
    """Return the vehicle of a folder with one more point at which its motion is looked at.

    Args:
        folder: of a vehicle; what stands in its vehicle.toml stays to the letter.
        name: of the point.
        body: that it is on.
        place: there: the name of an attachment, or "X,Y,Z" in the axes and the unit of length of the
            vehicle's file; "" for the centre of gravity of a rigid body.

    Raises:
        VehicleError: there is such a point, or no such body or attachment, or the place is none of the
            body; the folder is as it was then.
    """
    target = Target.of(folder)
    taken = [point.name for point in target.vehicle.response_points]
    if not name:
        raise VehicleError("response point: found no name, expected one such as 'seat'")
    if name in taken:
        raise VehicleError(
            f"response point {quoted(name)}: is there already; give this one another name"
        )
    bodies = {body.name: body for body in target.vehicle.bodies}
    if body not in bodies:
        raise VehicleError(unknown("body", body, bodies))
    with located(f"response point {quoted(name)}"):
        position = _position(target, bodies[body], place.strip())
    record = ResponsePointRecord(name=name, body=body, at=tuples(position))
    return append_tables(folder, {"response_point": [record]}, "# Where its motion is felt")


def _position(target: Target, body: Body, place: str) -> Floats:
    """A place on a body, (3,), m, in the axes of the vehicle's file."""
    if isinstance(body, FlexibleBody):
        positions = {a.name: a.position for a in body.attachments}
    else:
        positions = {"": body.center_of_gravity}
    if place in positions:
        return positions[place] @ target.axes
    try:
        numbers = np.array([float(number) for number in place.split(",")])
    except ValueError:
        numbers = np.zeros(0)
    if len(numbers) == 3 and np.isfinite(numbers).all():
        return numbers * _length(target.folder)
    if isinstance(body, FlexibleBody):
        raise VehicleError(f"{unknown('attachment', place, positions)}; or say X,Y,Z")
    raise VehicleError(f"found the place {quoted(place)}, expected X,Y,Z")


def _length(folder: Path) -> float:
    """M of the unit of length of the numbers in a vehicle's file."""
    units = read_toml(folder / VEHICLE_FILE, VehicleRecord).units
    return factor(units.get("length") or WRITTEN_UNITS["length"], "length")
