"""What of a mount group may change and within what, as it is chosen on the page."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_FIELDS, RATE_NAMES, MountRates
from modeviz.vehicle.place_bounds import PlaceBounds
from modeviz.vehicle.problem import EVERY_RATE, UNLIMITED, DesignGroup

Ratios = Literal["limited", "fixed", "free"]

Range = tuple[float, float]
PlaceRanges = tuple[Range, Range, Range]
"""The least and the most along, or about, x, y and z."""

NOWHERE: PlaceRanges = (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)

USUAL_RATIOS = (0.25, 0.8)
"""The paper's limits, for a group that had none."""


@dataclass(frozen=True)
class GroupPlan:
    """A design group before anybody has looked whether it can be."""

    group: str
    free: frozenset[str]
    """Of the group's fields: which rates may change."""
    softest: MountRates
    stiffest: MountRates
    ratios: Ratios
    """What holds lateral and fore-aft by vertical."""
    ratio_limits: tuple[float, float]
    """Where these are limited, the least and the most."""
    offsets: PlaceRanges = NOWHERE
    """How far its mounts may be moved along x, y, z, m; twice zero: not along that."""
    angles: PlaceRanges = NOWHERE
    """How far they may be turned about them, rad, likewise."""

    def design(self, mounts: MountGroup) -> DesignGroup:
        """Return the design group for a search; what is as in the mount group is left to that.

        Raises:
            VehicleError: no direction, not all of them in fixed ratios, or limits that cannot be.
        """
        bounds, limits = (self.softest, self.stiffest), None
        if self.ratios == "limited" and self.ratio_limits != mounts.ratio_limits:
            limits = self.ratio_limits
        elif self.ratios == "free" and mounts.ratio_limits is not None:
            limits = UNLIMITED
        return DesignGroup(
            self.group,
            self._directions(mounts),
            None if bounds == mounts.bounds else bounds,
            limits,
            self.ratios == "fixed",
            _bounds(self.offsets),
            _bounds(self.angles),
        )

    def _directions(self, mounts: MountGroup) -> tuple[str, ...]:
        """What may change, as a design group calls it."""
        if self.free >= {*mounts.fields}:
            return EVERY_RATE
        return tuple(RATE_NAMES[field] for field in RATE_FIELDS if field in self.free)


def group_plan(mounts: MountGroup, design: DesignGroup) -> GroupPlan:
    """A design group as it is, for the page to change."""
    softest, stiffest = design.bounds_in(mounts.bounds)
    limits = design.ratio_limits or mounts.ratio_limits or UNLIMITED
    is_free = np.isinf(limits[1])
    return GroupPlan(
        mounts.name,
        frozenset(field for field in mounts.fields if RATE_NAMES[field] in design.directions),
        softest,
        stiffest,
        "fixed" if design.fixed_ratios else "free" if is_free else "limited",
        USUAL_RATIOS if is_free else limits,
        _ranges(design.offsets),
        _ranges(design.angles),
    )


def _ranges(bounds: PlaceBounds) -> PlaceRanges:
    x, y, z = (bounds.get(axis, (0.0, 0.0)) for axis in AXES)
    return x, y, z


def _bounds(ranges: PlaceRanges) -> PlaceBounds:
    return {axis: ends for axis, ends in zip(AXES, ranges, strict=True) if any(ends)}
