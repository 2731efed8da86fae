"""What the complex rates of a vehicle's mount springs are at each frequency."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.mount_rates import are_dampers, are_masses, rows_of_springs
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.dynamic_rates import DynamicRates
from modeviz.vehicle.vehicle import Vehicle

CONSTANT = -1
"""The column of a spring whose rate no frequency changes."""

VISCOUS = -2
"""The column of a damper: its rate is c, and it resists as a spring of the stiffness jωc."""

INERT = -3
"""That of what resists acceleration: its rate is m, the stiffness -ω²m; see `PartKind`."""


@dataclass(frozen=True, eq=False)
class SpringLaw:
    """Ratios of springs' complex rates to those they have at rates of reference.

    Arrays over frequency have one row, for all of them, where no spring depends on it.
    """

    rubbers: tuple[DynamicRates, ...]
    """Each once."""
    columns: NDArray[np.intp]
    """(n_springs,): 3 times the number of its rubber plus its axis; `CONSTANT`, `VISCOUS`, `INERT`."""

    @cached_property
    def is_constant(self) -> bool:
        """Whether no spring's rate depends on frequency; that of dampers does not count."""
        return not self.depends.any()

    @cached_property
    def depends(self) -> NDArray[np.bool_]:
        """Which springs have rates that depend on frequency, (n_springs,); no damper does."""
        return self.columns >= 0

    @cached_property
    def are_dampers(self) -> NDArray[np.bool_]:
        """Which of them are dampers, (n_springs,)."""
        return self.columns == VISCOUS

    @cached_property
    def has_dampers(self) -> bool:
        """Whether any of them is."""
        return bool(self.are_dampers.any())

    @cached_property
    def are_masses(self) -> NDArray[np.bool_]:
        """Which of them resist acceleration, (n_springs,)."""
        return self.columns == INERT

    @cached_property
    def at_reference(self) -> "SpringLaw":
        """The same of springs that keep the rates of reference at all frequencies."""
        return SpringLaw((), np.where(self.depends, CONSTANT, self.columns))

    def springs(self, rates: Complexes) -> Complexes:
        """Return rates at the reference, (..., n_springs), with zero in place of what is no spring."""
        others = self.columns < CONSTANT
        return np.where(others, 0.0, rates) if others.any() else rates

    def dampers(self, rates: Complexes) -> Floats:
        """Return the c of rates, (..., n_springs), with zero in place of springs'."""
        return np.where(self.are_dampers, rates.real, 0.0).astype(np.float64)

    def of(self, springs: NDArray[np.intp] | NDArray[np.bool_]) -> "SpringLaw":
        """Return that of some springs."""
        return replace(self, columns=self.columns[springs])

    def followed_by(self, n_others: int) -> "SpringLaw":
        """Return it with so many more, whose rates do not depend on frequency."""
        return replace(self, columns=np.append(self.columns, np.full(n_others, CONSTANT)))

    def ratios(self, frequency_hz: Array) -> Array:
        """Return complex rates in parts of those at the reference, (n_freqs or 1, n_springs)."""
        if (self.columns == CONSTANT).all():
            return np.ones((1, len(self.columns)))
        values = [rubber.ratios(frequency_hz) for rubber in self.rubbers]
        s = 2j * np.pi * np.asarray(frequency_hz)[:, None]
        return np.hstack([*values, s**2, s, np.ones_like(s)])[:, self.columns]

    def slopes(self, frequency_hz: Array) -> Array:
        """Return the derivatives of `ratios`, (n_freqs or 1, n_springs), 1/Hz."""
        if (self.columns == CONSTANT).all():
            return np.zeros((1, len(self.columns)))
        values = [rubber.ratio_slopes(frequency_hz) for rubber in self.rubbers]
        f = np.asarray(frequency_hz)[:, None]
        first = 2j * np.pi * np.ones_like(f)
        return np.hstack([*values, 2 * first**2 * f, first, 0 * first])[:, self.columns]

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
    law = connection_law(vehicle)
    columns = law.columns[rows_of_springs(vehicle)]
    columns[are_dampers(vehicle)] = VISCOUS
    columns[are_masses(vehicle)] = INERT
    return replace(law, columns=columns)
