"""The complex rates k (1 + jg) of a vehicle's mount springs, at any rates of its groups."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle


def not_progressive(_rates: Rates) -> float:
    """Return how many times as stiff mounts without curves are where the vehicle stands as unloaded."""
    return 1.0


@dataclass(frozen=True, eq=False)
class MountSprings:
    """The springs of all mounts: three along the local axes of each, then those about axes.

    Those about axes are where a mount has rotational stiffness: that is not tuned, but damps with the
    mount's loss factor.
    """

    vehicle: Vehicle
    tangents: Callable[[Rates], Floats | float] = not_progressive
    """How many times as stiff each spring is where the vehicle stands as unloaded, (n_springs,)."""

    def stiffness(self, rates: Rates) -> Complexes:
        """Return k (1 + jg) with other rates, (n_springs,), N/m and N m/rad.

        Args:
            rates: of the groups that differ from the vehicle's own.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: as `tangents`.
        """
        return self.tangents(rates) * self.unloaded(rates) * self.loss(rates)

    def unloaded(self, rates: Rates) -> Floats:
        """Return k of mounts without a load, (n_springs,); arguments and errors as `stiffness`."""
        every = self.vehicle.all_rates(rates)
        along = [every[g.name].local() for g in self.vehicle.mount_groups for _ in g.mounts]
        return np.concatenate([np.ravel(along), self._rotational])

    def loss(self, rates: Rates) -> Complexes:
        """Return 1 + jg of every spring, (n_springs,); arguments and errors as `stiffness`."""
        every, groups = self.vehicle.all_rates(rates), self.vehicle.mount_groups
        factors = [g.loss_factor_with(every[g.name]) for g in groups for _ in g.mounts]
        return 1 + 1j * np.array(factors)[self.mounts]

    def shares(self, rates: Rates) -> Complexes:
        """Return ∂(spring rate)/∂(rate of a group), (n_springs, 3 n_groups), complex.

        Progressive mounts are as stiff where they stand as their curve's straight part there, scaled.
        """
        return (self.tangents(rates) * self.loss(rates))[:, None] * self.has_rate

    @cached_property
    def has_rate(self) -> Floats:
        """(n_springs, 3 n_groups): one where a spring has a rate of a group, else zero."""
        of_mount = np.transpose([MountRates(*unit).local() for unit in np.eye(3)])
        per_group = [np.tile(of_mount, (len(g.mounts), 1)) for g in self.vehicle.mount_groups]
        along = np.asarray(scipy.linalg.block_diag(np.zeros((0, 0)), *per_group))
        return np.pad(along, ((0, len(self._rotational)), (0, 0)))

    @cached_property
    def mounts(self) -> NDArray[np.intp]:
        """The number of each spring's mount, (n_springs,)."""
        return mounts_of_springs(self.vehicle)

    @cached_property
    def _rotational(self) -> Floats:
        """The rates of the springs about axes."""
        return mount_stiffness(self.vehicle)[3 * len(self.vehicle.mounts) :].real.astype(np.float64)


def mount_stiffness(vehicle: Vehicle) -> Complexes:
    """Complex rates k (1 + jg) of every mount spring, (n_springs,).

    Those along the local axes of each mount come first, N/m, then those about axes in which a mount has
    rotational stiffness, N m/rad: that is not tuned, but damps with the mount's loss factor.
    """
    k = np.array([(m.stiffness, m.rotational_stiffness) for m in vehicle.mounts]).reshape(-1, 2, 3)
    loss = 1 + 1j * np.array([m.loss_factor for m in vehicle.mounts])
    rates = k * loss[:, None, None]
    return np.concatenate([rates[:, 0].ravel(), rates[:, 1][turning_axes(vehicle)]])


def mounts_of_springs(vehicle: Vehicle) -> NDArray[np.intp]:
    """The number of the mount of every mount spring, (n_springs,)."""
    turns = turning_axes(vehicle)
    return np.concatenate([np.repeat(np.arange(len(turns)), 3), turns.nonzero()[0]])


def static_ratios(vehicle: Vehicle) -> Floats:
    """How many times as stiff each mount spring is when it vibrates as under a load that stays.

    (n_springs,).
    """
    of_mounts = [g.static_ratio for g in vehicle.mount_groups for _ in g.mounts]
    return np.array(of_mounts, float)[mounts_of_springs(vehicle)]


def rows_of_springs(vehicle: Vehicle) -> NDArray[np.intp]:
    """Which of the six motions of all connections each mount spring resists, (n_springs,)."""
    motions = np.arange(6 * len(vehicle.mounts)).reshape(-1, 6)
    return np.concatenate([motions[:, :3].ravel(), motions[:, 3:][turning_axes(vehicle)]])


def turning_axes(vehicle: Vehicle) -> NDArray[np.bool_]:
    """About which of its local axes each mount has rotational stiffness, (n_mounts, 3)."""
    return np.array([m.rotational_stiffness for m in vehicle.mounts]).reshape(-1, 3) > 0
