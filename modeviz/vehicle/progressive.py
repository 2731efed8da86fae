"""Progressive mounts: force over deflection as a curve, which is stiffer the farther a mount gives."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats, frozen


@dataclass(frozen=True, eq=False)
class ForceCurve:
    """The force of a mount over its deflection under a load that stays, straight between points.

    Beyond its ends it goes on as straight. A curve that begins at nothing holds both ways.
    """

    deflection: Floats
    """(n_points,), m, rising, through zero: of the first body from the second, along the local axis."""
    force: Floats
    """(n_points,), N, rising, zero where the deflection is: what pushes it there."""

    def __post_init__(self) -> None:
        frozen(self, "deflection", self.deflection, (None,))
        frozen(self, "force", self.force, (len(self.deflection),))
        for what, values in (("deflection", self.deflection), ("force", self.force)):
            if (fault := not_rising(values)) is not None:
                before, found = values[fault - 1 : fault + 1]
                raise VehicleError(f"{what}: found {found:g} after {before:g}, expected rising values")
        if len(self.deflection) < 2:
            points = "1 point" if self.deflection.size else "0 points"
            raise VehicleError(f"found {points}, expected two or more")
        if self.deflection[0] == 0 and self.force[0] == 0:
            frozen(self, "deflection", np.r_[-self.deflection[:0:-1], self.deflection], (None,))
            frozen(self, "force", np.r_[-self.force[:0:-1], self.force], (None,))
        self._check_zero()

    def _check_zero(self) -> None:
        """Raises VehicleError unless a mount without a load is where it is."""
        if not self.deflection[0] < 0 < self.deflection[-1]:
            raise VehicleError(
                f"deflection: found {self.deflection[0]:g} to {self.deflection[-1]:g} m, expected from "
                "zero, or from below zero to above it"
            )
        at_rest = float(np.interp(0.0, self.deflection, self.force))
        if abs(at_rest) > 1e-9 * np.abs(self.force).max():
            raise VehicleError(
                f"force: found {at_rest:g} N at no deflection, expected none: deflections begin where "
                "the mount is unloaded"
            )

    @property
    def rate(self) -> float:
        """Its slope at no deflection, N/m, the mean of both sides where it has a corner there."""
        return float(self.slopes[self._part([-1e-12 * self._span, 1e-12 * self._span])].mean())

    def at(self, deflection: Floats) -> Floats:
        """Return the force at deflections of any shape, N."""
        part = self._part(deflection)
        return self.force[part] + self.slopes[part] * (deflection - self.deflection[part])

    def slope(self, deflection: Floats) -> Floats:
        """Return the tangent at deflections of any shape, N/m."""
        return self.slopes[self._part(deflection)]

    @property
    def _span(self) -> float:
        return float(np.ptp(self.deflection))

    @property
    def slopes(self) -> Floats:
        """Of its straight parts, (n_points - 1,), N/m."""
        return np.diff(self.force) / np.diff(self.deflection)

    def _part(self, deflection: ArrayLike) -> NDArray[np.intp]:
        """The number of the straight part on which deflections lie."""
        last = len(self.deflection) - 2
        return np.clip(np.searchsorted(self.deflection, deflection, side="right") - 1, 0, last)


def not_rising(values: Floats) -> int | None:
    """Return the number of the first value that is not above the one before it; None if all are."""
    faults = np.flatnonzero(np.diff(values) <= 0)
    return int(faults[0]) + 1 if faults.size else None
