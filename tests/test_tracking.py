"""Modes followed where their way is known: crossings, veerings, repeated modes, a band that ends."""

from dataclasses import replace

import numpy as np
import pytest
from test_modes import mass_on_a_string, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.naming import name_modes, prepare_names
from modeviz.dynamics.tracking import STEP_MAC, follow, start_track, step
from modeviz.vehicle.connections import MountRates
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
from modeviz.vehicle.vehicle import Vehicle

N_FREE = 10
"""Two bodies that are held in z alone have ten free motions."""

FIXED, RISING = N_FREE, N_FREE + 1
"""The two that vibrate, in their order at the start."""


def pair(k_rising, coupling=0.0):
    """A unit mass on 1e4 N/m and one on `k_rising`, joined by a spring."""
    springs = [spring(("a", "ground"), 1e4), spring(("b", "ground"), k_rising)]
    if coupling:
        springs.append(spring(("a", "b"), coupling))
    bodies = mass_on_a_string("a", 1.0), mass_on_a_string("b", 1.0)
    return assemble(Vehicle("pair", bodies, tuple(springs)))


def modes_of_pair(k_rising, coupling=0.0):
    return solve_modes(pair(k_rising, coupling))


def follow_pair(ks, coupling, steps=1):
    """The two modes of a pair followed while one rate goes from ks[0] to ks[1]."""

    def modes_at(s):
        return modes_of_pair(ks[0] + s * (ks[1] - ks[0]), coupling)

    track = start_track(pair(ks[0], coupling), modes_at(0), N_FREE + 2)
    for i in range(steps):
        track = follow(track, modes_at((i + 1) / steps), lambda s, i=i: modes_at((i + s) / steps))
    return track, modes_at(1)


def nothing_between(s):
    raise AssertionError(f"asked for the modes at {s}")


def angle(k_rising, coupling):
    """Of the lower branch, from body a: tan 2θ = 2k_c / (k_b - k_a)."""
    return np.arctan2(2 * coupling, k_rising - 1e4) / 2


@pytest.mark.parametrize("ks", [(0.5e4, 2e4), (2e4, 0.5e4)])
def test_modes_that_cross_go_through_each_other(ks):
    track, modes = follow_pair(ks, coupling=0.0)
    lower, upper = track.index[[FIXED, RISING]]
    start_is_a = ks[0] > 1e4
    k_of = (1e4, ks[1]) if start_is_a else (ks[1], 1e4)
    np.testing.assert_allclose(
        modes.frequency_hz[[lower, upper]], np.sqrt(k_of) / (2 * np.pi), rtol=1e-9
    )
    assert lower > upper
    np.testing.assert_allclose(track.mac, 1.0, rtol=1e-9)
    assert not track.weak.any()


def test_modes_go_through_a_step_that_meets_them_crossing():
    track = start_track(pair(0.8e4), modes_of_pair(0.8e4), N_FREE + 2)
    for k in (1e4, 1.25e4):
        track = step(track, modes_of_pair(k))
    assert list(track.index[N_FREE:]) == [RISING, FIXED]
    np.testing.assert_allclose(track.step_mac, 1.0, rtol=1e-9)


def test_modes_that_veer_stay_on_their_branches_while_their_shapes_change_places():
    coupling = 1e3
    ks = (0.5e4, 2e4)
    track, modes = follow_pair(ks, coupling)
    # ω² = (k_a + k_b)/2 + k_c ∓ √((k_b - k_a)²/4 + k_c²): apart by 2 k_c where they would cross.
    middle, half = (1e4 + ks[1]) / 2 + coupling, np.hypot((ks[1] - 1e4) / 2, coupling)
    np.testing.assert_allclose(
        modes.omega_n_squared[track.index[N_FREE:]], [middle - half, middle + half], rtol=1e-9
    )
    turned = angle(ks[1], coupling) - angle(ks[0], coupling)
    np.testing.assert_allclose(track.mac[N_FREE:], np.cos(turned) ** 2, rtol=1e-6)
    assert track.mac[FIXED] < 0.1
    assert track.step_mac.min() >= STEP_MAC
    assert list(track.weak) == [False] * N_FREE + [True] * 2
    assert track.split(FIXED, 1) == [(RISING, pytest.approx(np.sin(turned) ** 2))]


