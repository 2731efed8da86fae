"""The work that is compared: the response after a change of mount rates."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.analysis.preparation import Prepared
from modeviz.dynamics.assembly import System
from modeviz.dynamics.reanalysis import Receptances
from modeviz.ride.roads import track_amplitudes, tyre_directions
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True, eq=False)
class Work:
    """Displacement of every response point per unit displacement of the left and the right track."""

    prepared: Prepared
    rates: Rates
    """The rates after the change."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,)."""
        return self.prepared.frequency_hz

    @property
    def outputs(self) -> Floats:
        """(n_outputs, n_dofs)."""
        return self.prepared.outputs

    @property
    def input_rows(self) -> Floats:
        """(n_rows, n_dofs): along which the tyres push."""
        return tyre_directions(self.prepared.system)

    @cached_property
    def amplitudes(self) -> Complexes:
        """How hard they push, (n_freqs, n_rows, 2), N/m."""
        vehicle = self.prepared.vehicle
        return track_amplitudes(vehicle, self.frequency_hz, vehicle.speed)

    @cached_property
    def forces(self) -> Complexes:
        """(n_freqs, n_dofs, 2)."""
        return self.input_rows.T @ self.amplitudes

    @cached_property
    def system(self) -> System:
        """With the changed rates."""
        return self.prepared.system.with_rates(self.rates)

    @cached_property
    def stiffness_matrix(self) -> Complexes:
        """K + jK_g, with the changed rates."""
        return self.system.stiffness + 1j * self.system.structural_damping

    @cached_property
    def mount_stiffness(self) -> Complexes:
        """The changed complex rates, (n_springs,), N/m."""
        return self.prepared.mount_stiffness(self.rates)

    @cached_property
    def receptances(self) -> Receptances:
        """Of the base vehicle to the two tracks."""
        prepared = self.prepared
        return prepared.excited([prepared.vehicle.roads[0]], prepared.vehicle.speed)

    @property
    def n_operations(self) -> float:
        """Real operations that structural modification needs: factors, forces in springs, response."""
        n_freqs, n_springs, n_outputs = self.receptances.outputs.shape
        n_inputs = self.receptances.inputs.shape[2]
        multiplications = n_springs**3 / 3 + n_inputs * (n_springs**2 + n_outputs * n_springs)
        return 8 * n_freqs * multiplications


def largest_difference(H: Complexes, reference: Complexes) -> float:
    """Of two responses, relative to the largest response of the same output."""
    largest = np.abs(reference).max(axis=(0, 2))
    return float((np.abs(H - reference).max(axis=(0, 2)) / largest).max())
