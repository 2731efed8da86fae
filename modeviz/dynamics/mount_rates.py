"""Rates of mount springs, k (1 + jg), and of tuned dampers, c, at any rates of their groups."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.mount_rates import (
    DAMPING_FIELDS,
    RATE_FIELDS,
    ROTATIONAL_FIELDS,
    STIFFNESS_FIELDS,
    Rates,
)
from modeviz.vehicle.vehicle import Vehicle

Layout = tuple[NDArray[np.intp], NDArray[np.bool_], NDArray[np.bool_]]

_LAYOUTS: WeakKeyDictionary[Vehicle, Layout] = WeakKeyDictionary()


def not_progressive(_rates: Rates) -> float:
    """Return how many times as stiff mounts without curves are where the vehicle stands as unloaded."""
    return 1.0


@dataclass(frozen=True, eq=False)
class MountSprings:
    """The springs of all mounts: three along the local axes of each, those about axes, and dampers.

    Those about axes are where a mount has rotational stiffness, or can be given some. Dampers along
    axes are where damping is tuned: their rate is c, N s/m, with which they resist as a spring of the
    stiffness jωc, see `SpringLaw`.
    """

    vehicle: Vehicle
    tangents: Callable[[Rates], Floats | float] = not_progressive
    """How many times as stiff each spring is where the vehicle stands as unloaded, (n_springs,)."""

    def stiffness(self, rates: Rates) -> Complexes:
        """Return k (1 + jg), and c, with other rates, (n_springs,), N/m, N m/rad and N s/m.

        Args:
            rates: of the groups that differ from the vehicle's own.

        Raises:
            VehicleError: a group that the vehicle does not have, or a rate that it does not tune.
            SolveError: as `tangents`.
        """
        return self.tangents(rates) * self.unloaded(rates) * self.loss(rates)

    def unloaded(self, rates: Rates) -> Floats:
        """Return k, and c, of mounts without a load, (n_springs,); arguments as `stiffness`."""
        every = self.vehicle.all_rates(rates)
        values = [getattr(every[g.name], f) for g in self.vehicle.mount_groups for f in RATE_FIELDS]
        return self._fixed + self._members @ np.array(values, np.float64)

    def elastic(self, rates: Rates) -> Floats:
        """Return the same with zero in place of what dampers have."""
        return np.where(self._are_elastic, self.unloaded(rates), 0.0)

    def loss(self, rates: Rates) -> Complexes:
        """Return 1 + jg of every spring, one of all else; arguments and errors as `stiffness`."""
        every, groups = self.vehicle.all_rates(rates), self.vehicle.mount_groups
        factors = [g.loss_factor_with(every[g.name]) for g in groups for _ in g.mounts]
        return 1 + 1j * np.where(self._are_elastic, np.array(factors, np.float64)[self.mounts], 0.0)

    def shares(self, rates: Rates) -> Complexes:
        """Return ∂(spring rate)/∂(rate of a group), (n_springs, n_variables), complex.

        Progressive mounts are as stiff where they stand as their curve's straight part there, scaled.
        """
        return (self.tangents(rates) * self.loss(rates))[:, None] * self.has_rate

    @cached_property
    def has_rate(self) -> Floats:
        """(n_springs, n_variables): one where a spring has a tuned rate of a group, else zero.

        Rates are those of the first group, in the order of `RATE_FIELDS`, and so on.
        """
        tuned = [field in g.fields for g in self.vehicle.mount_groups for field in RATE_FIELDS]
        return self._members[:, np.array(tuned, bool)]

    @cached_property
    def has_stiffness(self) -> Floats:
        """The same of springs, and nothing of all else."""
        return np.where(self._are_elastic[:, None], self.has_rate, 0.0)

    @cached_property
    def mounts(self) -> NDArray[np.intp]:
        """The number of each spring's mount, (n_springs,)."""
        return mounts_of_springs(self.vehicle)

    @cached_property
    def _are_elastic(self) -> NDArray[np.bool_]:
        return ~(are_dampers(self.vehicle) | are_masses(self.vehicle))

    @cached_property
    def _members(self) -> Floats:
        """(n_springs, 9 n_groups): one where a spring has a rate of a group, else zero."""
        vehicle = self.vehicle
        motions, dampers = rows_of_springs(vehicle) % 6, _are_beside(vehicle)
        first = {g.name: len(RATE_FIELDS) * i for i, g in enumerate(vehicle.mount_groups)}
        members = np.zeros((len(motions), len(RATE_FIELDS) * len(first)))
        for spring, (motion, is_damper, number) in enumerate(
            zip(motions.tolist(), dampers.tolist(), self.mounts.tolist(), strict=True)
        ):
            mount = vehicle.mounts[number]
            if motion < 3 or not mount.has_own("rotational_stiffness"):
                field = (DAMPING_ALONG if is_damper else STIFFNESS_OF)[motion]
                members[spring, first[mount.group] + RATE_FIELDS.index(field)] = 1.0
        return members

    @cached_property
    def _fixed(self) -> Floats:
        """The part of each rate that no rates of groups change, (n_springs,)."""
        fixed = np.zeros(len(self.mounts))
        turns = turning_axes(self.vehicle)
        of_groups = [g.rates.rotational() for g in self.vehicle.mount_groups for _ in g.mounts]
        own = np.array([m.rotational_stiffness for m in self.vehicle.mounts]).reshape(-1, 3)
        from_group = [not m.has_own("rotational_stiffness") for m in self.vehicle.mounts]
        tuned = np.array(of_groups).reshape(-1, 3) * np.array(from_group, float)[:, None]
        about = slice(3 * len(turns), 3 * len(turns) + np.count_nonzero(turns))
        fixed[about] = (own - tuned)[turns]
        return fixed


