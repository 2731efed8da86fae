"""What moves on the screen, against what the solver says of the same results."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from rounding import CABIN, assert_near
from session_commands import Alter, Listener, altered

from modeviz.analysis.deflection_shapes import complex_mode, road_shape, wheel_shape
from modeviz.analysis.mode_tracking import follow, pair_modes
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.components import component_modes, component_shares
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ShowMode
from modeviz.viewer.session.followed_mode import FollowedMode
from modeviz.viewer.session.movement import movement
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ResponseCurve, first_state

FLAT = Conditions("flat", 20.0)
SOFT = {"A": MountRates(6e5, 2e5, 3e5)}


@pytest.fixture(scope="module")
def vehicle():
    return mounted_cabin()


@pytest.fixture(scope="module")
def shown(vehicle):
    """The cab's yaw on softer mounts, compared with the vehicle's own."""
    prepared = prepare(vehicle)
    now, base = solve(prepared, SOFT, FLAT), solve(prepared, {}, FLAT)
    i = now.mode_index("cab yaw")
    track = follow(base, now)
    pairs = pair_modes(base, now, track)
    shape, same = -now.modes.shapes[:, i], base.mode_index("cab yaw")
    return FollowedMode(now, base, i, same, now.names[i], shape, track, pairs, is_detailed=True)


@pytest.fixture
def state(vehicle):
    return first_state(vehicle, vehicle.rates, FLAT)


def test_outlines_are_of_the_mode_that_is_compared_whatever_it_is_called(state, shown):
    state = altered(state, ghost="compared")
    moving = movement(state, replace(shown, same=3))
    same_up_to_phase(moving.other, shown.base.modes.shapes[:, 3])
    assert movement(state, replace(shown, same=None)).other is None


def phase(shape, reference, shown):
    """The mean phase of one shape to another, weighted with mass, rad."""
    return np.angle(np.vdot(reference, shown.now.prepared.system.mass @ shape))


def same_up_to_phase(shape, other):
    i = np.abs(other).argmax()
    np.testing.assert_allclose(shape * (other[i] / shape[i]), other, atol=1e-12 * abs(other[i]))


def test_a_mode_moves_as_it_is_followed(state, shown):
    moving = movement(state, shown)
    assert moving.shape is shown.shape
    assert moving.frequency_hz == shown.now.modes.frequency_hz[shown.mode]
    assert moving.other is None
    assert moving.title == "Cab yaw"


def test_a_damped_mode_is_the_solvers_and_in_phase_with_the_undamped(state, shown):
    moving = movement(altered(state, kind="damped mode"), shown)
    expected = complex_mode(shown.now, shown.mode)
    same_up_to_phase(moving.shape, expected.shape)
    assert moving.frequency_hz == expected.damped_frequency_hz
    assert f"{100 * expected.damping_ratio:.1f} %" in moving.about
    assert np.abs(moving.shape.imag).max() > 1e-3 * np.abs(moving.shape).max()
    assert phase(moving.shape, shown.shape, shown) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("motion", ["mode", "damped mode"])
def test_the_shape_compared_with_moves_in_phase_and_on_the_same_scale(state, shown, motion):
    moving = movement(altered(state, kind=motion, ghost="compared"), shown)
    old = shown.base.mode_index("cab yaw")
    expected = shown.base.modes.shapes[:, old]
    if motion == "damped mode":
        expected = complex_mode(shown.base, old).shape
    same_up_to_phase(moving.other, expected)
    np.testing.assert_allclose(np.abs(moving.other), np.abs(expected), atol=1e-12)
    assert phase(moving.other, shown.shape, shown) == pytest.approx(0, abs=1e-12)


def test_under_the_road_the_reference_moves_as_its_spectrum_says(state, shown):
    curve = ResponseCurve(0, "vertical")
    state = altered(state, kind="operating shape", operating_hz=11.0, curves=(curve,), ghost="compared")
    moving = movement(state, shown)
    assert_near(moving.shape, road_shape(shown.now, 11.0, 0, "vertical"), CABIN, lines=-1)
    assert_near(moving.other, road_shape(shown.base, 11.0, 0, "vertical"), CABIN, lines=-1)
    for shape, results in ((moving.shape, shown.now), (moving.other, shown.base)):
        z = results.prepared.outputs[2] @ shape
        line = np.flatnonzero(np.isclose(results.frequency_hz, 11.0))[0]
        g = (2 * np.pi * 11.0) ** 2 * abs(z) / 9.80665
        assert g**2 == pytest.approx(results.response(0, "vertical")[line], rel=1e-9)
    assert moving.about == "flat, as at seat, vertical"


def test_under_a_wheel_load_points_move_as_the_wheel_response_says(vehicle, state, shown):
    load = vehicle.wheel_loads[0].name
    state = altered(state, kind="operating shape", operating_hz=12.0, load=load)
    moving = movement(state, shown)
    assert_near(moving.shape, wheel_shape(shown.now, load, 12.0), CABIN, lines=-1)
    wheels = solve_wheels(shown.now.prepared, shown.now.rates)
    line = np.flatnonzero(np.isclose(wheels.frequency_hz, 12.0))[0]
    g = (2 * np.pi * 12.0) ** 2 * np.abs(shown.now.prepared.outputs @ moving.shape) / 9.80665
    np.testing.assert_allclose(g, wheels.acceleration_g[line, 0, 0], rtol=1e-9)
    assert moving.about == load


def test_a_component_moves_alone_and_says_what_it_has_of_the_shown_mode(state, shown):
    moving = movement(altered(state, kind="component", component="chassis", component_mode=3), shown)
    system = shown.now.prepared.system
    expected = component_modes(system, "chassis").shapes[:, 3]
    np.testing.assert_allclose(moving.shape, expected, atol=1e-12)
    assert not moving.shape[system.dofs["cab"]].any()
    assert moving.bodies == {"chassis"}
    assert moving.title == "Chassis alone: roll"
    expected = component_shares(system, shown.shape, "chassis")
    assert [s.name for s in moving.shares] == [s.name for s in expected]
    assert [s.share for s in moving.shares] == pytest.approx([s.share for s in expected], abs=1e-12)
    total = sum(share.share for share in moving.shares)
    energy = shown.now.kinetic_energy["chassis"][shown.mode]
    assert total == pytest.approx(energy, rel=1e-9)


@pytest.mark.parametrize(
    ("asked", "subject"),
    [
        ({"kind": "mode"}, "cab yaw"),
        ({"kind": "damped mode"}, "cab yaw damped"),
        ({"kind": "operating shape", "operating_hz": 11.04}, "operating shape 11.0 Hz"),
        ({"kind": "component", "component": "chassis", "component_mode": 3}, "Chassis roll"),
    ],
)
def test_files_are_named_after_what_moves(state, shown, asked, subject):
    assert movement(altered(state, **asked), shown).subject == subject


def test_a_mode_number_that_a_body_does_not_have_is_its_last(state, shown):
    moving = movement(altered(state, kind="component", component="cab", component_mode=99), shown)
    assert moving.title == "Cab alone: yaw"


@pytest.fixture
def session(vehicle, state):
    heard = Listener()
    session = Session(vehicle, state, heard)
    session.answers, failures = heard.answers, heard.failures
    session.start()
    assert session.wait(20)
    yield session
    session.close()
    assert not failures


def test_the_operating_shape_follows_rates_and_frequency(session):
    session.do(Alter(kind="operating shape", operating_hz=11.0))
    session.do(SetRate("A", "lateral", 1e5))
    assert session.wait(20)
    solved = session.answers[-1]
    expected = road_shape(solved.now, 11.0, 0, "lateral")
    np.testing.assert_allclose(solved.movement.shape, expected, rtol=1e-9)
    session.do(Alter(operating_hz=12.5))
    assert session.wait(20)
    again = session.answers[-1]
    assert again.now is solved.now
    np.testing.assert_allclose(again.movement.shape, road_shape(solved.now, 12.5, 0, "lateral"))


def test_what_cannot_move_leaves_what_did_and_says_why(session):
    session.do(Alter(kind="operating shape", operating_hz=11.0))
    assert session.wait(20)
    good = session.answers[-1].movement
    session.do(Alter(operating_hz=99.0))
    session.do(SetRate("A", "lateral", 1e5))
    assert session.wait(20)
    solved = session.answers[-1]
    assert solved.now.rates["A"].lateral == 1e5
    assert solved.movement.shape is good.shape
    assert "99 Hz" in solved.movement.problem
    session.do(Alter(operating_hz=12.0))
    assert session.wait(20)
    assert not session.answers[-1].movement.problem


def test_what_is_drawn_differently_moves_on_unchanged(session):
    session.do(Alter(kind="damped mode"))
    assert session.wait(20)
    before = session.answers[-1].movement
    session.do(Alter(coloring="displacement"))
    assert session.wait(20)
    assert session.answers[-1].movement is before
    session.do(ShowMode("cab roll"))
    assert session.wait(20)
    assert session.answers[-1].movement.title == "~Cab roll"
