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
from modeviz.mounting.working_point import at_work
from modeviz.optimise.mass_probes import mass_probes
from modeviz.optimise.place_variables import Places, PlaceVariable
from modeviz.optimise.probe import SHIFTS, Probe
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.carried_mass import carried_mass
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import BaseMotion
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements, mirrored_mounts, placed_vehicle
from modeviz.vehicle.vehicle import Vehicle


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

    def by_place(self, rates: Rates, tangents: Floats | float = 1.0) -> Floats:
        """∂(rate of a probe)/∂(place), (n_probe_rates, n_places): N/m, or other, per m or rad.

        What its rate would be counted for. In the order of `rate_variables` of the placed vehicle,
        which has the vehicle's own first.

        Args:
            rates: of the groups that differ from the vehicle's own.
            tangents: how many times as stiff springs are there as unloaded, (n_springs,) or more, those
                of the vehicle's mounts first.
        """
        mounts = at_work(self.vehicle, rates, tangents).mounts
        probes = {probe.own_name: probe for probe in self.probes}
        variables = rate_variables(self._probed)[len(rate_variables(self.vehicle)) :]
        found = np.zeros((len(variables), len(self.places.variables)))
        for row, variable in zip(found, variables, strict=True):
            probe = probes[variable.group]
            counts = probe.counts(mounts[probe.mount])
            row[probe.number] = probe.shift.square * counts.get(variable.direction, 0.0)
        return found

    @cached_property
    def squares(self) -> Floats:
        """W of each mount's probes, (n_mounts, n_probes, n_places), see `Shift.square`."""
        return self._weights([probe.is_read * probe.shift.square for probe in self.probes])

    @cached_property
    def slopes(self) -> Floats:
        """The same of what is linear, see `Shift.linear`."""
        return self._weights([probe.is_read * probe.shift.linear for probe in self.probes])

    @cached_property
    def probes(self) -> tuple[Probe, ...]:
        """In the order of their groups."""
        return tuple(
            probe
            for number, variable in enumerate(self.places.variables)
            for probe in self._of_variable(number, variable)
        )

    def _of_variable(self, number: int, variable: PlaceVariable) -> Iterator[Probe]:
        """The probes of one place."""
        group = self.vehicle.mount_group(variable.group)
        carried = carried_mass(self.vehicle, group)
        if carried is not None:
            ((mount, given, _),) = self._mounts(group)
            yield from mass_probes(number, variable, mount, given, carried)
            if variable.kind == "offset":
                return
        for mount, given, is_mirrored in self._mounts(group):
            for shift in SHIFTS[variable.kind]:
                yield Probe(number, variable, shift, mount, given, is_mirrored)
                if given.rotational_damping.any():
                    yield Probe(number, variable, shift, mount, given, is_mirrored, "dashpot")

    def _mounts(self, group: MountGroup) -> Iterator[tuple[int, Mount, bool]]:
        """The number of each mount of a group, the mount, and whether it is placed as in a mirror."""
        names = [mount.name for mount in self.vehicle.mounts]
        for mount, is_mirrored in zip(group.mounts, mirrored_mounts(group), strict=True):
            yield names.index(mount.name), mount, is_mirrored

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
        moved = (p for p in self.probes if p.is_read and p.given.name in motion.connections)
        more = (probe.own_name for probe in moved)
        return replace(motion, connections=(*motion.connections, *more))

    def _weights(self, weights: Sequence[float]) -> Floats:
        found = np.zeros((len(self.vehicle.mounts), len(self.probes), len(self.places.variables)))
        for i, (probe, weight) in enumerate(zip(self.probes, weights, strict=True)):
            found[probe.mount, i, probe.number] = weight
        return found
