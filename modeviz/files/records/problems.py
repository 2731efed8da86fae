"""The [[problem]] tables of `vehicle.toml`: mount optimisations."""

import math
from typing import Annotated, ClassVar, Literal, Self

import numpy as np
from msgspec import Meta, field

from modeviz.errors import VehicleError
from modeviz.files.records.fields import (
    AngleEnds,
    Frequency,
    LowestFrequency,
    Name,
    OffsetEnds,
    Ratio,
    RatioLimits,
)
from modeviz.files.records.place_ends import bounds_of, ends_of
from modeviz.files.records.rates import SomeRatesRecord, both_said
from modeviz.files.records.record import Record, built
from modeviz.files.schema.quantities import UNITLESS, FixedUnit, Quantity
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import Axes, DecoupledBody
from modeviz.vehicle.load_cases import STANDING
from modeviz.vehicle.mount_rates import DIRECTIONS, RIDE_DIRECTIONS
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import (
    EVERY_RATE,
    UNLIMITED,
    DeflectionLimit,
    DesignGroup,
    FrequencyWindow,
    GoalKind,
    Performance,
    Problem,
)

NO_LIMITS = "none"
"""Ratio limits that hold nothing, in a file, where no number is infinite."""


class DesignGroupRecord(Record, kw_only=True):
    """[[problem.group]]; bounds and limits that are not given are the mount group's."""

    depending: ClassVar[frozenset[str]] = frozenset(("softest", "stiffest"))

    group: Name
    directions: tuple[str, ...] = EVERY_RATE
    softest: SomeRatesRecord | None = None
    stiffest: SomeRatesRecord | None = None
    ratio_limits: RatioLimits | Literal["none"] | None = None
    fixed_ratios: bool = False
    offset: OffsetEnds | None = None
    """The least and the most along x, y, z; an axis with twice zero is none to be moved along."""
    angles: AngleEnds | None = None
    """Likewise about x, y, z."""

    @classmethod
    def of(cls, group: DesignGroup) -> Self:
        softest, stiffest = map(SomeRatesRecord.of, group.bounds) if group.bounds else (None, None)
        return cls(
            group=group.group,
            directions=group.directions,
            softest=softest,
            stiffest=stiffest,
            ratio_limits=NO_LIMITS if group.ratio_limits == UNLIMITED else group.ratio_limits,
            fixed_ratios=group.fixed_ratios,
            offset=ends_of(group.offsets),
            angles=ends_of(group.angles),
        )

    def build(self) -> DesignGroup:
        bounds = None
        if self.softest and self.stiffest:
            bounds = both_said(self.softest, self.stiffest)
        elif self.softest or self.stiffest:
            raise VehicleError("softest and stiffest: found one of them, expected both or neither")
        limits = UNLIMITED if self.ratio_limits == NO_LIMITS else self.ratio_limits
        return DesignGroup(
            self.group,
            self.directions,
            bounds,
            limits,
            self.fixed_ratios,
            bounds_of(self.offset),
            bounds_of(self.angles),
        )


MOST_FREQUENCIES = 10_000
"""Of those that a few bytes of a file can ask for."""


class SpacedRecord(Record, kw_only=True):
    """Evenly spaced frequencies, both ends included."""

    first: Frequency
    last: Frequency
    count: Annotated[int, Meta(ge=2, le=MOST_FREQUENCIES), UNITLESS]

    @classmethod
    def of(cls, frequency_hz: Floats) -> Self | None:
        """None if these are not evenly spaced, bit by bit."""
        if not 3 <= len(frequency_hz) <= MOST_FREQUENCIES:
            return None
        record = cls(
            first=float(frequency_hz[0]), last=float(frequency_hz[-1]), count=len(frequency_hz)
        )
        return record if np.array_equal(record.build(), frequency_hz) else None

    def build(self) -> Floats:
        return np.linspace(self.first, self.last, self.count)


class PerformanceRecord(Record, kw_only=True):
    """[[problem.performance]]."""

    roads: tuple[str, ...] = ()
    wheel_loads: tuple[str, ...] = ()
    frequency_hz: SpacedRecord | Annotated[tuple[float, ...], FixedUnit("Hz")]
    points: tuple[str, ...] = ()
    directions: tuple[str, ...] = RIDE_DIRECTIONS
    target: Annotated[float, Meta(ge=0), FixedUnit("g")] = 0.0
    """Under roads g/√Hz."""
    weight: Ratio = 1.0

    @classmethod
    def of(cls, performance: Performance) -> Self:
        f = performance.frequency_hz
        return cls(
            roads=performance.roads,
            wheel_loads=performance.wheel_loads,
            frequency_hz=SpacedRecord.of(f) or tuple(f.tolist()),
            points=performance.points,
            directions=performance.directions,
            target=performance.target,
            weight=performance.weight,
        )

    def build(self) -> Performance:
        f = self.frequency_hz
        return Performance(
            f.build() if isinstance(f, SpacedRecord) else np.array(f),
            self.roads,
            self.wheel_loads,
            self.points,
            self.directions,
            self.target,
            self.weight,
        )


