"""What mount springs do under a load that stays: straight lines, or the curves of progressive mounts.

A spring's force is f(d) = k c(d), its rate k that of the unloaded mount, and c its curve by the slope
that this has there; c(d) = d where there is none.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import DIRECTIONS
from modeviz.vehicle.progressive import ForceCurve
from modeviz.vehicle.vehicle import Vehicle

AXIS: dict[str, int] = dict(zip(DIRECTIONS, (2, 1, 0), strict=True))
"""Where a direction is among a mount's local x, y, z."""


@dataclass(frozen=True, eq=False)
class SpringLaws:
    """The curves of the springs that have one."""

    curves: Mapping[int, ForceCurve]
    """By the number of the mount spring."""

    def force(self, stiffness: Floats, deflection: Floats) -> Floats:
        """Return f(d), (n_springs,), N.

        Args:
            stiffness: (n_springs,), k.
            deflection: (n_springs,).
        """
        c = deflection.copy()
        for spring, curve in self.curves.items():
            c[spring] = curve.at(deflection[spring]) / curve.rate
        return stiffness * c

    def tangent(self, deflection: Floats) -> Floats:
        """Return c'(d), (n_springs,): how many times as stiff each is as unloaded."""
        slopes = np.ones_like(deflection)
        for spring, curve in self.curves.items():
            slopes[spring] = curve.slope(deflection[spring]) / curve.rate
        return slopes


def spring_laws(vehicle: Vehicle) -> SpringLaws:
    """Return what the mount springs of a vehicle do."""
    of_mounts = [group for group in vehicle.mount_groups for _ in group.mounts]
    return SpringLaws(
        {
            3 * mount + AXIS[direction]: curve
            for mount, group in enumerate(of_mounts)
            for direction, curve in group.curves.items()
        }
    )
