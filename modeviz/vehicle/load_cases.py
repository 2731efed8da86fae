"""Load cases: what presses on a vehicle that stands still, in which its mounts sag and travel."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats, frozen, frozen_places
from modeviz.vehicle.bodies import Body

WEIGHT = (0.0, 0.0, -1.0)
"""In g: what everything weighs at rest."""


@dataclass(frozen=True, eq=False)
class StaticLoad:
    """A force and a torque on one body."""

    body: str
    force: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,), N."""
    torque: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,), N m."""
    position: Floats | None = None
    """(3,), m, where the force acts; None: at the body's centre of gravity."""

    def __post_init__(self) -> None:
        frozen(self, "force", self.force, (3,))
        frozen(self, "torque", self.torque, (3,))
        if self.position is not None:
            frozen_places(self, "position", self.position, (3,))


@dataclass(frozen=True, eq=False)
class LoadCase:
    """What acts on a vehicle at once."""

    name: str
    load_g: Floats = field(default_factory=lambda: np.array(WEIGHT))
    """(3,): what all mass weighs along x, y, z, in g; against an acceleration, with it a fall.

    At rest it is `WEIGHT`, on brakes that slow it down by 1 g (-1, 0, -1)."""
    loads: tuple[StaticLoad, ...] = ()
    """On single bodies."""

    def __post_init__(self) -> None:
        frozen(self, "load_g", self.load_g, (3,))
        if not (self.load_g.any() or any(x.force.any() or x.torque.any() for x in self.loads)):
            raise VehicleError(f"load case {self.name!r}: nothing acts in it, expected a load")


STANDING = LoadCase("standing")
"""Its weight alone: where it is when it is driven, and vibrates about."""

USUAL_CASES = (
    STANDING,
    LoadCase("bump 3 g", np.array([0.0, 0.0, -3.0])),
    LoadCase("rebound 1 g", np.array([0.0, 0.0, 1.0])),
    LoadCase("braking 1 g", np.array([-1.0, 0.0, -1.0])),
    LoadCase("cornering left 1 g", np.array([0.0, 1.0, -1.0])),
    LoadCase("cornering right 1 g", np.array([0.0, -1.0, -1.0])),
)
"""Of a vehicle that says none: the loads in g that suspension and mount designers begin with."""


USUAL_TORQUE = 1000.0
"""N m: about a crank, forward and back; forces in mounts rise with it."""


def usual_cases(bodies: Iterable[Body]) -> tuple[LoadCase, ...]:
    """Return the load cases of a vehicle that says none: `USUAL_CASES`, and torques about cranks."""
    return (*USUAL_CASES, *(case for body in bodies for case in _torques(body)))


def _torques(body: Body) -> Iterator[LoadCase]:
    """A torque about the body's crank one way and the other, if it says where that lies."""
    if body.crank_axis is not None:
        for sign, word in ((1, "+"), (-1, "-")):
            torque = StaticLoad(body.name, torque=sign * USUAL_TORQUE * body.crank_axis)
            yield LoadCase(f"{body.name} torque {word}{USUAL_TORQUE:g} N m", loads=(torque,))