class WindowRecord(Record, kw_only=True):
    """[[problem.window]]."""

    mode: Name
    low_hz: LowestFrequency = 0.0
    high_hz: Frequency | None = None
    inside: bool = True

    @classmethod
    def of(cls, window: FrequencyWindow) -> Self:
        high = None if math.isinf(window.high_hz) else window.high_hz
        return cls(mode=window.mode, low_hz=window.low_hz, high_hz=high, inside=window.is_inside)

    def build(self) -> FrequencyWindow:
        high = math.inf if self.high_hz is None else self.high_hz
        return FrequencyWindow(self.mode, self.low_hz, high, self.inside)


class DecoupledBodyRecord(Record, kw_only=True):
    """[[problem.decoupling]]."""

    body: Name
    motions: tuple[str, ...] = MOTIONS
    axes: Axes = "vehicle"

    @classmethod
    def of(cls, decoupled: DecoupledBody) -> Self:
        return cls(body=decoupled.body, motions=decoupled.motions, axes=decoupled.axes)

    def build(self) -> DecoupledBody:
        return DecoupledBody(self.body, self.motions, self.axes)


class DeflectionRecord(Record, kw_only=True):
    """[[problem.deflection]]."""

    mount: Name
    direction: str
    most: Annotated[float, Meta(gt=0), Quantity("length")]
    load_case: Name = STANDING.name

    @classmethod
    def of(cls, limit: DeflectionLimit) -> Self:
        return cls(
            mount=limit.mount, direction=limit.direction, most=limit.most, load_case=limit.load_case
        )

    def build(self) -> DeflectionLimit:
        return DeflectionLimit(self.mount, self.direction, self.most, self.load_case)


class MountTargetRecord(Record, kw_only=True):
    """[[problem.mount]]."""

    mounts: tuple[str, ...] = ()
    directions: tuple[str, ...] = DIRECTIONS
    loads: tuple[str, ...] = ()
    weight: Annotated[float, UNITLESS] = 1.0

    @classmethod
    def of(cls, target: MountTarget) -> Self:
        return cls(
            mounts=target.mounts,
            directions=target.directions,
            loads=target.loads,
            weight=target.weight,
        )

    def build(self) -> MountTarget:
        return MountTarget(self.mounts, self.directions, self.loads, self.weight)


class ProblemRecord(Record, kw_only=True):
    """[[problem]]."""

    name: Name
    goal: GoalKind = "accelerations"
    normalised: bool = True
    reference: str = ""
    group: list[DesignGroupRecord]
    performance: list[PerformanceRecord] = field(default_factory=list)
    window: list[WindowRecord] = field(default_factory=list)
    decoupling: list[DecoupledBodyRecord] = field(default_factory=list)
    deflection: list[DeflectionRecord] = field(default_factory=list)
    mount: list[MountTargetRecord] = field(default_factory=list)

    @classmethod
    def of(cls, problem: Problem) -> Self:
        return cls(
            name=problem.name,
            goal=problem.goal,
            normalised=problem.is_normalised,
            reference=problem.reference,
            group=[DesignGroupRecord.of(group) for group in problem.groups],
            performance=[PerformanceRecord.of(p) for p in problem.performance],
            window=[WindowRecord.of(window) for window in problem.windows],
            decoupling=[DecoupledBodyRecord.of(body) for body in problem.decoupling],
            deflection=[DeflectionRecord.of(limit) for limit in problem.deflections],
            mount=[MountTargetRecord.of(target) for target in problem.mounts],
        )

    def build(self) -> Problem:
        return Problem(
            self.name,
            built(self.group, "group", DesignGroupRecord.build),
            built(self.performance, "performance", PerformanceRecord.build),
            self.goal,
            self.normalised,
            built(self.window, "window", WindowRecord.build),
            self.reference,
            built(self.decoupling, "decoupling", DecoupledBodyRecord.build),
            built(self.deflection, "deflection", DeflectionRecord.build),
            built(self.mount, "mount", MountTargetRecord.build),
        )
