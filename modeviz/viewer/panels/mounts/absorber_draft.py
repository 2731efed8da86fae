"""An absorber before it is added: where it is to sit, and how it is tuned to the mode shown."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import count
from typing import Any

import numpy as np

from modeviz.analysis.absorbers import effective_mass, tuned_absorber
from modeviz.errors import VehicleError
from modeviz.text.wording import sentence_case
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.bodies import Body, RigidBody
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Solved

USUAL_SHARE = 0.05
"""Of what moves in the mode where it sits: a usual mass of an absorber."""

DIGITS = 3
"""Of masses, frequencies and damping ratios that are proposed."""

ALONG = {sentence_case(direction): (direction,) for direction in DIRECTIONS} | {
    "All directions": DIRECTIONS
}

Point = tuple[float, float, float]


@dataclass(frozen=True)
class AbsorberDraft:
    """An absorber to be; what is None follows the mode that is shown."""

    body: str
    position: Point
    """m."""
    directions: tuple[str, ...] | None = None
    """None: the one along which the place moves most."""
    mass: float | None = None
    """kg; None: `USUAL_SHARE` of what moves."""

    def proposed(self, solved: Solved) -> "Proposal":
        """Return it tuned to the mode of an answer, as far as it follows it."""
        place, found = np.array(self.position), solved.followed

        def moved(directions: tuple[str, ...]) -> float:
            return effective_mass(solved.now, found.mode, self.body, place, directions)

        directions = self.directions or min(((d,) for d in DIRECTIONS), key=moved)
        mass = moved(directions)
        usual = _rounded(USUAL_SHARE * mass) if np.isfinite(mass) else None
        return Proposal(self, found.name.spoken, directions, mass, self.mass or usual)


@dataclass(frozen=True)
class Proposal:
    """A draft, and what it would be tuned to."""

    draft: AbsorberDraft
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
        draft = self.draft
        if self.mass is None:
            raise VehicleError(f"absorber {name!r}: mass: missing, for {self.mode} hardly moves there")
        now, mode = solved.now, solved.followed.mode
        place = np.array(draft.position)
        tuned = tuned_absorber(now, mode, name, draft.body, place, self.mass, self.directions)
        hz, ratio = _rounded(tuned.frequency_hz), _rounded(tuned.damping_ratio)
        return Absorber(
            name, draft.body, draft.position, self.mass, hz, ratio, directions=self.directions
        )


def first_draft(vehicle: Vehicle, body: str) -> AbsorberDraft:
    """Return what the form opens with: at the first place of a body."""
    return AbsorberDraft(body, next(iter(places(vehicle, body).values()), (0.0, 0.0, 0.0)))


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
    return next(n for n in names if taken.isdisjoint((n, f"{n} mass", f"{n} guide")))


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


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def placed_in_mm(draft: AbsorberDraft, millimetres: Point) -> AbsorberDraft:
    """Return a draft at another place, mm; coordinates that are the same to what a box shows stay."""
    old = in_mm(draft)
    x, y, z = (
        before if new == shown else new / 1e3
        for before, shown, new in zip(draft.position, old, millimetres, strict=True)
    )
    return replace(draft, position=(x, y, z))


def in_mm(draft: AbsorberDraft) -> Point:
    """Return the place of a draft in mm, as a box shows it."""
    x, y, z = (round(1e3 * value, 1) for value in draft.position)
    return x, y, z