def test_a_veering_within_two_thousandths_is_passed_as_a_crossing():
    coupling = 20.0  # frequencies are apart by k_c / 1e4 where they veer
    for steps in (1, 50):
        track, _ = follow_pair((0.5e4, 2e4), coupling, steps)
        assert list(track.index[N_FREE:]) == [RISING, FIXED]
        assert not track.weak.any()


@pytest.mark.parametrize("coupling", [0.0, 1e3])
def test_a_jump_arrives_where_small_steps_do(coupling):
    jump, _ = follow_pair((0.5e4, 2e4), coupling)
    walk, _ = follow_pair((0.5e4, 2e4), coupling, steps=200)
    assert list(jump.index[N_FREE:]) == list(walk.index[N_FREE:])
    np.testing.assert_allclose(jump.mac[N_FREE:], walk.mac[N_FREE:], rtol=1e-6)


def test_only_the_part_of_a_path_that_needs_it_is_halved():
    asked = []

    def modes_at(s):
        asked.append(s)
        return modes_of_pair(0.5e4 + 1.5e4 * s, 1e3)

    follow(start_track(pair(0.5e4, 1e3), modes_at(0), N_FREE + 2), modes_at(1), modes_at)
    between = np.array(sorted(asked[2:]))
    # They veer at 1e4 N/m, a third of the way.
    assert np.diff(between).min() < 0.1
    assert (between < 0.6).sum() > 2 * (between > 0.6).sum()


def test_an_ordinary_event_asks_for_no_modes_between():
    for ks, coupling in (((2e4, 1.98e4), 1e3), ((0.99e4, 1.01e4), 0.0)):  # the second cross
        start = start_track(pair(ks[0], coupling), modes_of_pair(ks[0], coupling), N_FREE + 2)
        track = follow(start, modes_of_pair(ks[1], coupling), nothing_between)
        assert not track.weak.any()


def test_of_close_modes_each_goes_on_at_its_own_frequency():
    track = step(start_track(pair(0.99e4), modes_of_pair(0.99e4), 12), modes_of_pair(1.01e4))
    np.testing.assert_allclose(
        track.frequency_hz[N_FREE:], np.sqrt([1.01e4, 1e4]) / (2 * np.pi), rtol=1e-9
    )


def test_repeated_modes_keep_their_identity_however_the_solver_mixes_them():
    start = modes_of_pair(1e4)
    track = start_track(pair(1e4), start, N_FREE + 2)
    for degrees in (0, 30, 75, 140):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        mixed = start.shapes.copy()
        mixed[:, N_FREE:] = start.shapes[:, N_FREE:] @ np.array([[c, -s], [s, c]])
        track = step(track, replace(start, shapes=mixed))
        np.testing.assert_allclose(track.mac, 1.0, rtol=1e-9)
        assert sorted(track.index[N_FREE:]) == [FIXED, RISING]


def test_a_repeated_pair_that_parts_is_not_uncertain():
    start = modes_of_pair(1e4)
    c = np.sqrt(0.5)
    shapes = start.shapes.copy()
    shapes[:, N_FREE:] = start.shapes[:, N_FREE:] @ np.array([[c, -c], [c, c]])
    track = start_track(pair(1e4), replace(start, shapes=shapes), N_FREE + 2)
    track = step(track, modes_of_pair(1.5e4))
    assert not track.weak.any()


