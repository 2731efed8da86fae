"""Connections: what pulls between two bodies, or between a body and the ground.

Every one is a set of one-dimensional springs and dampers along three local axes, as in the paper
(Duncan, fig. 2); the kinds differ in what they are for. All of them act in one place, the elastic
centre, to which rigid arms carry the motion of both ends: so a rigid motion of both bodies stretches
nothing, and what pulls one body pulls the other back along the same line.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, Self, get_args

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.arrays import Floats, frozen, frozen_places

GROUND = "ground"
"""The name, in place of a body's, of what does not move."""

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
"""The relative motions of a connection's ends: along its local axes, then about them."""

Track = Literal["left", "right", "both"]

MIDDLE = 1e-3
"""m: a tyre that stands nearer to y = 0 is on neither side."""


@dataclass(frozen=True, eq=False)
class Connection:
    """Springs and dampers between a point of one body and a point of another."""

    name: str
    group: str
    """Connections that are reported together: "C1", "tyres", "bolts"."""
    bodies: tuple[str, str]
    """The second may be `GROUND`."""
    points: Floats
    """(2, 3): where it holds on to each body, m."""
    stiffness: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) along the local x, y, z, N/m."""
    rotational_stiffness: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) about the local x, y, z, N m/rad."""
    damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, along the local x, y, z, N s/m."""
    rotational_damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, about the local x, y, z, N m s/rad."""
    loss_factor: float = 0.0
    """Structural damping: the stiffness is k (1 + j loss_factor)."""
    axes: Floats = field(default_factory=lambda: np.eye(3))
    """(3, 3): the local axes as rows."""
    rigid: tuple[str, ...] = ()
    """Which of `MOTIONS` there are none of, as if the stiffness were infinite."""
    elastic_center: float = 0.5
    """Where between its ends it acts: 0 at the first, 1 at the second."""

    def __post_init__(self) -> None:
        frozen_places(self, "points", self.points, (2, 3))
        for name in ("stiffness", "rotational_stiffness", "damping", "rotational_damping"):
            frozen(self, name, getattr(self, name), (3,))
            if (getattr(self, name) < 0).any():
                raise VehicleError(
                    f"connection {self.name!r}: {name}: found {getattr(self, name).tolist()}, "
                    "expected zero or more"
                )
        frozen(self, "axes", self.axes, (3, 3))
        if not np.allclose(self.axes @ self.axes.T, np.eye(3), atol=1e-6):
            raise VehicleError(
                f"connection {self.name!r}: axes: expected three orthogonal unit vectors"
            )
        if not (np.isfinite(self.loss_factor) and self.loss_factor >= 0):
            raise VehicleError(
                f"connection {self.name!r}: loss_factor: found {self.loss_factor}, "
                "expected zero or more"
            )
        if not 0 <= self.elastic_center <= 1:
            raise VehicleError(
                f"connection {self.name!r}: elastic_center: found {self.elastic_center}, expected 0 "
                "(at the first of its ends) to 1 (at the second)"
            )
        self._check_rigid()
        if self.bodies[0] == self.bodies[1]:
            raise VehicleError(f"connection {self.name!r}: joins {self.bodies[0]!r} to itself")

    @property
    def center(self) -> Floats:
        """The elastic centre, (3,), m: where it acts on both bodies."""
        first, second = self.points
        return first + self.elastic_center * (second - first)

    def _check_rigid(self) -> None:
        """Raises VehicleError unless what is rigid is some of `MOTIONS`, without a rate."""
        rates = [*self.stiffness, *self.rotational_stiffness], [*self.damping, *self.rotational_damping]
        with_rate = {m for m, k, c in zip(MOTIONS, *rates, strict=True) if k or c}
        for motion in self.rigid:
            if motion not in MOTIONS:
                raise VehicleError(
                    f"connection {self.name!r}: rigid: " + unknown("motion", motion, MOTIONS)
                )
            if motion in with_rate:
                raise VehicleError(
                    f"connection {self.name!r}: {motion} is rigid and has a rate, expected one of them"
                )


class Spring(Connection):
    """A spring, bushing or joint whose rates are not tuned."""


class Damper(Connection):
    """A shock absorber."""


class Bolt(Connection):
    """A rigid joint between two flexible bodies, a stiff spring in every direction."""


