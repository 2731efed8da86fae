import numpy as np
import pytest
from small_vehicles import on_tyres, wheel

from modeviz.dynamics.response import direct_response
from modeviz.ride.psd import (
    acceleration_psd,
    amplitude_decibels,
    harmonic_acceleration,
    power_decibels,
    rms,
)
from modeviz.ride.roads import track_forces
from modeviz.units import STANDARD_GRAVITY

RNG = np.random.default_rng(2)
H = RNG.standard_normal((5, 3, 2)) + 1j * RNG.standard_normal((5, 3, 2))
H_l, H_r = H[:, :, 0], H[:, :, 1]


def tracks(left: float, right: float, cross: complex) -> np.ndarray:
    return np.tile(np.array([[left, cross], [np.conj(cross), right]], complex), (5, 1, 1))


def powers(S_ff: np.ndarray) -> np.ndarray:
    """Of displacements: accelerations at 1 rad/s, m²/s⁴/Hz."""
    return acceleration_psd(np.full(5, 1 / (2 * np.pi)), H, S_ff) * STANDARD_GRAVITY**2


def test_coherent_tracks_add_as_amplitudes():
    assert powers(tracks(2.0, 2.0, 2.0)) == pytest.approx(np.abs(H_l + H_r) ** 2 * 2.0, rel=1e-12)


def test_antiphase_tracks_subtract_as_amplitudes():
    assert powers(tracks(2.0, 2.0, -2.0)) == pytest.approx(np.abs(H_l - H_r) ** 2 * 2.0, rel=1e-12)


def test_incoherent_tracks_add_as_powers():
    expected = np.abs(H_l) ** 2 * 2.0 + np.abs(H_r) ** 2 * 3.0
    assert powers(tracks(2.0, 3.0, 0.0)) == pytest.approx(expected, rel=1e-12)


def test_response_is_the_papers_three_terms():
    """|H_l|² P_ll + |H_r|² P_rr + 2 Re[H_r H_l* P_lr*] (A. E. Duncan, after Howell)."""
    cross = 1.1 - 0.7j
    expected = (
        np.abs(H_l) ** 2 * 2.0 + np.abs(H_r) ** 2 * 3.0 + 2 * np.real(H_r * H_l.conj() * np.conj(cross))
    )
    assert powers(tracks(2.0, 3.0, cross)) == pytest.approx(expected, rel=1e-12)


def test_acceleration_of_a_rigid_ride_is_omega_to_the_fourth_times_the_road():
    f = np.array([1.0, 2.0, 10.0])
    G = acceleration_psd(f, np.ones((3, 1, 1)), np.full((3, 1, 1), 1e-6))
    assert G[:, 0] == pytest.approx((2 * np.pi * f) ** 4 * 1e-6 / 9.80665**2, rel=1e-12)


def test_response_that_cancels_has_no_negative_power():
    """A table's rounding may take the coherence of two equal tracks just above one."""
    coherent = np.array([[[1.0, 1.0 + 1e-10], [1.0 + 1e-10, 1.0]]])
    G = acceleration_psd(np.array([10.0]), np.array([[[1.0, -1.0]]]), coherent)
    assert G[0, 0] == 0.0


@pytest.mark.parametrize("zeta", [0.02, 0.2])
def test_oscillator_shaken_by_white_acceleration_has_the_closed_form_rms(zeta):
    """ü² = (π/2) f_n W (1 + 4ζ²) / 2ζ, W one-sided per Hz (Crandall and Mark 1963)."""
    m, k, W = 40.0, 2e5, 1e-3
    omega_n = np.sqrt(k / m)
    f_n = omega_n / (2 * np.pi)
    f = f_n * np.geomspace(1e-3, 1e3, 6000)
    system = on_tyres(wheel("wheel", y=0.7, mass=m), damping=np.array([0, 0, 2 * zeta * m * omega_n]))
    heave = system.motion("wheel", np.zeros(3))[[2]]
    response = direct_response(system, f, track_forces(system, f, 20.0), heave)[:, :, 1:]
    ground = W * STANDARD_GRAVITY**2 / (2 * np.pi * f) ** 4
    G = acceleration_psd(f, response, ground[:, None, None])
    mean_square = rms(f, G, band=(f[0], f[-1]))[0] ** 2
    # Beyond the band lie W f_n/1000 below and (2ζ f_n)² W / (1000 f_n) above; the trapezia of 0.23 %
    # in frequency against a peak 2ζ wide leave (0.0023/2ζ)²/6.
    exact = np.pi / 2 * f_n * W * (1 + 4 * zeta**2) / (2 * zeta)
    assert mean_square == pytest.approx(exact, rel=2e-3 * zeta + 0.0023**2 / (24 * zeta**2))


def test_rms_of_a_straight_spectrum_is_exact_between_grid_points():
    f = np.array([1.0, 4.0, 9.0, 20.0])
    assert rms(f, 3.0 + 2.0 * f, band=(2.0, 11.0)) ** 2 == pytest.approx(27.0 + 11**2 - 2**2, rel=1e-12)


def test_rms_counts_only_what_the_spectrum_covers():
    f = np.linspace(0.5, 60.0, 120)
    white = np.column_stack([np.full(120, 2.0), np.full(120, 8.0)])
    assert rms(f, white) ** 2 == pytest.approx(np.array([2.0, 8.0]) * 39.5, rel=1e-12)
    assert rms(f, white, band=(50.0, 90.0)) ** 2 == pytest.approx(np.array([20.0, 80.0]), rel=1e-12)


def test_millimetre_at_ten_hertz_is_four_tenths_of_g():
    f = np.array([10.0, 20.0])
    G = harmonic_acceleration(f, np.full((2, 3), 1e-3j))
    assert G[0] == pytest.approx(3.94784176 / 9.80665, rel=1e-8)
    assert G[1] == pytest.approx(4 * G[0], rel=1e-12)


def test_decibels_of_power_and_amplitude():
    assert power_decibels(np.array([1.0, 1e-3, 0.0])) == pytest.approx([0.0, -30.0, -200.0])
    assert amplitude_decibels(np.array([1.0, 1e-2, 0.0])) == pytest.approx([0.0, -40.0, -200.0])
