"""What the complex rates of a vehicle's mount springs are at each frequency."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.mount_rates import turning_axes
from modeviz.vehicle.arrays import Array, Complexes
from modeviz.vehicle.dynamic_rates import DynamicRates
from modeviz.vehicle.vehicle import Vehicle

CONSTANT = -1
"""The column of a spring whose rate no frequency changes."""


@dataclass(frozen=True, eq=False)
class SpringLaw:
    """Ratios of springs' complex rates to those they have at rates of reference.

    Arrays over frequency have one row, for all of them, where no spring depends on it.
    """

    rubbers: tuple[DynamicRates, ...]
    """Each once."""
    columns: NDArray[np.intp]
    """(n_springs,): 3 times the number of its rubber plus its axis, or `CONSTANT`."""

    @property
    def is_constant(self) -> bool:
        """Whether no rate depends on frequency."""
        return not self.depends.any()

    @cached_property
    def depends(self) -> NDArray[np.bool_]:
        """Which springs have rates that depend on frequency, (n_springs,)."""
        return self.columns != CONSTANT

    def of(self, springs: NDArray[np.intp] | NDArray[np.bool_]) -> "SpringLaw":
        """Return that of some springs."""
        return replace(self, columns=self.columns[springs])

    def followed_by(self, n_others: int) -> "SpringLaw":
        """Return it with so many more, whose rates do not depend on frequency."""
        return replace(self, columns=np.append(self.columns, np.full(n_others, CONSTANT)))

    def ratios(self, frequency_hz: Array) -> Array:
        """Return complex rates in parts of those at the reference, (n_freqs or 1, n_springs)."""
        if self.is_constant:
            return np.ones((1, len(self.columns)))
        values = [rubber.ratios(frequency_hz) for rubber in self.rubbers]
        return np.hstack([*values, np.ones((len(frequency_hz), 1))])[:, self.columns]

    def slopes(self, frequency_hz: Array) -> Array:
        """Return the derivatives of `ratios`, (n_freqs or 1, n_springs), 1/Hz."""
        if self.is_constant:
            return np.zeros((1, len(self.columns)))
        values = [rubber.ratio_slopes(frequency_hz) for rubber in self.rubbers]
        return np.hstack([*values, np.zeros((len(frequency_hz), 1))])[:, self.columns]

    def stiffness(self, at_reference: Complexes, frequency_hz: Array) -> Complexes:
        """Return complex rates, (n_freqs or 1, n_springs), from those at the reference."""
        return at_reference * self.ratios(frequency_hz)


def constant_law(n_springs: int) -> SpringLaw:
    """Return that of springs whose rates no frequency changes."""
    return SpringLaw((), np.full(n_springs, CONSTANT))


def connection_law(vehicle: Vehicle) -> SpringLaw:
    """Return the law of all relative motions of a vehicle's connections, six of each."""
    of_mount = [group.dynamic for group in vehicle.mount_groups for _ in group.mounts]
    rubbers = tuple({id(rubber): rubber for rubber in of_mount if rubber is not None}.values())
    first = {id(rubber): 3 * i for i, rubber in enumerate(rubbers)}
    columns = np.full((len(vehicle.all_connections), 6), CONSTANT)
    for own, rubber in zip(columns, of_mount, strict=False):
        if rubber is not None:
            own[:3] = first[id(rubber)] + np.arange(3)
    return SpringLaw(rubbers, columns.ravel())


def spring_law(vehicle: Vehicle) -> SpringLaw:
    """Return the law of a vehicle's mount springs, in the order of `mount_stiffness`."""
    law, turns = connection_law(vehicle), turning_axes(vehicle)
    columns = law.columns.reshape(-1, 6)[: len(turns)]
    return replace(law, columns=np.concatenate([columns[:, :3].ravel(), columns[:, 3:][turns]]))
