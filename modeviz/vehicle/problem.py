"""A mount optimisation as data: which rates may change, within what, and what is to become small."""

from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, check_unique, unknown
from modeviz.vehicle.arrays import Floats, frozen
from modeviz.vehicle.decoupling import DecoupledBody
from modeviz.vehicle.load_cases import STANDING
from modeviz.vehicle.mount_rates import (
    DIRECTIONS,
    RATE_FIELDS,
    RATE_NAMES,
    RIDE_DIRECTIONS,
    Bounds,
    check_bounds,
    check_directions,
)
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.place_bounds import PlaceBounds, check_angles, check_offsets

GoalKind = Literal[
    "accelerations",
    "peak",
    "rms",
    "rating",
    "iso 2631",
    "idle",
    "forces",
    "transmissibility",
    "purity",
    "decoupling",
    "change",
]
"""What is to become small.

accelerations: the performance variables. peak: the largest of them, and of all between the first and
the last frequency of each. rms: the mean squares, on the
road, at the points and along the directions of these. rating: the combined RMS that the mean personal
rating falls with, at the driver's point. iso 2631: the vibration total value there. idle: the mean
square there over time, along all axes, while its engines idle. forces: the mean squares of mounts'
forces. transmissibility: of mounts, the mean squares of their carrying ends' accelerations over those
of the carried ones. purity: of modes of bodies on their mounts the largest part that is not in its own
direction. decoupling: what is missing of these to the purity, the band and the gaps that the vehicle
asks. change: the mean square of ln(k/k₀) of the rates that may change.
"""

VARIABLES: tuple[GoalKind, ...] = ("accelerations", "peak")
"""Goals that are made of performance variables."""

UNSHAKEN: tuple[GoalKind, ...] = ("purity", "decoupling", "change")
"""Goals that no load has a part in."""

MOUNTED: tuple[GoalKind, ...] = ("forces", "transmissibility")
"""Goals of what gets through mounts."""

UNFELT: tuple[GoalKind, ...] = (*UNSHAKEN, *MOUNTED)
"""Goals that need nobody to feel anything."""

EVERY_RATE = tuple(RATE_NAMES.values())
"""What of a mount group may change, as people call it."""

UNLIMITED = (0.0, np.inf)
"""Ratio limits that hold nothing."""


@dataclass(frozen=True, eq=False)
class DesignGroup:
    """A mount group whose rates and places may change, the same on the left and the right."""

    group: str
    directions: tuple[str, ...] = EVERY_RATE
    """Which of its tuned rates, of `EVERY_RATE`; none only of a group that may be placed otherwise."""
    bounds: Bounds | None = None
    """The softest and the stiffest; None: the mount group's, as those that both have as zero."""
    ratio_limits: tuple[float, float] | None = None
    """The least and the most that lateral and fore-aft may be of vertical; None: the mount group's,
    `UNLIMITED`: none even if that has some."""
    fixed_ratios: bool = False
    """Whether all its rates keep their ratios to each other, whatever the limits."""
    offsets: PlaceBounds = field(default_factory=dict)
    """How far it may be moved along the vehicle's axes from where it was given, m."""
    angles: PlaceBounds = field(default_factory=dict)
    """How far it may be turned about them, rad, see `Placement`."""

    def bounds_in(self, group: Bounds) -> Bounds:
        """The softest and the stiffest of every rate.

        Args:
            group: those of the mount group.
        """
        if self.bounds is None:
            return group
        unsaid = [f for f in RATE_FIELDS if not any(getattr(rates, f) for rates in self.bounds)]
        softest, stiffest = (
            replace(own, **theirs.of(unsaid)) for own, theirs in zip(self.bounds, group, strict=True)
        )
        return softest, stiffest

    def __post_init__(self) -> None:
        where = f"design group {self.group!r}"
        if self.directions or not (self.offsets or self.angles):
            check_directions(where, self.directions, EVERY_RATE)
        check_offsets(where, self.offsets)
        check_angles(where, self.angles)
        if self.fixed_ratios and not set(DIRECTIONS) <= set(self.directions):
            raise VehicleError(
                f"{where}: directions: found {', '.join(self.directions)} with fixed ratios, which "
                "change all rates together; expected all directions or no fixed ratios"
            )
        if self.bounds is not None:
            check_bounds(where, self.bounds)
        low, high = self.ratio_limits or UNLIMITED
        if (low, high) != UNLIMITED and not (0 <= low <= high < np.inf and high > 0):
            raise VehicleError(
                f"{where}: ratio limits: found {low:g} to {high:g}, expected finite numbers from zero, "
                "the lower one first"
            )


