import numpy as np
import pytest
from full_solutions import wheel_forces
from mounted_cabin import mounted_cabin
from scipy.signal import find_peaks

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import AXIS, Conditions, solve
from modeviz.analysis.wheel_peaks import wheel_peak_lines, wheel_peaks
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.ride.participation import NEGLIGIBLE
from modeviz.ride.psd import amplitude_decibels, harmonic_acceleration
from modeviz.vehicle.mount_rates import MountRates

RATES = {"A": MountRates(6e5, 2e5, 5e5)}
SEAT = 0


@pytest.fixture(scope="module")
def prepared():
    return prepare(mounted_cabin(), top_hz=1000.0)  # so that the modes are all there are


@pytest.fixture(scope="module")
def results(prepared):
    return solve(prepared, RATES, Conditions("flat", 20.0))


@pytest.fixture(scope="module")
def wheels(prepared):
    return solve_wheels(prepared, RATES)


def modal_parts(results, direction):
    """φ_or q_r of every mode by the equations of motion in all coordinates, (n_freqs, n_modes), m."""
    system = assemble(results.vehicle)
    seat = results.vehicle.response_points[SEAT]
    output = system.motion(seat.body, seat.position)[[AXIS[direction]]]
    forces = wheel_forces(system, results.vehicle.wheel_loads, results.frequency_hz)
    everything = np.eye(system.n_dofs)
    x = direct_response(system, results.frequency_hz, forces, everything)[:, :, 0]
    phi = solve_modes(system).shapes
    return (output @ phi) * (x @ (system.mass @ phi))


@pytest.mark.parametrize("direction", ["lateral", "vertical", "fore-aft"])
def test_contributors_are_the_modes_parts_of_the_direct_response(results, wheels, direction):
    parts = modal_parts(results, direction)
    f = results.frequency_hz
    summed = harmonic_acceleration(f, parts.sum(axis=1))
    np.testing.assert_allclose(summed, wheels.acceleration_g[:, 0, SEAT, AXIS[direction]], rtol=1e-6)
    found = wheel_peaks(results, wheels, 0, SEAT, direction, count=4)
    assert found
    for peak in found:
        size = np.sort(np.abs(parts[np.searchsorted(f, peak.frequency_hz - 1e-6)]))[::-1]
        ratios = [part.ratio for part in peak.contributors]
        expected = size[:4] / size[0]
        assert ratios == pytest.approx(expected[expected >= NEGLIGIBLE].tolist(), rel=1e-6)
        (line,) = np.flatnonzero(f == peak.frequency_hz)
        assert peak.level == wheels.acceleration_g[line, 0, SEAT, AXIS[direction]]


def test_peaks_stand_a_decibel_above_what_is_beside_them(wheels):
    level = amplitude_decibels(wheels.acceleration_g[:, 0, SEAT, AXIS["vertical"]])
    expected, _ = find_peaks(level, prominence=1.0)
    assert wheel_peak_lines(wheels, 0, SEAT, "vertical") == list(expected)
    assert len(expected)
