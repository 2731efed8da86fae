import numpy as np
import pytest
from scipy import signal
from scipy.integrate import trapezoid
from small_vehicles import on_tyres, wheel
from two_tracks import two_track_profile

from modeviz.dynamics.response import direct_response
from modeviz.errors import ModevizError, VehicleError
from modeviz.ride.roads import LEFT, RIGHT, road_spectrum, track_forces
from modeviz.vehicle.loads import Road

F = np.array([0.5, 2.0, 7.0, 15.0, 40.0])


def table(frequency_hz, left, right, coherence) -> Road:
    """A road met at 20 m/s with the given powers and complex coherence."""
    left, right, coherence = np.broadcast_arrays(left, right, coherence, frequency_hz)[:3]
    cross = coherence * np.sqrt(left * right)
    S = np.stack([left, cross, cross.conj(), right], axis=-1).reshape(-1, 2, 2)
    return Road("test", "test", 20.0, frequency_hz, S)


def uneven_road() -> Road:
    f = np.geomspace(0.2, 60.0, 200)
    return table(f, 1e-5 * f**-2.0, 3e-5 * f**-2.2, 0.8 * np.exp(-f / 20 + 0.4j))


def test_oscillator_follows_the_road_by_its_transmissibility():
    m, k, c, g = 40.0, 2e5, 300.0, 0.04
    system = on_tyres(
        wheel("wheel", y=-0.8, mass=m),
        stiffness=np.array([0.0, 0.0, k]),
        damping=np.array([0.0, 0.0, c]),
        loss_factor=g,
    )
    heave = system.motion("wheel", np.array([0.0, -0.8, 0.0]))[[2]]
    H = direct_response(system, F, track_forces(system, F, 20.0), heave)[:, 0]
    omega = 2 * np.pi * F
    tyre = k * (1 + 1j * g) + 1j * omega * c
    assert H[:, LEFT] == pytest.approx(tyre / (tyre - omega**2 * m), rel=1e-12)
    assert not H[:, RIGHT].any()


def test_wheels_are_pushed_by_their_own_track():
    system = on_tyres(wheel("left", y=-0.8), wheel("right", y=0.8))
    forces = track_forces(system, F, 20.0)
    assert forces[:, system.dofs["left"], LEFT].any()
    assert forces[:, system.dofs["right"], RIGHT].any()
    assert not forces[:, system.dofs["right"], LEFT].any()
    assert not forces[:, system.dofs["left"], RIGHT].any()


@pytest.mark.parametrize(("y", "named", "shares"), [
    (-0.7, None, (1, 0)), (0.7, None, (0, 1)), (0.0, None, (0.5, 0.5)),
    (0.0, "left", (1, 0)), (-0.7, "right", (0, 1)), (0.7, "both", (0.5, 0.5)),
])  # fmt: skip
def test_a_tyre_follows_its_track_and_between_them_the_mean(y, named, shares):
    system = on_tyres(wheel("wheel", y=y), track=named)
    np.testing.assert_allclose(track_forces(system, F, 20.0)[:, 2], 2e5 * np.ones((len(F), 1)) * shares)


def test_a_track_that_no_road_has_is_refused():
    with pytest.raises(VehicleError, match=r"unknown track 'middle': there are left, right"):
        on_tyres(wheel("wheel"), track="middle")


def test_rear_wheel_meets_the_road_a_wheelbase_later():
    wheelbase, speed = 2.98, 20.0
    system = on_tyres(wheel("front", x=-0.1, y=0.7), wheel("rear", x=wheelbase - 0.1, y=0.7))
    forces = track_forces(system, F, speed)[:, :, RIGHT]
    front, rear = forces[:, system.dofs["front"]][:, 2], forces[:, system.dofs["rear"]][:, 2]
    assert front == pytest.approx(np.full(len(F), 2e5), rel=1e-12)
    assert rear == pytest.approx(front * np.exp(-2j * np.pi * F * wheelbase / speed), rel=1e-12)


def test_horizontal_tyre_springs_see_no_road():
    stiffness, damping = np.array([3e5, 1e5, 2e5]), np.array([50.0, 60.0, 70.0])
    body = wheel("wheel")
    every = on_tyres(body, stiffness=stiffness, damping=damping)
    vertical = on_tyres(body, stiffness=stiffness * [0, 0, 1], damping=damping * [0, 0, 1])
    np.testing.assert_array_equal(track_forces(every, F, 20.0), track_forces(vertical, F, 20.0))


def test_tilted_tyre_pushes_along_its_own_axis():
    tilt = np.radians(20.0)
    axis = np.array([0.0, np.sin(tilt), np.cos(tilt)])
    axes = np.array([[1.0, 0.0, 0.0], np.cross(axis, [1.0, 0.0, 0.0]), axis])
    system = on_tyres(wheel("wheel", y=0.7), axes=axes)
    force = track_forces(system, F, 20.0)[0, :3, RIGHT]
    assert force == pytest.approx(2e5 * np.cos(tilt) * axis, rel=1e-12)