STIFFNESS_OF = (*reversed(STIFFNESS_FIELDS), *ROTATIONAL_FIELDS)
"""The field of `MountRates` that is the stiffness of each of `MOTIONS`."""

DAMPING_ALONG = tuple(reversed(DAMPING_FIELDS))
"""The one that is the damping along each local axis."""


def mount_stiffness(vehicle: Vehicle) -> Complexes:
    """Complex rates k (1 + jg) of every mount spring, (n_springs,), and c of dampers that are tuned.

    Those along the local axes of each mount come first, N/m, then those about axes, N m/rad, which damp
    with the mount's loss factor, then dampers, N s/m; see `MountSprings`.
    """
    k = np.array([(m.stiffness, m.rotational_stiffness) for m in vehicle.mounts]).reshape(-1, 2, 3)
    loss = 1 + 1j * np.array([m.loss_factor for m in vehicle.mounts])
    rates = k * loss[:, None, None]
    c = np.array([m.damping for m in vehicle.mounts]).reshape(-1, 3)
    dampers = c[damped_axes(vehicle)]
    parts = rates[:, 0].ravel(), rates[:, 1][turning_axes(vehicle)], dampers
    return np.concatenate(parts).astype(complex)


def elastic_stiffness(vehicle: Vehicle) -> Floats:
    """The real rate of every mount spring, (n_springs,), N/m and N m/rad, with zero of dampers."""
    k = mount_stiffness(vehicle).real.astype(np.float64)
    return np.where(are_dampers(vehicle), 0.0, k)


def mounts_of_springs(vehicle: Vehicle) -> NDArray[np.intp]:
    """The number of the mount of every mount spring, (n_springs,)."""
    return rows_of_springs(vehicle) // 6


def static_ratios(vehicle: Vehicle) -> Floats:
    """How many times as stiff each mount spring is when it vibrates as under a load that stays.

    (n_springs,).
    """
    of_mounts = [g.static_ratio for g in vehicle.mount_groups for _ in g.mounts]
    return np.array(of_mounts, float)[mounts_of_springs(vehicle)]


