"""The modes of a vehicle with some mount rates: what they are called, and where their energy is."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.analysis.preparation import PreparedModes
from modeviz.dynamics.assembly import System
from modeviz.dynamics.band import BandModes, Method, band_modes
from modeviz.dynamics.component_trust import ComponentTrust, component_trust
from modeviz.dynamics.damped import DampedModes, damped_modes
from modeviz.dynamics.energy import kinetic_energy, strain_energy
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.naming import ModeName, name_modes
from modeviz.dynamics.resonances import Resonances, resonances
from modeviz.dynamics.trust import ErrorEstimate
from modeviz.mounting.dissipation import dissipated_energy
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class ModalResults:
    """A vehicle's modes in the prepared band, what they are called and where their energy is."""

    prepared: PreparedModes
    rates: Rates
    """Of every mount group."""
    band: BandModes

    @cached_property
    def names(self) -> tuple[ModeName, ...]:
        """One for each mode."""
        return name_modes(self.prepared.namer, self.modes)

    @property
    def modes(self) -> Modes:
        return self.band.modes

    @property
    def trust(self) -> ErrorEstimate:
        return self.band.trust

    @cached_property
    def system(self) -> System:
        """With these rates."""
        return self.prepared.system_at(self.rates)

    @cached_property
    def vehicle(self) -> Vehicle:
        """With these rates."""
        return self.prepared.vehicle_at(self.rates)

    @cached_property
    def components(self) -> tuple[ComponentTrust, ...]:
        """How far each flexible body is believed with these rates; raises as `component_trust`."""
        return component_trust(self.system, self.prepared.basis.top_hz)

    @cached_property
    def resonances(self) -> Resonances:
        """Where the modes are in resonance, and how sharply."""
        return resonances(self.modes, self.band.damping, self.band.structural_damping)

    @cached_property
    def damped(self) -> DampedModes:
        """The modes with what damping couples, in the order of `modes`."""
        return damped_modes(self.band)

    @cached_property
    def momentum(self) -> Floats:
        """M φ of each mode, (n_dofs, n_modes)."""
        return self.prepared.system.momentum(self.modes.shapes)

    @cached_property
    def mount_rates(self) -> Floats:
        """The real rate of every mount spring, (n_springs,), N/m and N m/rad, at the reference; of
        dampers zero.
        """
        return self.prepared.real_rates(self.rates)

    @cached_property
    def kinetic_energy(self) -> Mapping[str, Floats]:
        """Share of each body, (n_modes,) by name."""
        return kinetic_energy(self.prepared.system, self.modes.shapes)

    @cached_property
    def strain_energy(self) -> Mapping[str, Floats]:
        """Share of each flexible body and connection group, (n_modes,) by name."""
        own = self.band.springs.real.T.astype(np.float64)
        return strain_energy(self.prepared.system, self.modes.shapes, own)

    @cached_property
    def dissipated_energy(self) -> Mapping[str, Floats]:
        """Share of each flexible body and connection group in a cycle's loss, (n_modes,) by name."""
        modes, own = self.modes, self.band.springs
        return dissipated_energy(self.prepared.system, modes.shapes, modes.frequency_hz, own)

    def dissipated_shares(self, mode: int) -> dict[str, float]:
        """Share of each flexible body and connection group in what a cycle of one mode loses."""
        modes, springs, own = self.modes, self.band.springs, slice(mode, mode + 1)
        there = springs[own] if len(springs) > 1 else springs
        shape, f = modes.shapes[:, own], modes.frequency_hz[own]
        shares = dissipated_energy(self.prepared.system, shape, f, there)
        return {name: float(share[0]) for name, share in shares.items()}

    def strain_shares(self, shape: Array, frequency_hz: float) -> dict[str, float]:
        """The strain energy of a shape: share of each flexible body and connection group.

        Args:
            shape: (n_dofs,), real or complex, in any scale.
            frequency_hz: at which it moves.
        """
        system, phi = self.prepared.system, shape[:, None]
        norm = np.sqrt(np.vdot(phi, system.momentum(phi)).real) or 1.0
        stiffness = self.prepared.mount_stiffness(self.rates)
        there = self.prepared.basis.law.stiffness(stiffness, np.array([frequency_hz]))
        shares = strain_energy(system, phi / norm, there.real.T.astype(np.float64))
        return {name: float(share[0]) for name, share in shares.items()}

    def strain_shares_of_mode(self, mode: int) -> dict[str, float]:
        """Return `strain_shares` of a mode, by its number from zero."""
        return self.strain_shares(self.modes.shapes[:, mode], float(self.modes.frequency_hz[mode]))

    def mode_index(self, name: str) -> int | None:
        """Return which mode is called that; None if no mode is."""
        return next((i for i, n in enumerate(self.names) if n.name == name), None)


def solve_modal(prepared: PreparedModes, rates: Rates, method: Method = "enriched") -> ModalResults:
    """The modes of a vehicle with other mount rates.

    Args:
        prepared: see `prepare` and `prepare_modes`.
        rates: of the groups that differ from the vehicle's own.
        method: how modes are found.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    return modes_of(prepared, rates, prepared.mount_stiffness(rates), method)


def modes_of(
    prepared: PreparedModes, rates: Rates, stiffness: Complexes, method: Method
) -> ModalResults:
    """Return the modes with the springs' complex rates, (n_springs,), N/m."""
    return ModalResults(
        prepared, prepared.all_rates(rates), band_modes(prepared.basis, stiffness, method)
    )
