"""Rubber parts as they come: every mount a little harder or softer than its group's rates say."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.preparation import PreparedModes
from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True)
class Tolerance:
    """How far a part may be from its drawing, as a fraction of what stands there; 0 is as drawn."""

    rates: float = 0.15
    """Of the stiffness of a mount, all of which its hardness moves together; dampers are as drawn."""
    loss_factor: float = 0.30

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0 <= value < 1:
                raise VehicleError(
                    f"tolerance of {name.replace('_', ' ')}: found {value:g}, expected a fraction "
                    "from 0 to below 1, such as 0.15"
                )
        if not any(vars(self).values()):
            raise VehicleError("tolerance: found 0 for all, which scatters nothing")


@dataclass(frozen=True, eq=False)
class Parts:
    """The mount springs of a vehicle whose parts scatter.

    Deviations, -1 to 1, say where in its tolerance each part is: first the hardness of every mount,
    then the loss factor of every mount. k (1 + jg) becomes k (1 + t_k d) (1 + jg (1 + t_g d')).
    """

    names: tuple[str, ...]
    """Of the mounts."""
    mounts: NDArray[np.intp]
    """(n_springs,): the number of each spring's mount."""
    rates: Floats
    """(n_springs,), N/m and N m/rad: k as drawn; of dampers c, N s/m."""
    loss_factor: Floats
    """(n_springs,): g as drawn."""
    are_rubber: NDArray[np.bool_]
    """(n_springs,): those that are no dampers."""
    tolerance: Tolerance

    @property
    def n_deviations(self) -> int:
        """Two for each mount."""
        return 2 * len(self.names)

    def factor(self, deviations: Floats) -> Complexes:
        """Complex rates over k as drawn, (..., n_springs), of deviations (..., n_deviations)."""
        hardness, loss = self._factors(deviations)
        return hardness * (1 + 1j * self.loss_factor * loss)

    def stiffness(self, deviations: Floats) -> Complexes:
        """Complex rates of every mount spring, in the units of `rates`; arguments as `factor`."""
        return self.rates * self.factor(deviations)

    def slopes(self, deviations: Floats) -> Complexes:
        """The derivatives of `stiffness` of one vehicle, (n_springs, n_deviations)."""
        hardness, loss = self._factors(deviations)
        t, g = self.tolerance, self.loss_factor
        to_hardness = t.rates * self.are_rubber * self.rates * (1 + 1j * g * loss)
        to_loss = 1j * t.loss_factor * self.rates * hardness * g
        own = self.mounts[:, None] == np.arange(len(self.names))
        return np.hstack([to_hardness[:, None] * own, to_loss[:, None] * own])

    def samples(self, count: int, seed: int | np.random.Generator) -> Floats:
        """Deviations evenly spread, (count, n_deviations): a Latin hypercube; a seed repeats it."""
        from scipy.stats import qmc  # a second, which only those who draw samples wait for

        return 2 * qmc.LatinHypercube(self.n_deviations, rng=seed).random(count) - 1

    def _factors(self, deviations: Floats) -> tuple[Floats, Floats]:
        """Return the factors of hardness and loss factor of every spring, (..., n_springs) each."""
        hardness, loss = np.split(deviations, 2, axis=-1)
        t = self.tolerance
        return (
            1 + t.rates * self.are_rubber * hardness[..., self.mounts],
            (1 + t.loss_factor * loss)[..., self.mounts],
        )


def scattered_parts(prepared: PreparedModes, rates: Rates, tolerance: Tolerance) -> Parts:
    """The parts of a vehicle with some rates; raises VehicleError for a group it does not have."""
    stiffness = prepared.mount_stiffness(rates)
    names = tuple(mount.name for mount in prepared.vehicle.mounts)
    mounts = prepared.springs.mounts
    loss_factor = prepared.springs.loss(rates).imag.astype(np.float64)
    law = prepared.basis.law
    are_rubber = ~(law.are_dampers | law.are_masses)
    return Parts(names, mounts, stiffness.real.astype(np.float64), loss_factor, are_rubber, tolerance)
