"""The forces of all connections of a prepared vehicle under one of its loads."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeGuard

import numpy as np

from modeviz.analysis.preparation import PreparedModes
from modeviz.dynamics.resonances import resonances_at
from modeviz.dynamics.spacing import placed_lines
from modeviz.errors import VehicleError, unknown
from modeviz.mounting.dissipation import Dissipation, dissipation
from modeviz.mounting.forces import N_MOTIONS, Forces, solve_forces
from modeviz.mounting.free_bodies import body_motions
from modeviz.mounting.levels import InputSpectra, input_spectra
from modeviz.mounting.paths import Paths, solve_paths
from modeviz.mounting.transmission import acceleration_ratio, end_motions, force_ratio
from modeviz.ride.excitation import Load
from modeviz.ride.resolution import resolving_lines
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.loads import Force, RandomLoad, ResponsePoint, Road, Spectrum, spectrum_of
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class LoadedForces:
    """The forces of a vehicle with some mount rates under one load."""

    load: Load
    speed: float
    """On a road, m/s."""
    forces: Forces
    spectra: InputSpectra

    @property
    def vehicle(self) -> Vehicle:
        """With the rates."""
        return self.forces.system.vehicle

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): lines of the vehicle's band, closer where modes are sharp."""
        return self.forces.frequency_hz

    @property
    def is_random(self) -> bool:
        """Whether the load has a spectrum; else a peak amplitude."""
        return is_random(self.load)

    def number(self, connection: str) -> int:
        """The number of a connection.

        Raises:
            VehicleError: there is none of that name.
        """
        names = [c.name for c in self.forces.connections]
        if connection not in names:
            raise VehicleError(unknown("connection", connection, names))
        return names.index(connection)

    def acting(self, connection: int, in_vehicle_axes: bool = False) -> list[str]:
        """Those of `MOTIONS` in which a connection can pass something on."""
        acts = self.forces.acting[N_MOTIONS * connection : N_MOTIONS * (connection + 1)]
        if in_vehicle_axes:
            acts = np.repeat([acts[:3].any(), acts[3:].any()], 3)
        return [motion for motion, does in zip(MOTIONS, acts, strict=True) if does]

    def force(self, connection: int, motion: str, in_vehicle_axes: bool = False) -> Complexes:
        """The force in one of `MOTIONS` per unit of each input, (n_freqs, 1, n_inputs), N or N m."""
        every = self.forces.in_vehicle_axes if in_vehicle_axes else self.forces.force
        place = N_MOTIONS * connection + MOTIONS.index(motion)
        return every[:, place : place + 1]

    @cached_property
    def rms(self) -> Floats:
        """(2, n_connections, 6): RMS over all lines along local and along vehicle axes, N and N m."""
        both = self.forces.force, self.forces.in_vehicle_axes
        return np.array([self.spectra.rms(f).reshape(-1, N_MOTIONS) for f in both])

    @cached_property
    def dissipation(self) -> Dissipation:
        """Where the load's energy is turned into heat."""
        return dissipation(self.forces, self.spectra, self.is_random)

    @cached_property
    def force_transmissibility(self) -> Floats | None:
        """Under a harmonic force on a body, (n_freqs,), see `force_ratio`; else None."""
        if not isinstance(self.load, Force) or isinstance(self.load.amplitude, Spectrum):
            return None
        return force_ratio(self.forces, self.load.body, self.load.amplitude)

    def transmissibility(self, connection: int) -> tuple[Floats, Floats]:
        """`acceleration_ratio` across a connection, x, y, z: (n_freqs, 3), and over all lines, (3,)."""
        ends = end_motions(self.forces, self._motions, connection)
        return acceleration_ratio(*ends, self.spectra)

    def paths(self, point: ResponsePoint, axis: int) -> Paths:
        """The paths to a point of a body along x, y or z: 0, 1 or 2."""
        system = self.forces.system
        row = system.motion(point.body, point.position)[axis]
        return solve_paths(self.forces, point.body, row[system.dofs[point.body]])

    @cached_property
    def _motions(self) -> Complexes:
        return body_motions(self.forces.system, self.frequency_hz, self.forces.on_bodies)


def solve_loaded(
    prepared: PreparedModes,
    rates: Rates,
    load: Load,
    speed: float,
    frequency_hz: Floats | None = None,
    progress: Callable[[float], None] | None = None,
) -> LoadedForces:
    """The forces of all connections under a load.

    Args:
        prepared: see `prepare_modes`.
        rates: of the groups that differ from the vehicle's own.
        load: one of the vehicle's.
        speed: on a road, m/s.
        frequency_hz: (n_freqs,), rising, at which they are wanted; None: `force_lines`.
        progress: told the fraction that is done.

    Raises:
        VehicleError: a group that the vehicle does not have.
        ModevizError: nothing of the band is known of the load.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    lines = force_lines(prepared, rates, load, speed) if frequency_hz is None else frequency_hz
    forces = solve_forces(prepared.system_at(rates), load, lines, speed, progress)
    return LoadedForces(load, speed, forces, input_spectra(load, lines, speed))


def force_lines(prepared: PreparedModes, rates: Rates, load: Load, speed: float) -> Floats:
    """Lines at which forces under a load hold their integrals, (n_lines,), Hz."""
    vehicle = prepared.vehicle
    grid = vehicle.frequency_hz
    if is_random(load):
        grid = resolving_lines(vehicle, [(load, speed)], grid)
    found = resonances_at(prepared.basis, prepared.mount_stiffness(rates)).rounded()
    return placed_lines(grid, found.frequency_hz, found.damping_ratio)


def is_random(load: Load) -> TypeGuard[RandomLoad]:
    """Whether a load has a spectrum."""
    return isinstance(load, Road) or spectrum_of(load) is not None