def test_modes_are_assigned_as_a_whole():
    # MAC [[.4, .35], [.35, .05]]: the largest first would leave .05 to the other mode.
    x = -2 * (np.sqrt(0.4 * 0.35) - np.sqrt(0.35 * 0.05))
    new = np.array(
        [
            [np.sqrt(0.4), np.sqrt(0.35), 0.5, 0, 0, 0],
            [np.sqrt(0.35), -np.sqrt(0.05), x, np.sqrt(0.6 - x**2), 0, 0],
        ]
    ).T
    np.testing.assert_allclose(new.T @ new, np.eye(2), atol=1e-12)
    system = assemble(Vehicle("one", (mass_on_a_string("a", 1.0),), ()))  # its mass matrix is one
    f, damping = np.array([1.0, 2.0]), np.zeros(2)
    track = start_track(system, Modes(f, np.eye(6)[:, :2], damping), 2)
    track = step(track, Modes(f, new, damping))
    assert list(track.index) == [1, 0]
    np.testing.assert_allclose(track.shares, [[0.4, 0.35], [0.35, 0.05]])
    np.testing.assert_allclose(track.mac, [0.35, 0.35])
    np.testing.assert_allclose(track.step_mac, [0.35, 0.35])


def test_a_shape_that_comes_back_over_a_doubtful_step_stays_uncertain():
    system = assemble(Vehicle("one", (mass_on_a_string("a", 1.0),), ()))
    start = Modes(np.array([1.0]), np.eye(6)[:, :1], np.zeros(1))
    away = replace(start, shapes=np.array([[0.8, 0.6, 0, 0, 0, 0]]).T)
    track = step(step(start_track(system, start, 1), away), away)
    np.testing.assert_allclose([track.step_mac[0], track.last_mac[0]], [0.64, 1.0])
    back = step(track, start)
    assert back.mac[0] == pytest.approx(1.0)
    assert back.weak[0]


def three(k):
    """Three uncoupled unit masses on 1, `k` and 3 x 1e4 N/m."""
    names = "abc"
    springs = tuple(spring((n, "ground"), s) for n, s in zip(names, (1e4, k * 1e4, 3e4), strict=True))
    return assemble(Vehicle("three", tuple(mass_on_a_string(n, 1.0) for n in names), springs))


def test_a_mode_that_leaves_the_band_gives_its_identity_to_nobody_and_finds_it_again():
    n_free = 15

    def lowest(k):
        return solve_modes(three(k), n_free + 2)

    track = start_track(three(2.0), lowest(2.0), n_free + 2)
    track = follow(track, lowest(4.0), lambda s: lowest(2.0 + 2.0 * s))
    assert list(track.index[n_free:]) == [n_free, -1]
    assert track.mac[-1] == track.last_mac[-1] == 0.0
    assert track.shares[-1].sum() == pytest.approx(0.0, abs=1e-9)
    assert list(track.weak[n_free:]) == [False, True]
    assert np.isnan(track.frequency_hz[-1])
    track = follow(track, lowest(4.1), nothing_between)
    back = follow(track, lowest(2.0), lambda s: lowest(4.1 - 2.1 * s))
    assert list(back.index[n_free:]) == [n_free, n_free + 1]


def test_what_is_not_followed_does_not_make_the_steps_smaller():
    asked = []

    def lowest(k):
        asked.append(k)
        return solve_modes(three(k), 17)

    track = follow(start_track(three(2.0), lowest(2.0), 16), lowest(4.0), lowest)
    assert asked == [2.0, 4.0]
    assert track.index[-1] == -1


def test_cab_yaws_shape_on_the_truck_goes_two_ways_while_its_motion_goes_one():
    system = assemble(read_vehicle(builtin_vehicle()))
    original, optimised = (system.vehicle.rate_sets[name] for name in ("original", "optimised"))

    def modes_at(s):
        rates = {}
        for group, o in original.items():
            ratios = np.divide(optimised[group].as_tuple(), o.as_tuple())
            rates[group] = MountRates(*(o.as_tuple() * ratios**s))
        return solve_modes(system.with_rates(rates), 40)

    def yaw(modes):
        names = [n.name for n in name_modes(namer, modes)]
        return names.index("cab yaw")

    namer = prepare_names(system)
    start, modes = modes_at(0), modes_at(1)
    old, by_motion = yaw(start), yaw(modes)
    track = follow(start_track(system, start, 25), modes, modes_at)
    (first, first_share), (second, second_share) = track.split(old, 2)
    assert {first, second} == {by_motion, int(track.index[old])}
    assert by_motion != track.index[old]
    assert track.weak[old]
    assert 0.85 < first_share + second_share < 1.0
    assert track.mac[old] == pytest.approx(min(first_share, second_share))
