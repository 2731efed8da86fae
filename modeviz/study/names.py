"""What is asked for by its name: response points, loads and directions."""

from collections.abc import Iterable

from modeviz.analysis.results import AXIS
from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.vehicle import Vehicle


def axis_of(direction: str) -> int:
    """Return where a direction is among x, y, z; raises VehicleError for an unknown one."""
    if direction not in AXIS:
        raise VehicleError(unknown("direction", direction, AXIS))
    return AXIS[direction]


def point_number(vehicle: Vehicle, name: str) -> int:
    """Return the number of a response point, from zero; raises VehicleError for an unknown one."""
    return number_of("response point", name, (point.name for point in vehicle.response_points))


def number_of(kind: str, name: str, names: Iterable[str]) -> int:
    """Return where a name is among others, from zero.

    Raises:
        VehicleError: it is not one of them.
    """
    every = list(names)
    if name not in every:
        raise VehicleError(unknown(kind, name, every))
    return every.index(name)
