"""What there is in a vehicle folder, for an engineer to hold against what they know of the vehicle."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.free_motions import FreeMotion, free_motions
from modeviz.errors import SolveError, VehicleError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.islands import Island, islands
from modeviz.vehicle.orientation import signs
from modeviz.vehicle.vehicle import Vehicle

FIRST_MODES = 3
"""So many of a body's elastic modes are listed."""


@dataclass(frozen=True, eq=False)
class Weighed:
    """What a body weighs and how it vibrates by itself."""

    name: str
    mass: float
    """kg, with the masses added to it."""
    center_of_gravity: Floats
    """(3,), m."""
    first_hz: tuple[float, ...] = ()
    """Of its first elastic modes."""
    orthogonality_error: float | None = None
    """How far its rigid modes are from orthogonal and alike in mass, a part of it; None: rigid."""


@dataclass(frozen=True)
class Held:
    """How far from the nearest attachment a connection holds on to a flexible body."""

    connection: str
    body: str
    attachment: str
    distance: float
    """m."""


@dataclass(frozen=True, eq=False)
class Summary:
    """What to hold against what is known of a vehicle."""

    bodies: tuple[Weighed, ...]
    total: Weighed
    held: tuple[Held, ...]
    """The farthest first."""
    islands: tuple[Island, ...]
    free: tuple[FreeMotion, ...]
    """None if they could not be found."""
    why_not: str
    """Why free motions could not be found; empty if they were."""
    front: tuple[str, ...]
    """Why the front is taken to be where x is least, and left where y is."""


def summarised(vehicle: Vehicle) -> Summary:
    """Return what there is to know of a vehicle without its answers."""
    bodies = tuple(_weighed(vehicle, body) for body in vehicle.bodies)
    free: tuple[FreeMotion, ...] = ()
    why_not = ""
    try:
        free = free_motions(assemble(vehicle))
    except (SolveError, VehicleError) as error:
        why_not = str(error)
    return Summary(
        bodies,
        _together("all", bodies),
        tuple(sorted(_held(vehicle), key=lambda held: -held.distance)),
        islands(vehicle),
        free,
        why_not,
        tuple(dict.fromkeys(sign.words for sign in signs(vehicle) if sign.is_right)),
    )


def _weighed(vehicle: Vehicle, body: Body) -> Weighed:
    center = body.center_of_gravity
    added = [Weighed(m.name, m.mass, m.position) for m in vehicle.added_masses if m.body == body.name]
    sum_ = _together(body.name, [Weighed(body.name, body.mass, center), *added])
    if not isinstance(body, FlexibleBody):
        return sum_
    moving, _ = body.rigid_fit.mass_about_center_of_gravity
    elastic = body.natural_frequency_hz[body.n_rigid : body.n_normal][:FIRST_MODES]
    error = float(np.abs(moving / body.mass - np.eye(3)).max())
    return Weighed(body.name, sum_.mass, sum_.center_of_gravity, tuple(elastic.tolist()), error)


def _together(name: str, parts: Sequence[Weighed]) -> Weighed:
    mass = sum(part.mass for part in parts)
    moments = sum((part.mass * part.center_of_gravity for part in parts), np.zeros(3))
    return Weighed(name, mass, moments / mass)


def _held(vehicle: Vehicle) -> Iterator[Held]:
    for connection in vehicle.all_connections:
        for name, point in zip(connection.bodies, connection.points, strict=True):
            body = vehicle.body(name) if name != GROUND else None
            if isinstance(body, FlexibleBody):
                at = body.nearest_attachment(point)
                distance = float(np.linalg.norm(at.position - point))
                yield Held(connection.name, name, at.name, distance)


def summary_record(summary: Summary) -> dict[str, object]:
    """The summary as JSON has it: masses in kg, places and distances in m."""
    return {
        "bodies": [_weighed_record(body) for body in summary.bodies],
        "total": _weighed_record(summary.total),
        "largest_orthogonality_error": _largest_error(summary.bodies),
        "connections": [vars(held) for held in summary.held],
        "islands": [{"bodies": list(i.bodies), "is_held": i.is_held} for i in summary.islands],
        "free_motions": None
        if summary.why_not
        else [
            {"bodies": list(f.bodies), "motion": f.motion, "is_mechanism": not f.is_whole}
            for f in summary.free
        ],
        "front": list(summary.front),
    }


def _weighed_record(body: Weighed) -> dict[str, object]:
    return {
        "name": body.name,
        "mass": body.mass,
        "center_of_gravity": body.center_of_gravity.tolist(),
        "first_hz": list(body.first_hz),
        "orthogonality_error": body.orthogonality_error,
    }


def _largest_error(bodies: Iterable[Weighed]) -> float | None:
    errors = [body.orthogonality_error for body in bodies if body.orthogonality_error is not None]
    return max(errors, default=None)
