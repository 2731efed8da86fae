"""What is asked for by its name: response points, directions, and one of few choices."""

from collections.abc import Iterable

from modeviz.analysis.results import AXIS
from modeviz.errors import ModevizError, VehicleError, unknown
from modeviz.vehicle.vehicle import Vehicle


def axis_of(direction: str) -> int:
    """Return where a direction is among x, y, z; raises VehicleError for an unknown one."""
    if direction not in AXIS:
        raise VehicleError(unknown("direction", direction, AXIS))
    return AXIS[direction]


def point_number(vehicle: Vehicle, name: str) -> int:
    """Return the number of a response point, from zero; raises VehicleError for an unknown one."""
    return number_of("response point", name, (point.name for point in vehicle.response_points))


def check_choice(kind: str, given: str, known: Iterable[str]) -> None:
    """Raises ModevizError unless what is given is one of what there is."""
    names = list(known)
    if given not in names:
        raise ModevizError(unknown(kind, given, names))


def number_of(kind: str, name: str, names: Iterable[str]) -> int:
    """Return where a name is among others, from zero.

    Raises:
        VehicleError: it is not one of them.
    """
    every = list(names)
    if name not in every:
        raise VehicleError(unknown(kind, name, every))
    return every.index(name)
