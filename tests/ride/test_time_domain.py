"""Ride spectra against a simulation in time of the same truck over a generated two-track road.

The simulation knows the road as heights under four wheels and the truck as differential equations: no
transfer function, no cross spectrum, no delay operator. Structural damping has no counterpart in time,
so both sides get a truck whose loss factors are replaced by viscous dampers that lose as much at 11 Hz.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from full_solutions import response_psd
from scipy import signal, stats
from two_tracks import two_track_profile

from modeviz.dynamics.assembly import System, assemble
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.response import modal_response
from modeviz.ride.roads import lag, road_spectrum, track_forces, track_shares
from modeviz.vehicle.connections import Connection, Tyre
from modeviz.vehicle.vehicle import Vehicle

SPEED = 20.0
WHEELBASE_SAMPLES = 37
"""From front to rear wheels, so that the delay is a whole number of samples: about 250 Hz."""
DURATION, SETTLING, SEGMENT = 800.0, 40.0, 60.0
"""s; segments long enough to resolve the ride modes, which are 0.06 Hz wide."""
N_MODES = 80
BAND = (1.0, 30.0)
AVERAGES = (2 * (DURATION - SETTLING) / SEGMENT - 1) / (1 + 2 / 36)
"""Independent ones among Hann-windowed segments that overlap by half (Welch 1967)."""
LATERAL, VERTICAL = 0, 1


def viscous(vehicle: Vehicle, equal_at_hz: float = 11.0) -> Vehicle:
    """The vehicle with dampers c = g k / ω in place of loss factors."""

    def damped(connection: Connection):
        c = connection.loss_factor * connection.stiffness / (2 * np.pi * equal_at_hz)
        return replace(connection, damping=connection.damping + c, loss_factor=0.0)

    groups = (
        replace(g, mounts=tuple(map(damped, g.mounts)), loss_factor=0.0) for g in vehicle.mount_groups
    )
    connections = tuple(map(damped, vehicle.connections))
    return replace(vehicle, mount_groups=tuple(groups), connections=connections)


def heights(profile: np.ndarray, tyres: tuple[Tyre, ...], sample_rate: float) -> np.ndarray:
    """Height and climb rate under every tyre, (n_samples, 2 n_tyres); the profile is periodic."""
    delays = [round(lag(t, tyres, SPEED) * sample_rate) for t in tyres]
    z = np.column_stack(
        [np.roll(profile @ track_shares(t), d) for t, d in zip(tyres, delays, strict=True)]
    )
    omega = 2 * np.pi * np.fft.rfftfreq(len(z), 1 / sample_rate)
    climb = np.fft.irfft(1j * omega[:, None] * np.fft.rfft(z, axis=0), len(z), axis=0)
    return np.hstack([z, climb])


def equations(system: System, modes: Modes, outputs: np.ndarray) -> tuple[np.ndarray, ...]:
    """A, B, C, D of q̈ = -Ω²q - Cq̇ + φᵀF: heights and climb rates in, accelerations out."""
    phi, n = modes.shapes, len(modes.frequency_hz)
    tyres = system.vehicle.tyres
    patches = phi.T @ np.array([system.motion(t.bodies[0], t.points[0])[2] for t in tyres]).T
    motion = np.hstack([-np.diag(modes.omega_n_squared), -phi.T @ system.damping @ phi])
    force = np.hstack(
        [patches * [t.stiffness[2] for t in tyres], patches * [t.damping[2] for t in tyres]]
    )
    A = np.vstack([np.eye(n, 2 * n, n), motion])
    B = np.vstack([np.zeros_like(force), force])
    return A, B, outputs @ phi @ motion, outputs @ phi @ force


def simulate(system: tuple[np.ndarray, ...], inputs: np.ndarray, step: float) -> np.ndarray:
    """Outputs of a linear system, exact for inputs that run straight between samples."""
    A, B, C, D, _ = signal.cont2discrete(system, step, method="foh")
    x = np.zeros(len(A))
    y = inputs @ D.T
    for k, u in enumerate(inputs):
        y[k] += C @ x
        x = A @ x + B @ u
    return y


@dataclass(frozen=True, eq=False)
class RoadExcitation:
    """The seat's accelerations on a road: as simulated, and by the model's frequency response."""

    frequency_hz: np.ndarray
    road_psd: np.ndarray
    frequency_response: np.ndarray
    """(n_freqs, 2, 2): lateral and vertical acceleration per displacement of left and right track."""
    undelayed_response: np.ndarray
    estimate: np.ndarray
    """(n_freqs, 2, 2): Welch's S_ij = E[X_i X_j*] of the simulated accelerations."""

    @property
    def theory(self) -> np.ndarray:
        return response_psd(self.frequency_response, self.road_psd)