def test_table_comes_back_at_its_own_frequencies_and_speed():
    road = uneven_road()
    S = road_spectrum(road, road.frequency_hz, road.speed)
    np.testing.assert_allclose(S, road.spectrum, rtol=1e-12)


def test_power_law_is_interpolated_exactly():
    coarse = np.array([0.5, 3.0, 50.0])
    road = table(coarse, 1e-5 * coarse**-2.5, 4e-5 * coarse**-2.5, 0.3j)
    S = road_spectrum(road, F, 20.0)
    assert S[:, 0, 0] == pytest.approx(1e-5 * F**-2.5, rel=1e-12)
    assert S[:, 0, 1] == pytest.approx(2e-5 * 0.3j * F**-2.5, rel=1e-12)


@pytest.mark.parametrize("speed", [10.0, 33.0])
def test_same_heights_are_met_at_any_speed(speed):
    road = uneven_road()
    f = road.frequency_hz * speed / road.speed
    met = trapezoid(road_spectrum(road, f, speed)[:, 0, 0].real, f)
    assert met == pytest.approx(trapezoid(road.spectrum[:, 0, 0].real, road.frequency_hz), rel=1e-12)


def test_interpolated_matrices_stay_hermitian_and_positive_semidefinite():
    rng = np.random.default_rng(1)
    f = np.geomspace(0.1, 100.0, 40)
    left, right = 10.0 ** rng.uniform(-9, -3, (2, 40))
    road = table(f, left, right, np.exp(2j * np.pi * rng.random(40)))
    S = road_spectrum(road, np.geomspace(0.1, 100.0, 1111), 20.0)
    np.testing.assert_allclose(S, S.conj().transpose(0, 2, 1), rtol=1e-14)
    power = np.linalg.eigvalsh(S)
    assert (power[:, 0] >= -1e-14 * power[:, 1]).all()
    assert (power[:, 0] / power[:, 1]).max() > 1e-3


def test_silent_track_stays_silent():
    f = np.geomspace(0.1, 100.0, 40)
    S = road_spectrum(table(f, 1e-5 / f, 0.0, 0.0), F, 20.0)
    assert np.abs(S[:, :, 1]).max() < 1e-150
    assert S[:, 0, 0] == pytest.approx(1e-5 / F, rel=1e-12)


def test_road_is_not_extrapolated():
    with pytest.raises(
        ModevizError, match=r"'test': found 0\.5 to 40 Hz at 40 m/s.* from 0\.4 to 36 Hz"
    ):
        road_spectrum(table(np.array([0.2, 18.0]), 1e-5, 1e-5, 0.0), F, 40.0)


@pytest.mark.bitwise
def test_same_seed_gives_the_same_profile():
    road = uneven_road()
    first, again, other = (two_track_profile(road, 20.0, 4.0, 200.0, seed) for seed in (7, 7, 8))
    assert first.shape == (800, 2)
    np.testing.assert_array_equal(first, again)
    assert np.abs(first - other).max() > np.abs(first).max() / 10


@pytest.mark.parametrize("speed", [20.0, 30.0])
def test_profile_has_the_spectra_of_the_road(speed):
    road, rate = uneven_road(), 128.0
    profile = two_track_profile(road, speed, 2000.0, rate, seed=3)
    left, right = profile.T
    welch = {"fs": rate, "nperseg": 1024, "noverlap": 0}
    f, S_ll = signal.welch(left, **welch)
    S_rr = signal.welch(right, **welch)[1]
    # scipy conjugates the first argument, the project the second.
    S_lr = signal.csd(left, right, **welch)[1].conj()
    inside = (f > 1.0) & (f < 50.0)
    S = road_spectrum(road, f[inside], speed)
    averages = 2000.0 * rate / 1024
    bins = inside.sum()
    for estimate, exact in (
        (S_ll[inside], S[:, 0, 0].real),
        (S_rr[inside], S[:, 1, 1].real),
        (S_lr[inside], S[:, 0, 1]),
    ):
        scale = np.sqrt(S[:, 0, 0] * S[:, 1, 1]).real if np.iscomplexobj(exact) else exact
        error = (estimate - exact) / scale
        # The standard error of a bin is 1/√averages (of √(S_ll S_rr) for the cross spectrum).
        assert abs(error.mean()) < 4 / np.sqrt(averages * bins)
        assert np.sqrt(np.mean(np.abs(error) ** 2)) == pytest.approx(averages**-0.5, rel=0.15)


def test_right_track_that_follows_the_left_has_a_leading_cross_spectrum():
    """r(t) = l(t - τ) means R = L e^{-jωτ}, so S_lr = E[L R*] = S_ll e^{jωτ}."""
    rate, late = 200.0, 4
    f = np.linspace(0.05, 60.0, 12_000)
    road = table(f, 1e-5 / f**2, 1e-5 / f**2, np.exp(2j * np.pi * f * late / rate))
    left, right = two_track_profile(road, 20.0, 40.0, rate, seed=5).T
    assert right == pytest.approx(np.roll(left, late), abs=5e-3 * left.std())
