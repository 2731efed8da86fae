"""Motions of the ground under connections that are rigid."""

from dataclasses import replace

import numpy as np
import pytest
from full_solutions import receptances
from oracles import Beam
from shaken_blocks import (
    FLAT,
    MASS,
    RATE,
    SHAKER,
    UP,
    F,
    Z,
    bolted_apart,
    bolted_twice,
    cabin_on_table,
    on_table,
    shaken_block,
    softer,
    stiffness_of,
    vertical_peaks,
)

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import AXIS, Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.inputs import directions
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response, modal_response
from modeviz.errors import VehicleError
from modeviz.ride.excitation import excitation, generalised_forces, input_directions
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.connections import GROUND, Rod, Spring
from modeviz.vehicle.loads import BaseMotion, ResponsePoint
from modeviz.vehicle.vehicle import Vehicle


@pytest.mark.parametrize("rate", [RATE, 4e4, 9e5])
def test_what_is_bolted_to_a_shaken_ground_moves_as_it_does(rate):
    found = solve_wheels(prepare(on_table(shaken_block(SHAKER))), softer(rate))
    omega = 2 * np.pi * found.frequency_hz
    moved = found.acceleration_g[:, 0, 1] * STANDARD_GRAVITY
    np.testing.assert_allclose(moved[:, AXIS["vertical"]], Z * omega**2, rtol=1e-9)
    assert moved[:, : AXIS["vertical"]].max() < 1e-9 * moved.max()


@pytest.mark.parametrize("rate", [RATE, 4e4, 9e5])
def test_mounts_on_what_is_bolted_to_a_shaken_ground_transmit_as_the_textbook_says(rate):
    found = vertical_peaks(on_table(shaken_block(SHAKER)), softer(rate))
    omega, k = 2 * np.pi * F, stiffness_of(rate, F)
    expected = np.abs(k / (k - MASS * omega**2)) * Z * omega**2
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-9)


def test_a_white_acceleration_of_the_ground_gives_a_light_oscillator_its_closed_form():
    """(π/2) f_n W (1 + 4ζ²) / 2ζ, less W times what of (1 - (f/f_n)²)⁻² lies out of the band."""
    natural_hz, zeta, level = 9.97, 0.001, 2e-3
    rate = MASS * (2 * np.pi * natural_hz) ** 2
    dashpot = np.full(3, 2 * zeta * np.sqrt(rate * MASS))
    spring = Spring("spring", "springs", ("block", GROUND), np.zeros((2, 3)), np.full(3, rate),
                    rotational_stiffness=np.full(3, 1e5), damping=dashpot)  # fmt: skip
    shaken = shaken_block(BaseMotion("white", UP, "acceleration", FLAT))
    vehicle = on_table(replace(shaken, connections=(spring,), mount_groups=()))
    results = solve(prepare(vehicle), {}, Conditions("white", 20.0))
    closed = np.pi / 2 * natural_hz * level * (1 + 4 * zeta**2) / (2 * zeta)
    beyond = level * (0.1 + natural_hz**4 / (3 * 40.0**3))
    found = (results.rms[0, AXIS["vertical"]] * STANDARD_GRAVITY) ** 2
    assert found == pytest.approx(closed - beyond, rel=1e-3)


def beam_on_posts(*loads, rate=None):
    """A beam on two posts and a bushing; the posts are rigid joints, or springs of so high a rate."""
    beam = Beam(8, 2.0).body("beam", damping_ratio=0.01)
    held = {"rigid": ("x", "y", "z")} if rate is None else {"stiffness": np.full(3, rate)}
    posts = (
        Spring(f"post {x}", "posts", ("beam", GROUND), np.tile([x, 0.0, 0.0], (2, 1)), **held)
        for x in (0.0, 1.5)
    )
    bushing = Spring("bushing", "bushings", ("beam", GROUND), np.tile([1.0, 0, 0], (2, 1)),
                     np.full(3, 5e4), np.full(3, 2e3), np.full(3, 200.0), loss_factor=0.1)  # fmt: skip
    return Vehicle(
        "beam", (beam,), (*posts, bushing), base_motions=loads,
        response_points=(ResponsePoint("tip", "beam", np.array([2.0, 0.0, 0.0])),),
    )  # fmt: skip


SLANTED = np.array([0.1, 0.5, 1.0])
POSTS = BaseMotion("posts", SLANTED, "displacement", Z, ("post 0.0", "post 1.5"))
LINES = np.array([0.7, 4.0, 11.0, 29.0])


def moved_by(vehicle, load):
    """The system, what acts on it and how far its tip moves, by the equations of motion."""
    system = assemble(vehicle)
    actions = generalised_forces(system, load, LINES, 20.0)
    tip = system.motion("beam", np.array([2.0, 0.0, 0.0]))
    return system, actions, direct_response(system, LINES, actions, tip)


def test_a_shaken_rigid_joint_is_the_limit_of_stiff_springs():
    rigid = moved_by(beam_on_posts(POSTS), POSTS)[2]

    def distance(rate):
        return np.abs(moved_by(beam_on_posts(POSTS, rate=rate), POSTS)[2] - rigid).max()

    # To first order what yields is 1/k.
    assert distance(1e9) == pytest.approx(distance(1e8) / 10, rel=0.1)
    assert distance(1e9) < 1e-2 * np.abs(rigid).max()


