"""All forces of a vehicle at one frequency, at any mount rates: solved once, then by reanalysis.

Forces of what is no mount spring are read as responses are, see `dynamics.inputs.opened`; those of
mount springs follow from their stretch.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.mount_forces import spring_damping
from modeviz.analysis.preparation import PreparedModes, softened
from modeviz.dynamics.assembly import System
from modeviz.dynamics.inputs import directions, opened
from modeviz.dynamics.mount_rates import by_motion, rows_of_springs
from modeviz.dynamics.reanalysis import Receptances, prepare_receptances
from modeviz.mounting.forces import Forces, acting_motions, ground_rows, pushes
from modeviz.ride.excitation import Load
from modeviz.vehicle.arrays import Complexes
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True, eq=False)
class LineForces:
    """A vehicle made ready for all forces at one frequency under one load."""

    system: System
    """With the vehicle's own rates."""
    frequency_hz: float
    receptances: Receptances
    """Of the forces of what is no mount spring, then of dampers of modes, per unit of input."""
    read: NDArray[np.intp]
    """Which motions of connections the first of these outputs are."""
    ground: Complexes
    """(1, 6 n_connections, n_inputs), see `Forces`."""
    loads: Complexes
    """(1, n_dofs, n_inputs), likewise."""

    def forces(self, stiffness: Complexes) -> Forces:
        """The forces with mount rates.

        Their `system` has the vehicle's own rates, which paths do not need.

        Args:
            stiffness: (n_springs,), complex rates at the reference, N/m.

        Raises:
            SolveError: with these rates an undamped resonance lies on the frequency.
        """
        system, omega = self.system, 2 * np.pi * self.frequency_hz
        at = self.receptances
        others, stretch = at.response(stiffness), at.stretches(stiffness)
        force = np.zeros_like(self.ground)
        force[:, self.read] = others[:, : len(self.read)]
        z = at.law.stiffness(stiffness, at.frequency_hz) + 1j * omega * spring_damping(system)
        rows = rows_of_springs(system.vehicle)
        force[:, rows] = by_motion(system.vehicle, z[:, :, None] * stretch)[:, rows]
        damping = 1j * omega * system.mode_damping[:, None] * others[:, len(self.read) :]
        f = np.array([self.frequency_hz])
        return Forces(system, f, force, self.ground, damping, self.loads)


def prepare_line(
    prepared: PreparedModes, rates: Rates, load: Load, frequency_hz: float, speed: float
) -> LineForces:
    """A vehicle made ready for all forces at one frequency.

    Args:
        prepared: see `prepare_modes`.
        rates: of the groups that differ from the vehicle's own, close to those that are wanted.
        load: one of the vehicle's.
        frequency_hz: above zero.
        speed: on a road, m/s.

    Raises:
        ModevizError: the load's spectrum is not known there.
        SolveError: an undamped resonance lies there.
    """
    f = np.array([frequency_hz])
    system = prepared.system_at(softened(prepared.all_rates(rates)))
    ground = ground_rows(system, load, f, speed)
    pushed, amplitudes = pushes(system, load, f, speed)
    springs = rows_of_springs(system.vehicle)
    read = np.setdiff1d(np.flatnonzero(acting_motions(system)), springs)
    gaps = opened(system)[read]
    outputs = directions(system, gaps, system.mode_dampers)
    inputs = directions(system, gaps, pushed, system.mount_motions)
    found = prepare_receptances(system, f, outputs, inputs)
    z = found.present[0] + 2j * np.pi * frequency_hz * spring_damping(system)
    driving = np.concatenate([ground[:, read], amplitudes, z[:, None] * ground[:, springs]], axis=1)
    loads = (amplitudes.swapaxes(1, 2) @ pushed).swapaxes(1, 2)
    under = found.driven(driving, ground[:, springs])
    return LineForces(prepared.system, frequency_hz, under, read, ground, loads)