def rows_of_springs(vehicle: Vehicle) -> NDArray[np.intp]:
    """Which of the six motions of all connections each mount spring resists, (n_springs,)."""
    return _layout(vehicle)[0]


def turning_axes(vehicle: Vehicle) -> NDArray[np.bool_]:
    """About which of its local axes each mount has rotational stiffness, or can have, (n_mounts, 3)."""
    has_some = np.array([m.rotational_stiffness for m in vehicle.mounts]).reshape(-1, 3) > 0
    return has_some | _tuned(vehicle, "rotational_stiffness", ROTATIONAL_FIELDS)


def damped_axes(vehicle: Vehicle) -> NDArray[np.bool_]:
    """Along which of its local axes the damping of each mount is tuned, (n_mounts, 3)."""
    return _tuned(vehicle, "damping", DAMPING_ALONG)


def are_dampers(vehicle: Vehicle) -> NDArray[np.bool_]:
    """Which mount springs are dampers that are tuned, (n_springs,)."""
    return _layout(vehicle)[1]


def are_masses(vehicle: Vehicle) -> NDArray[np.bool_]:
    """Which mount springs resist acceleration, (n_springs,); see `PartKind`."""
    return _layout(vehicle)[2]


def _are_beside(vehicle: Vehicle) -> NDArray[np.bool_]:
    """Which of them are the dampers beside springs, which come last, (n_springs,)."""
    n_springs = len(rows_of_springs(vehicle))
    return np.arange(n_springs) >= n_springs - np.count_nonzero(damped_axes(vehicle))


def _layout(vehicle: Vehicle) -> Layout:
    """`rows_of_springs`, `are_dampers` and `are_masses`, found once while somebody has the vehicle."""
    found = _LAYOUTS.get(vehicle)
    if found is None:
        found = _LAYOUTS[vehicle] = _laid_out(vehicle)
    return found


def _laid_out(vehicle: Vehicle) -> Layout:
    motions = np.arange(6 * len(vehicle.mounts)).reshape(-1, 6)
    along, about, damped = motions[:, :3], motions[:, 3:], damped_axes(vehicle)
    rows = np.concatenate([along.ravel(), about[turning_axes(vehicle)], along[damped]])
    kinds = np.array([group.kind for group in vehicle.mount_groups for _ in group.mounts], str)
    of_springs = kinds[rows // 6]
    dampers = of_springs == "dashpot"
    dampers[len(rows) - np.count_nonzero(damped) :] = True
    masses = of_springs == "inerter"
    for array in (rows, dampers, masses):
        array.flags.writeable = False
    return rows, dampers, masses


def constant_damping(vehicle: Vehicle) -> Floats:
    """The damping of all connections that is not tuned, (6 n_connections,), N s/m and N m s/rad."""
    c = np.array([(m.damping, m.rotational_damping) for m in vehicle.all_connections]).reshape(-1)
    c[rows_of_springs(vehicle)[are_dampers(vehicle)]] = 0.0
    return c


def by_motion(vehicle: Vehicle, values: Array) -> Array:
    """Sums of what springs have over those that resist one motion, (n, 6 n_mounts, ...).

    Args:
        vehicle: whose mounts.
        values: (n, n_springs, ...).
    """
    rows, dampers = rows_of_springs(vehicle), are_dampers(vehicle)
    sums = np.zeros((len(values), 6 * len(vehicle.mounts), *values.shape[2:]), values.dtype)
    sums[:, rows[~dampers]] = values[:, ~dampers]
    sums[:, rows[dampers]] += values[:, dampers]
    return sums


def _tuned(vehicle: Vehicle, attribute: str, fields: Sequence[str]) -> NDArray[np.bool_]:
    """Which of three rates each mount has from a group that tunes them, (n_mounts, 3)."""
    return np.array(
        [
            [field in group.fields and not mount.has_own(attribute) for field in fields]
            for group in vehicle.mount_groups
            for mount in group.mounts
        ],
        bool,
    ).reshape(-1, 3)
