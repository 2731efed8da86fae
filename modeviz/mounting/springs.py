"""What mount springs do under a load that stays: straight lines, or the curves of progressive mounts.

A spring's force is f(d) = k c(d), its rate k that of the unloaded mount, and c its curve by the slope
that this has there; c(d) = d where there is none.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS
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
        if not self.curves:
            return stiffness * deflection
        c, springs = deflection.copy(), self._springs
        at, force, slopes = (
            each[self._rows, self._parts(deflection[springs])] for each in self._points
        )
        c[springs] = force + slopes * (deflection[springs] - at)
        return stiffness * c

    def tangent(self, deflection: Floats) -> Floats:
        """Return c'(d), (n_springs,): how many times as stiff each is as unloaded."""
        tangents = np.ones_like(deflection)
        if self.curves:
            springs = self._springs
            tangents[springs] = self._points[2][self._rows, self._parts(deflection[springs])]
        return tangents

    @cached_property
    def _springs(self) -> NDArray[np.intp]:
        return np.array(list(self.curves), int)

    @cached_property
    def _rows(self) -> NDArray[np.intp]:
        return np.arange(len(self.curves))

    @cached_property
    def _points(self) -> tuple[Floats, Floats, Floats]:
        """Where straight parts of curves begin, c there, and their slopes, (n_curves, n_parts) each.

        Of a curve with fewer parts than another the last is there again, where no deflection is.
        """
        n_parts = max(len(curve.deflection) for curve in self.curves.values()) - 1
        at = np.full((len(self.curves), n_parts), np.inf)
        force, slopes = np.zeros((2, len(self.curves), n_parts))
        for row, curve in enumerate(self.curves.values()):
            n = len(curve.deflection) - 1
            at[row, :n], force[row, :n] = curve.deflection[:-1], curve.force[:-1] / curve.rate
            slopes[row, :n] = curve.slopes / curve.rate
        return at, force, slopes

    def _parts(self, deflection: Floats) -> NDArray[np.intp]:
        """The number of the straight part on which each curve is, (n_curves,)."""
        return np.maximum((self._points[0] <= deflection[:, None]).sum(axis=1) - 1, 0)


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
