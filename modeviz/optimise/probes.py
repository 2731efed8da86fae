"""Mounts without rates beside those that may be placed otherwise, which tell what that would do.

A mount with rows R adds Rᵀ k R to the stiffness, and its dampers Rᵀ c R to the damping. On rigid bodies
R is affine in an offset, and in the sine and cosine of an angle, so that both are quadratic in the one
and a trigonometric polynomial of degree two in the other. Their derivatives are sums over few places
elsewhere,

    ∂(RᵀkR)/∂p = Σ w_s R_sᵀ k R_s

exactly (for an angle: G. E. Crooks, "Gradients of parameterized quantum gates using the parameter-shift
rule and gate decomposition", 2019, has the same sum). So a goal that has derivatives to the rates of
mounts without rates at these places has one to the place: Σ w_s (k ∂F/∂k_s + c ∂F/∂c_s). On flexible
bodies too that is exact where their shapes are linear between the places.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.analysis.sensitivity import rate_variables
from modeviz.optimise.place_variables import Kind, Places, PlaceVariable
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import BaseMotion
from modeviz.vehicle.mount_group import SHARED, MountGroup
from modeviz.vehicle.mount_rates import (
    DAMPING_FIELDS,
    OTHER_FIELDS,
    ROTATIONAL_FIELDS,
    STIFFNESS_FIELDS,
    MountRates,
    Rates,
)
from modeviz.vehicle.placement import Placement, Placements, mirrored_mounts, placed_vehicle
from modeviz.vehicle.vehicle import Vehicle

STEP = 1e-5
"""M: so far from a mount its probes are; any distance would do on rigid bodies."""

READ: dict[str, tuple[str, int]] = {
    **{field: ("stiffness", axis) for axis, field in enumerate(reversed(STIFFNESS_FIELDS))},
    **{field: ("rotational_stiffness", axis) for axis, field in enumerate(ROTATIONAL_FIELDS)},
    **{field: ("damping", axis) for axis, field in enumerate(reversed(DAMPING_FIELDS))},
}
"""The attribute of a mount, and which of its three numbers, that each field of `MountRates` is."""

QUARTER, EIGHTH = np.pi / 2, np.pi / 4


@dataclass(frozen=True)
class Shift:
    """How far from a place a probe is, and what its rows count."""

    step: float
    """m or rad."""
    square: float
    """w of what is quadratic in rows, 1/m or 1/rad."""
    linear: float
    """Likewise of what is linear in them."""


SHIFTS: dict[Kind, tuple[Shift, ...]] = {
    "offset": tuple(Shift(s * STEP, s / (2 * STEP), s / (2 * STEP)) for s in (1, -1)),
    "angles": tuple(
        shift
        for s in (1, -1)
        for shift in (Shift(s * EIGHTH, s, 0.0), Shift(s * QUARTER, s * (1 - np.sqrt(2)) / 2, s / 2))
    ),
}


@dataclass(frozen=True)
class Probe:
    """A mount without rates, a group of its own, where one would be that may be placed otherwise."""

    number: int
    """Of its place variable."""
    variable: PlaceVariable
    shift: Shift
    mount: int
    """The number of the mount that it probes, of all."""
    name: str
    """Of the mount that it probes."""
    is_mirrored: bool
    """Whether that is on the other side than the first of its group."""

    @property
    def own_name(self) -> str:
        """As no other mount or group is called."""
        return f"{self.name}, {self.variable.spoken} {self.shift.step:+g}"

    def group(self, probed: MountGroup, loss_factor: float) -> MountGroup:
        """Return it where the mount is that it probes, of that group."""
        mount = next(mount for mount in probed.mounts if mount.name == self.name)
        others = [f for f in OTHER_FIELDS if f in probed.fields or rate_of(mount, f)]
        none, some = (
            MountRates(**dict.fromkeys((*STIFFNESS_FIELDS, *others), rate)) for rate in (0.0, 1.0)
        )
        still = dict.fromkeys(SHARED, np.zeros(3))
        return replace(
            probed,
            name=self.own_name,
            label=self.own_name,
            mounts=(replace(mount, name=self.own_name, given={}, **still),),
            rates=none,
            loss_factor=loss_factor,
            bounds=(none, some),
            ratio_limits=None,
            **still,
        )

    def placement(self, placements: Placements) -> Placement:
        """Return where it is while mounts are placed so."""
        value = self.variable.of(placements) + self.shift.step
        placed = self.variable.put(placements, value)[self.variable.group]
        return placed.mirrored if self.is_mirrored else placed


def rate_of(mount: Mount, field: str) -> float:
    """Return what a mount has of one of `RATE_FIELDS`, whether that is tuned or its own."""
    attribute, axis = READ[field]
    return float(getattr(mount, attribute)[axis])


@dataclass(frozen=True, eq=False)
class Probes:
    """A vehicle with the probes of the places that a search may choose."""

    vehicle: Vehicle
    """Without them, its mounts where they were given."""
    places: Places
    base: Rates
    """Of every group, whose loss factors a search keeps."""

    def placed(self, placements: Placements) -> Vehicle:
        """Return the vehicle with mounts placed so, and probes about them; raises as that."""
        own = {probe.own_name: probe.placement(placements) for probe in self.probes}
        return placed_vehicle(self._probed, {**placements, **own})

    def by_place(self, rates: Rates) -> Floats:
        """∂(rate of a probe)/∂(place), (n_probe_rates, n_places): N/m, or other, per m or rad.

        What its rate would be counted for. In the order of `rate_variables` of the placed vehicle,
        which has the vehicle's own first.
        """
        mounts = self.vehicle.with_rates(rates).mounts
        probes = {probe.own_name: probe for probe in self.probes}
        variables = rate_variables(self._probed)[len(rate_variables(self.vehicle)) :]
        found = np.zeros((len(variables), len(self.places.variables)))
        for row, variable in zip(found, variables, strict=True):
            probe = probes[variable.group]
            rate = rate_of(mounts[probe.mount], variable.direction)
            row[probe.number] = probe.shift.square * rate
        return found

    @cached_property
    def squares(self) -> Floats:
        """W of each mount's probes, (n_mounts, n_probes, n_places), see `Shift.square`."""
        return self._weights([probe.shift.square for probe in self.probes])

    @cached_property
    def slopes(self) -> Floats:
        """The same of what is linear, see `Shift.linear`."""
        return self._weights([probe.shift.linear for probe in self.probes])

    @cached_property
    def probes(self) -> tuple[Probe, ...]:
        """In the order of their groups."""
        return tuple(
            Probe(number, variable, shift, *mount)
            for number, variable in enumerate(self.places.variables)
            for shift in SHIFTS[variable.kind]
            for mount in self._mounts(variable.group)
        )

    def _mounts(self, group: str) -> Iterator[tuple[int, str, bool]]:
        """The number and the name of each mount of a group, and whether it is placed as in a mirror."""
        found = self.vehicle.mount_group(group)
        names = [mount.name for mount in self.vehicle.mounts]
        for mount, is_mirrored in zip(found.mounts, mirrored_mounts(found), strict=True):
            yield names.index(mount.name), mount.name, is_mirrored

    @cached_property
    def _probed(self) -> Vehicle:
        """The vehicle with probes where the mounts are that they probe."""
        probes = (probe.group(*self._group(probe)) for probe in self.probes)
        return replace(
            self.vehicle,
            mount_groups=(*self.vehicle.mount_groups, *probes),
            base_motions=tuple(map(self._moving, self.vehicle.base_motions)),
            problems=(),
        )

    def _group(self, probe: Probe) -> tuple[MountGroup, float]:
        """The group that it probes, and its loss factor."""
        group = self.vehicle.mount_group(probe.variable.group)
        return group, group.loss_factor_with(self.base[group.name])

    def _moving(self, motion: BaseMotion) -> BaseMotion:
        """A base motion that moves the probes of what it moves."""
        more = (probe.own_name for probe in self.probes if probe.name in motion.connections)
        return replace(motion, connections=(*motion.connections, *more))

    def _weights(self, weights: Sequence[float]) -> Floats:
        found = np.zeros((len(self.vehicle.mounts), len(self.probes), len(self.places.variables)))
        for i, (probe, weight) in enumerate(zip(self.probes, weights, strict=True)):
            found[probe.mount, i, probe.number] = weight
        return found
