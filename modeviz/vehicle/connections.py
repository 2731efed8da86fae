"""Connections: what pulls between two bodies, or between a body and the ground.

Every one is a set of one-dimensional springs and dampers along three local axes, as in the paper
(Duncan, fig. 2); the kinds differ in what they are for. All of them act in one place, the elastic
centre, to which rigid arms carry the motion of both ends: so a rigid motion of both bodies stretches
nothing, and what pulls one body pulls the other back along the same line.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal, Self, get_args

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats, frozen, frozen_places
from modeviz.vehicle.dynamic_rates import DynamicRates
from modeviz.vehicle.progressive import ForceCurve

GROUND = "ground"
"""The name, in place of a body's, of what does not move."""

DIRECTIONS = ("vertical", "lateral", "fore-aft")
"""The directions of a mount's rates: local z, y and x."""

RIDE_DIRECTIONS = ("lateral", "vertical")
"""Those in which the paper judges the ride, in the order of its figures."""

MOTIONS = ("x", "y", "z", "rx", "ry", "rz")
"""The relative motions of a connection's ends: along its local axes, then about them."""

Track = Literal["left", "right", "both"]

MIDDLE = 1e-3
"""m: a tyre that stands nearer to y = 0 is on neither side."""

RATE_FIELDS = ("vertical", "lateral", "fore_aft")
"""The fields of `MountRates` that are rates, in the order of `DIRECTIONS`."""

USUAL_RANGE = 4.0
"""How many times its rate a mount can be softer or stiffer, where nothing is said."""

USUAL_STATIC_RATIO = 1.3
"""How many times as stiff rubber is when it vibrates as under a load that stays, if nothing is said."""

UNKNOWN_RATE = 1e6
"""N/m: of a mount that has no rates."""


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

    def __post_init__(self) -> None:
        super().__post_init__()
        frozen(self, "tangent", self.tangent, (3,))


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


@dataclass(frozen=True)
class MountRates:
    """The rates with which a mount vibrates, N/m, and how much of its stiffness is damping."""

    vertical: float
    lateral: float
    fore_aft: float
    loss_factor: float | None = None
    """g of k (1 + jg); None is that of the mount's group."""

    def __post_init__(self) -> None:
        for direction, rate in zip(DIRECTIONS, self.as_tuple(), strict=True):
            if not (np.isfinite(rate) and rate >= 0):
                raise VehicleError(f"{direction} rate: found {rate} N/m, expected zero or more")
        loss = self.loss_factor
        if loss is not None and not (np.isfinite(loss) and loss >= 0):
            raise VehicleError(f"loss_factor: found {loss}, expected zero or more")

    def as_tuple(self) -> tuple[float, float, float]:
        """The rates, in the order of `DIRECTIONS`."""
        return self.vertical, self.lateral, self.fore_aft

    def local(self) -> tuple[float, float, float]:
        """The rates, in the order x, y, z."""
        return self.fore_aft, self.lateral, self.vertical


def check_bounds(where: str, bounds: tuple[MountRates, MountRates], may_be_same: bool = False) -> None:
    """Raises VehicleError unless the softest rates are below the stiffest, or the same if they may."""
    softest, stiffest = (rates.as_tuple() for rates in bounds)
    per_mm = factor("N/mm", "stiffness")
    for direction, low, high in zip(DIRECTIONS, softest, stiffest, strict=True):
        if not (low < high or (may_be_same and low == high)):
            raise VehicleError(
                f"{where}: bounds: {direction}: found {low / per_mm:g} to {high / per_mm:g} N/mm, "
                "expected the lower one first"
            )


def check_directions(where: str, directions: tuple[str, ...]) -> None:
    """Raises VehicleError unless these are some of `DIRECTIONS`, each once."""
    for direction in directions:
        if direction not in DIRECTIONS:
            raise VehicleError(f"{where}: " + unknown("direction", direction, DIRECTIONS))
    if not directions or len(set(directions)) < len(directions):
        raise VehicleError(
            f"{where}: directions: found {list(directions)}, expected some of "
            f"{', '.join(DIRECTIONS)}, each once"
        )


def usual_bounds(rates: MountRates) -> tuple[MountRates, MountRates]:
    """The softest and the stiffest of a mount of which only the rates are known.

    A quarter of each rate and four times it; a rate of zero may rise to four times the largest.
    """
    k = rates.as_tuple()
    highest = max(k) or UNKNOWN_RATE
    softest, stiffest = (rate / USUAL_RANGE for rate in k), (USUAL_RANGE * (r or highest) for r in k)
    return MountRates(*softest), MountRates(*stiffest)


Rates = Mapping[str, MountRates]
"""The rates of mount groups, by the group's name."""