def test_shaking_all_of_the_ground_slowly_moves_all_of_a_body_alike():
    everywhere = BaseMotion("everywhere", SLANTED, "displacement", Z)
    vehicle = beam_on_posts(everywhere)
    system = assemble(vehicle)
    slow = np.array([1e-3])
    tip = system.motion("beam", np.array([2.0, 0.0, 0.0]))
    found = direct_response(system, slow, generalised_forces(system, everywhere, slow, 20.0), tip)
    expected = np.r_[Z * SLANTED / np.linalg.norm(SLANTED), np.zeros(3)]
    # The first mode is near 10 Hz: what it adds is (f/f_n)².
    np.testing.assert_allclose(found[0, :, 0], expected, atol=1e-7 * Z)


def test_modes_and_receptances_answer_a_shaken_joint_as_the_equations_of_motion_do():
    system, actions, expected = moved_by(beam_on_posts(POSTS), POSTS)
    tip = system.motion("beam", np.array([2.0, 0.0, 0.0]))
    modal = modal_response(system, solve_modes(system), LINES, actions, tip)
    assert np.abs(modal - expected).max() < 1e-8 * np.abs(expected).max()
    rows = directions(system, tip, input_directions(system))
    inputs = excitation(system.vehicle, POSTS, LINES, 20.0, np.zeros(0, complex)).forces
    found = receptances(system, LINES, rows)[:, :6, 6:] @ inputs
    assert np.abs(found - expected).max() < 1e-8 * np.abs(expected).max()


def test_many_sets_of_rates_at_once_are_each_alone():
    prepared = prepare(cabin_on_table(), LINES)
    driven = prepared.excited(prepared.vehicle.harmonic_loads, 20.0)
    sets = np.outer([0.5, 1.0, 3.0], prepared.mount_stiffness({}))
    for stiffness, H in zip(sets, driven.responses(sets), strict=True):
        expected = driven.response(stiffness)
        assert np.abs(H - expected).max() < 1e-9 * np.abs(expected).max()


def shaken_table():
    """A block on a mount and a dashpot on a shaken table, and the same at random."""
    return on_table(shaken_block(SHAKER, BaseMotion("random", UP, "acceleration", FLAT)))


def test_the_parts_of_a_peak_are_its_modes_and_what_is_led_without_any():
    """The block moves in its one vertical mode, the table in none."""
    results = solve(prepare(shaken_table()), softer(6e4), Conditions("random", 20.0))
    f = np.array([4.0, 11.0])
    one = np.ones((len(f), 1, 1), complex)
    seat, on_table = (
        results.participation(results.prepared.outputs[3 * point + AXIS["vertical"]], SHAKER, f, one)
        for point in (0, 1)
    )
    k = stiffness_of(6e4, f)
    bounce = np.abs(results.modes.frequency_hz - np.sqrt(6e4 / MASS) / (2 * np.pi)).argmin()
    expected = Z * np.abs(k / (k - MASS * (2 * np.pi * f) ** 2))
    np.testing.assert_allclose(seat[:, bounce], expected, rtol=1e-9)
    np.testing.assert_allclose(on_table[:, -1], Z, rtol=1e-12)
    assert np.delete(on_table, -1, axis=1).max() < 1e-9 * Z
    assert np.delete(seat, bounce, axis=1).max() < 1e-9 * Z


def test_a_rigid_rod_leads_along_its_line_alone():
    rod = Rod.between("rod", "rods", ("block", GROUND), np.array([[0, 0, 0], [0, 1.0, 0]]), rigid=True)
    feet = Spring("feet", "springs", ("block", GROUND), np.zeros((2, 3)), np.full(3, 1e5),
                  np.full(3, 1e4), np.full(3, 50.0))  # fmt: skip
    push = BaseMotion("push", np.array([0.0, 3.0, 4.0]), "displacement", Z, ("rod",))
    vehicle = replace(shaken_block(), connections=(feet, rod), mount_groups=(), base_motions=(push,))
    found = solve_wheels(prepare(vehicle), {})
    omega = 2 * np.pi * found.frequency_hz
    g = found.acceleration_g[:, 0, 0] * STANDARD_GRAVITY
    np.testing.assert_allclose(g[:, AXIS["lateral"]], 0.6 * Z * omega**2, rtol=1e-9)
    assert np.delete(g, AXIS["lateral"], axis=1).max() < 1e-9 * g.max()


def test_joints_that_hold_the_same_lead_it_together():
    found, expected = (
        solve_wheels(prepare(vehicle, F), {}).acceleration_g
        for vehicle in (bolted_twice(), on_table(shaken_block(SHAKER)))
    )
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-10 * expected.max())


def test_joints_that_would_have_to_part_are_refused_by_name():
    words = r"base motion 'shaker': '(bolt|again)' .*all rigid connections to the ground"
    with pytest.raises(VehicleError, match=words):
        prepare(bolted_apart())