@dataclass(frozen=True, eq=False)
class Mount(Connection):
    """One rubber mount of a tunable group."""

    tangent: Floats = field(default_factory=lambda: np.ones(3))
    """(3,): how many times as stiff along its axes it is at its working point as unloaded."""
    given: Mapping[str, Floats] = field(default_factory=dict)
    """What its group gave it, by attribute; anything else than that is its own."""

    def __post_init__(self) -> None:
        super().__post_init__()
        frozen(self, "tangent", self.tangent, (3,))

    def has_own(self, attribute: str) -> bool:
        """Whether one of what a group gives, as "damping", is its own."""
        value = getattr(self, attribute)
        given = self.given.get(attribute)
        return bool(value.any()) if given is None else not np.array_equal(value, given)


@dataclass(frozen=True, eq=False)
class Rod(Connection):
    """A link with a hinge at each end: it only pulls and pushes along the line between its ends.

    Its local x is that line, whatever `axes` it is given, and it has rates along no other: see
    `between`.
    """

    def __post_init__(self) -> None:
        frozen_places(self, "points", self.points, (2, 3))
        object.__setattr__(self, "axes", _along(self.name, *self.points))
        super().__post_init__()
        turning = *self.rotational_stiffness, *self.rotational_damping
        across = *self.stiffness[1:], *self.damping[1:], *turning
        if any(across) or not set(self.rigid) <= {"x"}:
            raise VehicleError(
                f"rod {self.name!r}: found rates across the rod or about it, expected only those along "
                "it; a [[spring]] has the others"
            )

    @classmethod
    def between(
        cls,
        name: str,
        group: str,
        bodies: tuple[str, str],
        points: Floats,
        stiffness: float = 0.0,
        damping: float = 0.0,
        loss_factor: float = 0.0,
        rigid: bool = False,
    ) -> Self:
        """A rod of so much stiffness, N/m, and viscous damping, N s/m, or one of constant length.

        Raises:
            VehicleError: its ends are in one place, or something else is wrong with it.
        """
        along = np.array([1.0, 0.0, 0.0])
        return cls(
            name,
            group,
            bodies,
            points,
            stiffness=stiffness * along,
            damping=damping * along,
            loss_factor=loss_factor,
            rigid=("x",) if rigid else (),
        )


@dataclass(frozen=True, eq=False)
class Tyre(Connection):
    """A tyre: the springs between a wheel, its first end, and the road, its second."""

    elastic_center: float = 1.0
    """As any connection's, but at its patch unless told otherwise: there the road pushes."""
    wheel_center: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,), m: where radial forces and unbalance act."""
    trail: float = 0.0
    """Pneumatic trail, m: how far behind the wheel centre a lateral force acts on the ground."""
    track: Track | None = None
    """Which track of a road it runs in, "both" for their mean; None: that of its side."""

    def __post_init__(self) -> None:
        super().__post_init__()
        frozen_places(self, "wheel_center", self.wheel_center, (3,))
        if not np.isfinite(self.trail):
            raise VehicleError(f"tyre {self.name!r}: trail: found {self.trail} m")
        if self.track is not None and self.track not in get_args(Track):
            words = unknown("track", self.track, get_args(Track))
            raise VehicleError(f"tyre {self.name!r}: track: {words}")

    @property
    def lateral_force_point(self) -> Floats:
        """(3,), m: the point on the ground, the pneumatic trail behind the wheel centre."""
        x, y, _ = self.wheel_center
        return np.array([x + self.trail, y, 0.0])

    @property
    def is_in_the_middle(self) -> bool:
        """Whether it stands between the tracks, on neither side."""
        return abs(float(self.points[1, 1])) < MIDDLE

    @property
    def side(self) -> Track:
        """The track in which it runs: the one it says, else that of its side, left where y < 0."""
        on_side = "left" if self.points[1, 1] < 0 else "right"
        return self.track or ("both" if self.is_in_the_middle else on_side)


def _along(rod: str, first: Floats, second: Floats) -> Floats:
    """Axes (3, 3) whose x runs from the first end of a rod to the second.

    Raises:
        VehicleError: they are in one place.
    """
    line = second - first
    length = np.linalg.norm(line)
    if not length > np.finfo(float).eps * np.abs([first, second]).max():
        raise VehicleError(
            f"rod {rod!r}: found both ends at {first.tolist()}, expected two places: it acts along the "
            "line between them"
        )
    x = line / length
    y = np.cross(np.eye(3)[np.argmin(np.abs(x))], x)
    y /= np.linalg.norm(y)
    return np.stack([x, y, np.cross(x, y)])