@pytest.fixture(scope="module")
def drive() -> RoadExcitation:
    truck = viscous(builtin_truck())
    road, seat = truck.random_load("road 1"), truck.response_points[0]
    system = assemble(truck)
    modes = vibrating(solve_modes(system, N_MODES))
    outputs = system.motion(seat.body, seat.position)[1:3]
    sample_rate = WHEELBASE_SAMPLES / max(lag(t, truck.tyres, SPEED) for t in truck.tyres)

    profile = two_track_profile(road, SPEED, DURATION, sample_rate, seed=11)
    inputs = heights(profile, truck.tyres, sample_rate)
    acceleration = simulate(equations(system, modes, outputs), inputs, 1 / sample_rate)
    f, estimate = welch(acceleration[round(SETTLING * sample_rate) :], sample_rate)

    def response(speed: float) -> np.ndarray:
        H = modal_response(system, modes, f, track_forces(system, f, speed), outputs)
        # Straight lines between samples weaken the road by sinc².
        return -((2 * np.pi * f * np.sinc(f / sample_rate)) ** 2)[:, None, None] * H

    return RoadExcitation(f, road_spectrum(road, f, SPEED), response(SPEED), response(1e9), estimate)


def vibrating(modes: Modes) -> Modes:
    """Without what moves freely: the spin of the propshaft, which nothing at the seat feels."""
    kept = modes.frequency_hz > 0.1
    return Modes(modes.frequency_hz[kept], modes.shapes[:, kept], modes.damping_ratio[kept])


def welch(signals: np.ndarray, sample_rate: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies within the band and the spectral matrix; scipy conjugates the first factor."""
    X = signals.T
    f, S = signal.csd(
        X[None, :, :], X[:, None, :], fs=sample_rate, nperseg=round(SEGMENT * sample_rate)
    )
    inside = (f >= BAND[0]) & (f <= BAND[1])
    return f[inside], np.moveaxis(S, -1, 0)[inside]


def share_inside_95(estimate: np.ndarray, exact: np.ndarray) -> float:
    """How many of the bins lie within the chi-square band of an estimate around the exact spectrum."""
    low, high = np.array(stats.chi2.interval(0.95, 2 * AVERAGES)) / (2 * AVERAGES)
    ratio = estimate / exact
    return float(np.mean((ratio > low) & (ratio < high)))


def mean_error(n_bins: int) -> float:
    """Standard error of the mean of n relative errors; a Hann window correlates neighbours."""
    return np.sqrt((1 + 2 * (4 / 9 + 1 / 36)) / (n_bins * AVERAGES))


@pytest.mark.parametrize("output", [LATERAL, VERTICAL])
def test_seat_psd_is_within_the_confidence_band_of_the_simulation(drive, output):
    estimate, exact = (S[:, output, output].real for S in (drive.estimate, drive.theory))
    # A share of 0.95 among some 900 independent bins scatters by 0.007.
    assert share_inside_95(estimate, exact) == pytest.approx(0.95, abs=0.02)
    assert np.mean(estimate / exact) == pytest.approx(1.0, abs=3 * mean_error(len(exact)))


@pytest.mark.parametrize("output", [LATERAL, VERTICAL])
@pytest.mark.parametrize("low", [1.0, 5.0, 11.0, 17.0])
def test_seat_psd_agrees_with_the_simulation_in_every_band(drive, output, low):
    band = (drive.frequency_hz > low) & (drive.frequency_hz < low + 6.0)
    ratio = (drive.estimate / drive.theory)[band, output, output].real
    assert ratio.mean() == pytest.approx(1.0, abs=3 * mean_error(band.sum()))


def test_lateral_and_vertical_have_the_simulated_cross_spectrum(drive):
    scale = np.sqrt(drive.theory[:, 0, 0] * drive.theory[:, 1, 1]).real
    error = (drive.estimate - drive.theory)[:, LATERAL, VERTICAL] / scale
    assert np.sqrt(np.mean(np.abs(error) ** 2)) == pytest.approx(AVERAGES**-0.5, rel=0.08)
    assert abs(error.mean()) < 3 * mean_error(len(error))


def test_simulation_tells_rear_wheels_without_delay_apart(drive):
    wrong = response_psd(drive.undelayed_response, drive.road_psd)[:, LATERAL, LATERAL].real
    assert share_inside_95(drive.estimate[:, LATERAL, LATERAL].real, wrong) < 0.5


def test_simulation_tells_incoherent_tracks_apart(drive):
    wrong = response_psd(drive.frequency_response, drive.road_psd * np.eye(2))[:, LATERAL, LATERAL].real
    assert share_inside_95(drive.estimate[:, LATERAL, LATERAL].real, wrong) < 0.9
