"""One solve for screen, report and command line."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.energy import kinetic_energy, strain_energy
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.naming import ModeName, name_modes, prepare_names
from modeviz.dynamics.response import modal_coordinates
from modeviz.ride.participation import Peak, participation, peaks
from modeviz.ride.psd import acceleration_psd, harmonic_acceleration, rms
from modeviz.ride.rating import Rating, rate
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.ride.wheels import wheel_forces
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import DIRECTIONS, Rates
from modeviz.vehicle.vehicle import Vehicle

N_MODES = 100
"""Vehicle modes in a response; on the pickup they reach 120 Hz and miss up to 1.2 % of the largest
response at a frequency (tests/test_paper.py)."""

FREQUENCY_HZ = np.arange(1, 401) / 10
"""The band of the paper's RMS values, 0 to 40 Hz, without zero."""

AXIS: dict[str, int] = dict(zip(DIRECTIONS, (2, 1, 0), strict=True))
"""Where a direction is among x, y, z."""


@dataclass(frozen=True)
class Conditions:
    """What the vehicle drives over."""

    road: str
    speed: float
    """m/s."""


@dataclass(frozen=True, eq=False)
class ModalResults:
    """A vehicle's modes, what they are called and where their energy is."""

    system: System
    modes: Modes
    names: tuple[ModeName, ...]
    """One for each mode."""

    @property
    def vehicle(self) -> Vehicle:
        return self.system.vehicle

    @cached_property
    def kinetic_energy(self) -> Mapping[str, Floats]:
        """Share of each body, (n_modes,) by name."""
        return kinetic_energy(self.system, self.modes.shapes)

    @cached_property
    def strain_energy(self) -> Mapping[str, Floats]:
        """Share of each flexible body and connection group, (n_modes,) by name."""
        return strain_energy(self.system, self.modes.shapes)

    def mode_index(self, name: str) -> int | None:
        """Which mode is called that; None if no mode is."""
        return next((i for i, n in enumerate(self.names) if n.name == name), None)


@dataclass(frozen=True, eq=False)
class Results(ModalResults):
    """A vehicle's modes, and its ride on one road."""

    conditions: Conditions
    coordinates: Complexes
    """(n_freqs, n_modes, 2): modal coordinates per unit displacement of the left and right track."""
    psd: Floats
    """(n_freqs, n_points, 3): acceleration x, y, z of each response point, g²/Hz."""

    frequency_hz = FREQUENCY_HZ

    @cached_property
    def rms(self) -> Floats:
        """(n_points, 3), g, from 0 to 40 Hz."""
        return rms(self.frequency_hz, self.psd)

    @cached_property
    def rating(self) -> Rating:
        """Of the first response point, the driver's."""
        return rate(self.frequency_hz, self.psd[:, 0])

    def response(self, point: int, direction: str) -> Floats:
        """Acceleration PSD of a response point along one of `DIRECTIONS`, (n_freqs,), g²/Hz."""
        return self.psd[:, point, AXIS[direction]]

    def peaks(self, point: int, direction: str, count: int = 3) -> tuple[Peak, ...]:
        """The peaks of that response with the modes that make them."""
        output = _output_rows(self.system)[3 * point + AXIS[direction]] @ self.modes.shapes
        parts = participation(output, self.coordinates, _spectrum(self.vehicle, self.conditions))
        return peaks(self.frequency_hz, self.response(point, direction), parts, count)


def solve_modal(system: System, rates: Rates) -> ModalResults:
    """The modes of a vehicle with other mount rates.

    Args:
        system: of the vehicle, made once.
        rates: of the groups that differ from it.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    system = system.with_rates(rates)
    modes = solve_modes(system, N_MODES)
    return ModalResults(system, modes, name_modes(prepare_names(system), modes))


def solve(system: System, rates: Rates, conditions: Conditions) -> Results:
    """Modes and ride of a vehicle with other mount rates.

    Args:
        system: of the vehicle, made once.
        rates: of the groups that differ from it.
        conditions: road and speed.

    Raises:
        VehicleError: a group or a road that the vehicle does not have.
    """
    modal = solve_modal(system, rates)
    forces = track_forces(modal.system, FREQUENCY_HZ, conditions.speed)
    q = modal_coordinates(modal.system, modal.modes, FREQUENCY_HZ, forces)
    H = (_output_rows(modal.system) @ modal.modes.shapes) @ q
    psd = acceleration_psd(FREQUENCY_HZ, H, _spectrum(modal.vehicle, conditions))
    by_point = psd.reshape(len(FREQUENCY_HZ), -1, 3)
    return Results(modal.system, modal.modes, modal.names, conditions, q, by_point)


@dataclass(frozen=True, eq=False)
class WheelResults:
    """Harmonic response to each of a vehicle's wheel loads."""

    frequency_hz: Floats
    """(n_freqs,)."""
    acceleration_g: Floats
    """(n_freqs, n_loads, n_points, 3): peak x, y, z, g."""

    def mean(self, band: tuple[float, float]) -> Floats:
        """Mean over a band, ends included, (n_loads, n_points, 3), g."""
        f = self.frequency_hz
        inside = (f > band[0] - 1e-6) & (f < band[1] + 1e-6)
        return self.acceleration_g[inside].mean(axis=0)


def solve_wheels(system: System, rates: Rates, frequency_hz: Floats) -> WheelResults:
    """The response to every wheel load of the vehicle; arguments and errors as `solve`."""
    system = system.with_rates(rates)
    modes = solve_modes(system, N_MODES)
    loads = system.vehicle.wheel_loads
    q = modal_coordinates(system, modes, frequency_hz, wheel_forces(system, loads, frequency_hz))
    H = (_output_rows(system) @ modes.shapes) @ q
    g = harmonic_acceleration(frequency_hz, H).transpose(0, 2, 1)
    n_points = len(system.vehicle.response_points)
    return WheelResults(frequency_hz, g.reshape(len(frequency_hz), len(loads), n_points, 3))


def _spectrum(vehicle: Vehicle, conditions: Conditions) -> Complexes:
    """The road's two-track spectrum as met at that speed, (n_freqs, 2, 2), m²/Hz."""
    return road_spectrum(vehicle.road(conditions.road), FREQUENCY_HZ, conditions.speed)


def _output_rows(system: System) -> Floats:
    """Rows (3 n_points, n_dofs) that read x, y, z of every response point."""
    points = system.vehicle.response_points
    rows = [system.motion(p.body, p.position)[:3] for p in points]
    return np.vstack([np.zeros((0, system.n_dofs)), *rows])