Travel = Mapping[str, tuple[float, float]]
"""The least and the most deflection, m, by one of `DIRECTIONS`; positive along the local axis."""

SHARED = ("rotational_stiffness", "damping", "rotational_damping")
"""What a mount has from its group unless it has its own."""


@dataclass(frozen=True, eq=False)
class MountGroup:
    """Mounts that are tuned together, because they are the same part."""

    name: str
    """Short, "C1"."""
    label: str
    """What a person calls it, "cab front"."""
    rates: MountRates
    loss_factor: float
    bounds: tuple[MountRates, MountRates]
    """The softest and the stiffest that can be made."""
    mounts: tuple[Mount, ...]
    """Where they are; their stiffness is the group's."""
    ratio_limits: tuple[float, float] | None = None
    """The least and the most that lateral and fore-aft rates may be of the vertical one."""
    rotational_stiffness: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) about the local x, y, z of each mount that has none of its own, N m/rad; not tuned."""
    damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, along its axes, likewise, N s/m."""
    rotational_damping: Floats = field(default_factory=lambda: np.zeros(3))
    """(3,) viscous, about its axes, likewise, N m s/rad."""
    static_ratio: float = USUAL_STATIC_RATIO
    """Its rates by those under a load that stays."""
    travel: Travel = field(default_factory=dict)
    """How far its first end may go from its second, m, the least and the most, by direction."""
    curves: Mapping[str, ForceCurve] = field(default_factory=dict)
    """By direction, where a mount is progressive; each is scaled so that unloaded it has the group's
    rate by its static ratio."""
    dynamic: DynamicRates | None = None
    """How the rates along the axes of each depend on frequency; None: not at all."""

    def __post_init__(self) -> None:
        for name in SHARED:
            frozen(self, name, getattr(self, name), (3,))
        self._check_static()
        if not self.mounts:
            raise VehicleError(f"mount group {self.name!r}: has no mounts")
        if any(r.loss_factor is not None for r in (self.rates, *self.bounds)):
            raise VehicleError(
                f"mount group {self.name!r}: found a loss factor in its rates or bounds, expected it "
                "as the group's own"
            )
        check_bounds(f"mount group {self.name!r}", self.bounds)
        if self.ratio_limits is not None and not 0 <= self.ratio_limits[0] < self.ratio_limits[1]:
            raise VehicleError(
                f"mount group {self.name!r}: ratio_limits: found {self.ratio_limits}, expected the "
                "lower one first"
            )
        object.__setattr__(self, "mounts", tuple(map(self._tuned, self.mounts)))

    def _check_static(self) -> None:
        """Raises VehicleError for a ratio or a travel that no mount has."""
        where = f"mount group {self.name!r}"
        if not (np.isfinite(self.static_ratio) and self.static_ratio > 0):
            raise VehicleError(
                f"{where}: static_ratio: found {self.static_ratio:g}, expected more than zero"
            )
        for what, directions in (("travel", self.travel), ("curve", self.curves)):
            for direction in directions:
                if direction not in DIRECTIONS:
                    words = unknown("direction", direction, DIRECTIONS)
                    raise VehicleError(f"{where}: {what}: {words}")
        for direction, (least, most) in self.travel.items():
            if not least <= 0 <= most or least == most:
                raise VehicleError(
                    f"{where}: travel: {direction}: found {1e3 * least:g} to {1e3 * most:g} mm, "
                    "expected the least first, zero or below, and the most, zero or above"
                )

    @property
    def meaning(self) -> str:
        """The label where it says more than the name, else ""."""
        return "" if self.label == self.name else self.label

    @property
    def title(self) -> str:
        """Name and label: "C1  cab front"; once what is the same."""
        return f"{self.name}  {self.meaning}".rstrip()

    def _tuned(self, mount: Mount) -> Mount:
        """A mount with what its group has, and its own where it has that."""
        shared = {name: getattr(self, name) for name in SHARED if not getattr(mount, name).any()}
        return replace(
            mount,
            group=self.name,
            stiffness=mount.tangent * self.rates.local(),
            loss_factor=self.loss_factor,
            **shared,
        )

    def loss_factor_with(self, rates: MountRates) -> float:
        """The loss factor of the group with other rates."""
        return self.loss_factor if rates.loss_factor is None else rates.loss_factor

    def plain(self, rates: MountRates) -> MountRates:
        """The rates with a loss factor only if it is not the group's own."""
        is_own = rates.loss_factor == self.loss_factor
        return replace(rates, loss_factor=None) if is_own else rates

    def with_rates(self, rates: MountRates) -> "MountGroup":
        """The group with other rates; a loss factor among them becomes its own."""
        loss_factor = self.loss_factor_with(rates)
        return replace(self, rates=replace(rates, loss_factor=None), loss_factor=loss_factor)