@dataclass(frozen=True, eq=False)
class Performance:
    """Performance variables: accelerations at points, under loads, at frequencies.

    Under a wheel load they are peak values, g; on a road the roots of PSDs, g/√Hz. Every load is a load
    case of its own.
    """

    frequency_hz: Floats
    """(n_freqs,), rising, above zero; of a peak the ends of a range, unless it is a single one."""
    roads: tuple[str, ...] = ()
    """Names, at the speed of the search."""
    wheel_loads: tuple[str, ...] = ()
    points: tuple[str, ...] = ()
    """Names of response points; none is all."""
    directions: tuple[str, ...] = RIDE_DIRECTIONS
    target: float = 0.0
    """The desired value of each."""
    weight: float = 1.0
    """Of each squared difference from the target."""

    def __post_init__(self) -> None:
        frozen(self, "frequency_hz", self.frequency_hz, (None,))
        check_directions("performance", self.directions)
        f = self.frequency_hz
        if not len(f) or f[0] <= 0 or (np.diff(f) <= 0).any():
            found = ", ".join(f"{value:g}" for value in f[:9]) or "none"
            raise VehicleError(
                f"performance: frequencies (frequency_hz): found {found}, expected rising values "
                "above zero"
            )
        if not self.roads and not self.wheel_loads:
            raise VehicleError("performance: found neither roads nor wheel_loads, expected one or more")
        for kind in ("roads", "wheel_loads", "points"):
            names = getattr(self, kind)
            if len(set(names)) < len(names):
                raise VehicleError(
                    f"performance: {kind}: found {', '.join(names)}, expected each of them once"
                )
        for name in ("target", "weight"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise VehicleError(f"performance: {name}: found {value}, expected zero or more")


@dataclass(frozen=True, eq=False)
class FrequencyWindow:
    """A band in which the frequency of a mode has to be, or out of which it has to stay."""

    mode: str
    """Its name."""
    low_hz: float = 0.0
    high_hz: float = np.inf
    is_inside: bool = True

    def __post_init__(self) -> None:
        if not 0 <= self.low_hz < self.high_hz:
            raise VehicleError(
                f"window of {self.mode!r}: found {self.low_hz:g} to {self.high_hz:g} Hz, expected "
                "zero or more and the lower one first"
            )
        is_open = self.low_hz == 0, np.isinf(self.high_hz)
        if self.is_inside and all(is_open):
            raise VehicleError(
                f"window of {self.mode!r}: found neither low_hz nor high_hz, expected one or both"
            )
        if not self.is_inside and any(is_open):
            raise VehicleError(
                f"window of {self.mode!r}: to stay out of a band it needs low_hz and high_hz; "
                "what lies above or below one frequency is a window to be in"
            )

    def allows(self, frequency_hz: float) -> bool:
        """Whether the mode may be there."""
        return (self.low_hz <= frequency_hz <= self.high_hz) == self.is_inside


@dataclass(frozen=True, eq=False)
class DeflectionLimit:
    """How far a mount may give under a load that stays."""

    mount: str
    """Its name."""
    direction: str
    """One of `DIRECTIONS`, along the mount's own axis."""
    most: float
    """m, to either side."""
    load_case: str = STANDING.name
    """Its name."""

    def __post_init__(self) -> None:
        where = f"deflection of {self.mount!r}"
        if self.direction not in DIRECTIONS:
            raise VehicleError(f"{where}: " + unknown("direction", self.direction, DIRECTIONS))
        if not (np.isfinite(self.most) and self.most > 0):
            raise VehicleError(f"{where}: most: found {self.most:g} m, expected more than zero")

    def allows(self, deflection: float) -> bool:
        """Whether the mount may give so much, m."""
        return abs(deflection) <= self.most


@dataclass(frozen=True, eq=False)
class Problem:
    """A mount optimisation."""

    name: str
    groups: tuple[DesignGroup, ...]
    performance: tuple[Performance, ...] = ()
    goal: GoalKind = "accelerations"
    is_normalised: bool = True
    """Whether each load case is divided by what it is with the vehicle's own rates, so that units do
    not decide; the paper adds them up as they are."""
    windows: tuple[FrequencyWindow, ...] = ()
    reference: str = ""
    """A set of rates of the vehicle that designs are compared with, or none."""
    decoupling: tuple[DecoupledBody, ...] = ()
    """Of the goals purity and decoupling; none: all motions of the vehicle's main body on mounts."""
    deflections: tuple[DeflectionLimit, ...] = ()
    """Of mounts under loads that stay."""
    mounts: tuple[MountTarget, ...] = ()
    """Of the goals forces and transmissibility; none: all mounts under what usually shakes them."""

    def __post_init__(self) -> None:
        where = f"problem {self.name!r}"
        if self.goal not in get_args(GoalKind):
            raise VehicleError(f"{where}: " + unknown("goal", self.goal, get_args(GoalKind)))
        if not self.groups:
            raise VehicleError(f"{where}: has no groups, so nothing may change; expected one or more")
        check_unique(f"{where}: design group", (g.group for g in self.groups))
        check_unique(f"{where}: decoupling of", (d.body for d in self.decoupling))
        if self.goal in VARIABLES and not any(p.weight for p in self.performance):
            raise VehicleError(
                f"{where}: performance: found none with a weight above zero, expected one or more"
            )
        for mode in {window.mode for window in self.windows}:
            inside = [w for w in self.windows if w.mode == mode and w.is_inside]
            low = max((w.low_hz for w in inside), default=0.0)
            high = min((w.high_hz for w in inside), default=np.inf)
            if low >= high:
                raise VehicleError(
                    f"{where}: windows of {mode!r}: found one from {low:g} Hz and one to {high:g} Hz, "
                    "which no frequency keeps"
                )
