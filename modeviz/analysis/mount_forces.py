"""The forces of mounts at any rates, from receptances: quick enough to follow a drag."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.analysis.driven import Driven, driven
from modeviz.analysis.preparation import Prepared
from modeviz.dynamics.assembly import System
from modeviz.dynamics.mount_rates import are_dampers, by_motion, constant_damping, rows_of_springs
from modeviz.dynamics.resonances import resonances_at
from modeviz.mounting.forces import N_MOTIONS
from modeviz.mounting.levels import InputSpectra, input_spectra
from modeviz.ride.excitation import acting_lines
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS, Mount
from modeviz.vehicle.loads import HarmonicLoad
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class MountForces:
    """The force that every mount puts on the body that carries it, under one load."""

    vehicle: Vehicle
    spectra: InputSpectra
    is_random: bool
    force: Complexes
    """(n_freqs, n_mounts, 6, n_inputs), along and about local axes, N and N m, per unit of input.

    Moments are those of mounts' rotational stiffness and what damps beside it."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,)."""
        return self.spectra.frequency_hz

    @cached_property
    def in_vehicle_axes(self) -> Complexes:
        """The same along and about the vehicle's axes."""
        by_input = np.moveaxis(self.force, -1, 0)
        return np.moveaxis(along_vehicle(self.vehicle, by_input), 0, -1)

    @property
    def figures(self) -> Floats:
        """(n_mounts, 6), along local axes: RMS, or the largest amplitudes under a harmonic load."""
        return self.rms if self.is_random else np.abs(self.force[..., 0]).max(axis=0)

    @property
    def vehicle_figures(self) -> Floats:
        """The same along the vehicle's axes."""
        every = self.in_vehicle_axes
        return self.vehicle_rms if self.is_random else np.abs(every[..., 0]).max(axis=0)

    @cached_property
    def rms(self) -> Floats:
        """(n_mounts, 6): over all lines, along local axes."""
        return self._rms(self.force)

    @cached_property
    def vehicle_rms(self) -> Floats:
        """(n_mounts, 6): over all lines, along the vehicle's axes."""
        return self._rms(self.in_vehicle_axes)

    def level(self, mount: int, motion: str, in_vehicle_axes: bool = False) -> Floats:
        """PSD of a force, N²/Hz, or its amplitude under a harmonic load, N, (n_freqs,)."""
        every = self.in_vehicle_axes if in_vehicle_axes else self.force
        power = self.spectra.psd(every[:, mount, MOTIONS.index(motion)][:, None])[:, 0]
        return power if self.is_random else np.sqrt(power)

    def _rms(self, force: Complexes) -> Floats:
        n_freqs, n_mounts, _, n_inputs = force.shape
        flat = self.spectra.rms(force.reshape(n_freqs, -1, n_inputs))
        return flat.reshape(n_mounts, N_MOTIONS)


def figures_of(mounts: Sequence[Mount], vehicle: Vehicle, figures: Floats) -> Floats:
    """Return figures of a vehicle's mounts, (n_vehicle_mounts, ...), for some mounts, by their names.

    No numbers for one that the vehicle is without.
    """
    rows = {mount.name: row for mount, row in zip(vehicle.mounts, figures, strict=True)}
    none = np.full(figures.shape[1:], np.nan)
    return np.array([rows.get(mount.name, none) for mount in mounts]).reshape(-1, *figures.shape[1:])


def along_vehicle(vehicle: Vehicle, force: Complexes) -> Complexes:
    """Turn forces of mounts, (..., n_mounts, 6), from their own axes into the vehicle's."""
    turn = np.array([np.kron(np.eye(2), m.axes) for m in vehicle.mounts]).reshape(-1, 6, 6)
    return np.einsum("mij,...mi->...mj", turn, force)


def harmonic_mount_forces(
    prepared: Prepared, rates: Rates, load: HarmonicLoad, speed: float
) -> MountForces:
    """The forces of mounts under a harmonic load of a vehicle.

    Args:
        prepared: see `prepare`.
        rates: of the groups that differ from the vehicle's own.
        load: one of the vehicle's.
        speed: on a road, m/s.

    Raises:
        VehicleError: a group that the vehicle does not have.
        SolveError: with these rates an undamped resonance lies on a line.
    """
    stiffness = prepared.mount_stiffness(rates)
    under = driven(prepared, [load], speed)
    f = acting_lines(load, under.lines(resonances_at(prepared.basis, stiffness)))
    return mount_forces(under, stiffness, f, input_spectra(load, f, speed), False)


def mount_forces(
    drive: Driven, stiffness: Complexes, lines: Floats, spectra: InputSpectra, is_random: bool
) -> MountForces:
    """The forces of mounts under one load.

    Args:
        drive: under that load.
        stiffness: (n_springs,), complex rates at the reference, N/m.
        lines: (n_lines,), Hz.
        spectra: of its inputs there.
        is_random: whether the load has a spectrum.

    Raises:
        SolveError: with these rates an undamped resonance lies on a line.
    """
    force = forces_of_mounts(drive, stiffness, lines)
    return MountForces(drive.prepared.vehicle, spectra, is_random, force)


def forces_of_mounts(drive: Driven, stiffness: Complexes, lines: Floats) -> Complexes:
    """Return them along and about local axes, (n_lines, n_mounts, 6, n_inputs), N and N m.

    Arguments and errors as of `mount_forces`.
    """
    system = drive.prepared.system
    stretch = drive.stretches(stiffness, lines)
    there = drive.receptances.law.stiffness(stiffness, lines)
    z = there + 2j * np.pi * lines[:, None] * spring_damping(system)
    force = by_motion(system.vehicle, z[:, :, None] * stretch)
    return force.reshape(len(lines), -1, N_MOTIONS, stretch.shape[2])


def force_weights(
    system: System,
    stiffness: Complexes,
    frequency_hz: float,
    mount: int,
    motion: str,
    in_vehicle_axes: bool = False,
) -> Complexes:
    """What each mount spring's stretch counts in a force of a mount, (n_springs,), N/m.

    Args:
        system: what vibrates.
        stiffness: (n_springs,), complex rates, N/m.
        frequency_hz: at which.
        mount: its number.
        motion: one of `MOTIONS`.
        in_vehicle_axes: whether along or about the vehicle's axes, else the mount's own.
    """
    start, axis = 3 * (motion in MOTIONS[3:]), MOTIONS.index(motion) % 3
    along = system.vehicle.mounts[mount].axes[:, axis] if in_vehicle_axes else np.eye(3)[axis]
    z = stiffness + 2j * np.pi * frequency_hz * spring_damping(system)
    parts = np.zeros(N_MOTIONS * len(system.vehicle.mounts))
    first = N_MOTIONS * mount + start
    parts[first : first + 3] = along
    return parts[rows_of_springs(system.vehicle)] * z


def spring_damping(system: System) -> Floats:
    """What damps beside each mount spring and is not tuned, (n_springs,), N s/m and N m s/rad."""
    vehicle = system.vehicle
    beside = constant_damping(vehicle)[rows_of_springs(vehicle)]
    return np.where(are_dampers(vehicle), 0.0, beside)
