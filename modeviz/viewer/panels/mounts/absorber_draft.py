"""An absorber before it is added: where it is to sit, and how it is tuned to the mode shown."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np

from modeviz.analysis.absorbers import effective_masses, tuned_absorber
from modeviz.errors import VehicleError
from modeviz.text.wording import sentence_case
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_names import guide_name, mass_name
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.bodies import Body, RigidBody
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.design import LINKED_DIGITS

USUAL_SHARE = 0.05
"""Of what moves in the mode where it sits: a usual mass of an absorber."""

DIGITS = 3
"""Of masses that are proposed."""

ALONG = {sentence_case(direction): (direction,) for direction in DIRECTIONS} | {
    "All directions": DIRECTIONS
}

Point = tuple[float, float, float]


@dataclass(frozen=True)
class AbsorberDraft:
    """An absorber to be; what is None follows the mode that is shown."""

    body: str | None = None
    """None: the one with most of the mode's kinetic energy."""
    position: Point | None = None
    """m; None: the one of `places` that moves most."""
    directions: tuple[str, ...] | None = None
    """None: the one along which the place moves most."""
    mass: float | None = None
    """kg; None: `USUAL_SHARE` of what moves."""

    def proposed(self, solved: Solved) -> "Proposal":
        """Return it tuned to the mode of an answer, as far as it follows it."""
        vehicle, found = solved.now.prepared.vehicle, solved.followed
        body = self.body or most_moving_body(solved)
        known = [self.position] if self.position else [*places(vehicle, body).values()]
        ways = [self.directions] if self.directions else [(d,) for d in DIRECTIONS]
        moved = effective_masses(solved.now, found.mode, body, np.array(known or [(0, 0, 0)]), ways)
        place, way = np.unravel_index(np.argmin(moved), moved.shape)
        mass = float(moved[place, way])
        usual = _rounded(USUAL_SHARE * mass) if np.isfinite(mass) else None
        position = known[place] if known else (0.0, 0.0, 0.0)
        return Proposal(body, position, found.name.spoken, ways[way], mass, self.mass or usual)


@dataclass(frozen=True)
class Proposal:
    """A draft, and what it would be tuned to."""

    body: str
    position: Point
    """m."""
    mode: str
    """What the mode is called."""
    directions: tuple[str, ...]
    """Along which it would move."""
    moved: float
    """kg, what moves in it there; infinite if nothing does."""
    mass: float | None
    """kg; None: nothing says how heavy it should be."""

    @property
    def share(self) -> float | None:
        """Its mass by what moves; None if there is no such ratio."""
        return self.mass / self.moved if self.mass and np.isfinite(self.moved) else None

    def made(self, solved: Solved, name: str) -> Absorber:
        """Return the absorber.

        Raises:
            VehicleError: the mode does not move its place, or it cannot be.
        """
        if self.mass is None:
            raise VehicleError(f"absorber {name!r}: mass: missing, for {self.mode} hardly moves there")
        now, mode = solved.now, solved.followed.mode
        place = np.array(self.position)
        tuned = tuned_absorber(now, mode, name, self.body, place, self.mass, self.directions)
        stiffness = _in_a_box(tuned.stiffness_at(tuned.frequency_hz))
        hz = float(np.sqrt(stiffness / self.mass) / (2 * np.pi))
        ratio = _in_a_box(tuned.damping) / (2 * self.mass * 2 * np.pi * hz)
        return Absorber(
            name, self.body, self.position, self.mass, hz, ratio, directions=self.directions
        )


def most_moving_body(solved: Solved) -> str:
    """Return the body, but absorbers, that has most of the shown mode's kinetic energy."""
    shares, mode = solved.now.kinetic_energy, solved.followed.mode
    bodies = carrying_bodies(solved.now.prepared.vehicle)
    return max((body.name for body in bodies), key=lambda name: shares[name][mode])


def places(vehicle: Vehicle, body: str) -> dict[str, Point]:
    """Return where an absorber can sit on a body by what that is called, m."""
    found: dict[str, Point] = {}
    for name, position in _places(vehicle, vehicle.body(body)):
        x, y, z = map(float, position)
        found.setdefault(sentence_case(name), (x, y, z))
    return found


def free_absorber_name(vehicle: Vehicle) -> str:
    """Return the first of "absorber 1", "absorber 2" ... that no part is called."""
    parts = (*vehicle.bodies, *vehicle.all_connections, *vehicle.mount_groups)
    taken = {part.name for part in parts}
    names = (f"absorber {number}" for number in count(1))
    return next(n for n in names if taken.isdisjoint((n, mass_name(n), guide_name(n))))


def _places(vehicle: Vehicle, body: Body) -> Iterator[tuple[str, Any]]:
    for point in vehicle.response_points:
        if point.body == body.name:
            yield point.name, point.position
    for mount in vehicle.mounts:
        for end, position in zip(mount.bodies, mount.points, strict=True):
            if end == body.name:
                yield f"mount {mount.name}", position
    if isinstance(body, RigidBody):
        yield "centre of gravity", body.center_of_gravity
        return
    for attachment in body.attachments:
        yield attachment.name, attachment.position


def _in_a_box(rate: float) -> float:
    """A rate to as many digits as its box on the page has room for."""
    return float(f"{rate:.{LINKED_DIGITS}g}")


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def from_mm(position: Point, millimetres: Point) -> Point:
    """Return another place, mm, in m; coordinates that are the same to what a box shows stay."""
    x, y, z = (
        before if new == shown else new / 1e3
        for before, shown, new in zip(position, in_mm(position), millimetres, strict=True)
    )
    return x, y, z


def in_mm(position: Point) -> Point:
    """Return a place in mm, as a box shows it."""
    x, y, z = (round(1e3 * value, 1) for value in position)
    return x, y, z
