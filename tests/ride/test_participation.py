import numpy as np
import pytest
from full_solutions import response_psd
from scipy import signal
from small_vehicles import on_tyres, quarter_car, wheel

from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.response import modal_coordinates, modal_response
from modeviz.ride.participation import contributors, participation, peak_lines, peaks
from modeviz.ride.roads import RIGHT, track_forces

F = np.linspace(0.4, 20.0, 2000)


def coordinates(system, modes, f, forces):
    phi = modes.shapes
    C, K_g = (phi.T @ A @ phi for A in (system.damping, system.structural_damping))
    return modal_coordinates(modes.omega_n_squared, C, K_g, f, phi.T @ forces)


@pytest.fixture(scope="module")
def ride():
    """Vibrating modes of a quarter car, their coordinates on a road, the body's heave, the road."""
    system = quarter_car()
    every = solve_modes(system)
    vibrating = np.flatnonzero(every.frequency_hz > 0.1)
    modes = Modes(
        every.frequency_hz[vibrating], every.shapes[:, vibrating], every.damping_ratio[vibrating]
    )
    forces = track_forces(system, F, 20.0)
    heave = system.motion("body", np.zeros(3))[2]
    S_ff = (1e-5 * F**-2.0)[:, None, None] * np.array([[1.0, 0.2j], [-0.2j, 1.0]])
    return system, modes, forces, heave, S_ff


def test_participation_is_the_response_of_the_mode_alone(ride):
    """The loss factor is the same everywhere, so damping does not couple the modes."""
    system, modes, forces, heave, S_ff = ride
    q = coordinates(system, modes, F, forces)
    p = participation(heave @ modes.shapes, q, S_ff)
    for r in range(2):
        alone = Modes(modes.frequency_hz[[r]], modes.shapes[:, [r]], modes.damping_ratio[[r]])
        H = modal_response(system, alone, F, forces, heave[None])
        assert p[:, r] ** 2 == pytest.approx(response_psd(H, S_ff)[:, 0, 0].real, rel=1e-9)


def test_participation_in_a_harmonic_response_is_the_size_of_the_modal_response(ride):
    system, modes, forces, heave, _ = ride
    q = coordinates(system, modes, F, forces[:, :, [RIGHT]])
    p = participation(heave @ modes.shapes, q, np.ones((len(F), 1, 1)))
    assert p == pytest.approx(np.abs(heave @ modes.shapes * q[:, :, 0]), rel=1e-12)


def test_modes_that_cancel_in_the_output_still_participate():
    q = np.ones((1, 2, 1), complex)
    p = participation(np.array([1.0, -1.0]), q, np.ones((1, 1, 1)))
    assert p[0] == pytest.approx([1.0, 1.0])


def test_incoherent_inputs_add_in_a_modes_participation_as_powers():
    q = np.array([[[3.0, 4.0j]]])
    assert participation(np.array([2.0]), q, np.eye(2)[None])[0, 0] == pytest.approx(10.0)


def test_coherent_inputs_add_in_a_modes_participation_as_amplitudes():
    """S_lr = j: the right input lags by 90° and q_r = 4j turns it back into phase."""
    q = np.array([[[3.0, 4.0j]]])
    S = np.array([[[1.0, 1.0j], [-1.0j, 1.0]]])
    left, right = 1.0, -1.0j
    assert np.outer([left, right], np.conj([left, right])) == pytest.approx(S[0])
    expected = abs(3.0 * left + 4.0j * right)
    assert participation(np.array([1.0]), q, S)[0, 0] == pytest.approx(expected)


def test_peaks_of_a_quarter_car_are_its_two_modes(ride):
    system, modes, forces, heave, S_ff = ride
    q = coordinates(system, modes, F, forces)
    H = modal_response(system, modes, F, forces, heave[None])
    acceleration = response_psd(H, S_ff)[:, 0, 0].real * F**4
    lines = peak_lines(acceleration)
    parts = participation(heave @ modes.shapes, q[lines], S_ff[lines])
    found = peaks(F[lines], acceleration[lines], parts)
    assert [p.contributors[0].mode for p in found] == [0, 1]
    assert all(p.contributors[0].ratio == 1.0 for p in found)
    # Loss factor 0.1 moves a peak by less than half a bandwidth, 5 %.
    assert [p.frequency_hz for p in found] == pytest.approx(list(modes.frequency_hz), rel=0.05)


def test_ripples_are_not_peaks():
    f = np.linspace(1.0, 30.0, 291)
    hill = np.exp(-((f - 12.0) ** 2) / 20.0)
    rippled = hill * 10 ** (0.04 * np.cos(2 * np.pi * 2.0 * (f - 12.0)))
    assert f[peak_lines(rippled)] == pytest.approx([12.0])


def test_peaks_are_those_of_scipy():
    rng = np.random.default_rng(4)
    psd = 10 ** np.cumsum(rng.normal(0, 0.05, 3000))
    level = 10 * np.log10(psd)
    expected, _ = signal.find_peaks(level, prominence=1.0)
    assert peak_lines(psd) == list(expected)
    assert len(expected) > 100


def test_contributors_are_ratios_to_the_largest():
    found = contributors(np.array([2.0, 8.0, 4.0]), 2)
    assert [(c.mode, c.ratio) for c in found] == [(1, 1.0), (2, 0.5)]


def test_silence_has_no_contributors_of_any_size():
    system = on_tyres(wheel("wheel", y=-0.8))
    modes = solve_modes(system)
    q = coordinates(system, modes, F[:1], track_forces(system, F[:1], 20.0)[:, :, [RIGHT]])
    p = participation(np.ones(6), q, np.ones((1, 1, 1)))
    assert [c.ratio for c in contributors(p[0], 3)] == [0.0]


def test_what_would_read_as_nothing_is_not_named():
    found = contributors(np.array([2.0, 0.0101, 0.0099, 0.0]), 4)
    assert [c.mode for c in found] == [0, 1]
    assert f"{found[1].ratio:.2f}" == "0.01"
