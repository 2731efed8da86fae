"""Progressive mounts: where they settle by hand, and the rates with which they vibrate there."""

from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import MAXWELL
from progressive_block import CURVE, MASS, progressive_block, progressive_group
from small_systems import block

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.sensitivity import frequency_sensitivity, rate_variables
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError, VehicleError
from modeviz.mounting import settling
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.progressive import ForceCurve
from modeviz.vehicle.vehicle import Vehicle

WEIGHT = MASS * STANDARD_GRAVITY
SETTLED = -0.005 - (WEIGHT - 500.0) / 300e3
"""m: beyond the corner of the curve."""


def scaled(factor: float) -> dict[str, MountRates]:
    """Its rates with the vertical curve so many times as high."""
    return {"m": MountRates(1.3e5 * factor, 1e6, 1e6)}


def statics_of(vehicle, rates):
    return solve_statics(prepare_statics(assemble(vehicle)), rates)


def vertical_hz(prepared, rates):
    """The frequency of the mode that moves up and down alone."""
    results = solve_modal(prepared, rates)
    up = np.abs(results.modes.shapes[2]).argmax()
    return results.modes.frequency_hz[up]


def test_a_block_settles_beyond_the_corner_as_by_hand():
    case = statics_of(progressive_block(), {}).case("standing")
    assert case.bodies["block"][2] == pytest.approx(SETTLED)
    assert case.connections["m"].force[2] == pytest.approx(WEIGHT)


@pytest.mark.parametrize("factor", [0.3, 1.0, 1.9, 2.0, 5.0])
def test_a_slider_scales_the_curve(factor):
    case = statics_of(progressive_block(), scaled(factor)).case("bump 3 g")
    load = 3 * WEIGHT / factor
    by_hand = load / 100e3 if load < 500 else 0.005 + (load - 500.0) / 300e3
    assert case.bodies["block"][2] == pytest.approx(-by_hand)
    assert case.connections["m"].force[2] == pytest.approx(3 * WEIGHT)


@pytest.mark.parametrize(("factor", "tangent"), [(1.0, 300e3), (1.5, 450e3), (2.5, 250e3)])
def test_it_vibrates_with_its_tangent_where_it_stands(factor, tangent):
    """By its static ratio stiffer; at 2.5 times the curve it stands before the corner."""
    prepared = prepare_modes(progressive_block())
    expected = np.sqrt(1.3 * tangent / MASS) / (2 * np.pi)
    assert vertical_hz(prepared, scaled(factor)) == pytest.approx(expected)
    own = prepare_modes(
        replace(
            progressive_block(), mount_groups=(progressive_group().with_rates(scaled(factor)["m"]),)
        )
    )
    assert vertical_hz(own, {}) == pytest.approx(expected)


def test_a_curve_that_is_straight_changes_nothing():
    straight = ForceCurve(np.array([-0.01, 0.02]), np.array([-1000.0, 2000.0]))
    curved, plain = (prepare_modes(progressive_block(curves=c)) for c in ({"vertical": straight}, {}))
    for rates in ({}, scaled(3.0)):
        found, expected = (solve_modal(p, rates).modes.frequency_hz for p in (curved, plain))
        assert found == pytest.approx(expected, rel=1e-12)
    sags = [statics_of(progressive_block(curves=c), scaled(0.5)) for c in ({"vertical": straight}, {})]
    one, other = (s.case("braking 1 g").motion for s in sags)
    assert one == pytest.approx(other, rel=1e-9, abs=1e-12)


def test_responses_on_progressive_mounts_are_those_of_mounts_with_their_tangents():
    """At other rates than the prepared ones, against a plain vehicle with three times the rate."""
    prepared, rates = prepare(progressive_block()), scaled(1.5)
    plain = prepare(progressive_block(curves={}))
    found = solve_wheels(prepared, rates).acceleration_g
    expected = solve_wheels(plain, scaled(3 * 1.5)).acceleration_g
    assert found == pytest.approx(expected, rel=1e-8, abs=1e-12)


def test_rubber_that_depends_on_frequency_stiffens_with_its_tangent():
    """Against a plain mount of three times the vertical rate with the same rubber."""
    curved, plain = (
        progressive_block(curves=curves, dynamic=MAXWELL) for curves in ({"vertical": CURVE}, {})
    )
    for found, expected in ((scaled(1.5), scaled(4.5)), ({}, scaled(3.0))):
        frequencies = [
            solve_modal(prepare_modes(v), r).modes.frequency_hz
            for v, r in ((curved, found), (plain, expected))
        ]
        assert frequencies[0] == pytest.approx(frequencies[1], rel=1e-8)
        responses = [solve_wheels(prepare(v), r) for v, r in ((curved, found), (plain, expected))]
        same = np.isin(responses[0].frequency_hz, responses[1].frequency_hz)
        assert same.sum() > 300
        there = np.isin(responses[1].frequency_hz, responses[0].frequency_hz)
        np.testing.assert_allclose(
            responses[0].acceleration_g[same], responses[1].acceleration_g[there], rtol=1e-6, atol=1e-12
        )


def test_energies_and_exact_modes_have_the_tangents():
    prepared, rates = prepare_modes(progressive_block()), scaled(1.5)
    found, exact = solve_modal(prepared, rates), solve_modal(prepared, rates, "exact")
    assert found.modes.frequency_hz == pytest.approx(exact.modes.frequency_hz, rel=1e-7)
    assert found.system.stiffness[2, 2] == pytest.approx(1.3 * 450e3)
    assert found.strain_energy["m"] == pytest.approx(np.ones(6))
    assert found.vehicle.mounts[0].stiffness[2] == pytest.approx(1.3 * 450e3)


def test_derivatives_by_a_progressive_rate_equal_finite_differences():
    vehicle = progressive_block()
    prepared, step = prepare_modes(vehicle), 1e-4
    results = solve_modal(prepared, scaled(1.5))
    column = [v.direction for v in rate_variables(vehicle)].index("vertical")
    change = [
        solve_modal(prepared, scaled(1.5 * (1 + sign * step))).modes.frequency_hz for sign in (1, -1)
    ]
    difference = (change[0] - change[1]) / (2 * step * 1.5 * 1.3e5)
    assert frequency_sensitivity(results)[:, column] == pytest.approx(difference, rel=1e-5, abs=1e-12)


def test_mounts_of_a_group_each_have_the_tangent_of_their_own_load():
    """A block off the middle of two: one beyond the corner, the other before it."""
    group = progressive_group()
    mounts = tuple(
        Mount(name, "m", ("block", GROUND), np.array([[x, 0, 0], [x, 0, 0]]))
        for name, x in (("near", 0.1), ("far", -0.9))
    )
    vehicle = Vehicle(
        "two",
        (block("block", MASS),),
        (),
        (replace(group, mounts=mounts, rotational_stiffness=np.array([1e5, 0, 0])),),
    )
    prepared = prepare_modes(vehicle)
    at_work = {mount.name: mount.stiffness[2] for mount in prepared.vehicle.mounts}
    assert at_work == pytest.approx({"near": 1.3 * 300e3, "far": 1.3 * 100e3})
    case = statics_of(vehicle, {}).case("standing")
    assert case.connections["near"].force[2] == pytest.approx(0.9 * WEIGHT)
    assert case.connections["near"].deflection[2] == pytest.approx(
        -0.005 - (0.9 * WEIGHT - 500) / 300e3
    )
    assert case.connections["far"].deflection[2] == pytest.approx(-0.1 * WEIGHT / 100e3)


def test_many_corners_settle_wherever_the_load_is():
    """A bump stop: a hundred thousand times as stiff as what is before it, both ways."""
    stop = ForceCurve(
        np.array([-0.0101, -0.01, 0.0, 0.004, 0.0041]), np.array([-1e6, -100.0, 0.0, 10.0, 1e6])
    )
    for force in (-5e4, -150.0, -50.0, 0.5, 11.0, 5e5):
        push = LoadCase("push", np.zeros(3), (StaticLoad("block", np.array([30.0, -20.0, force])),))
        vehicle = replace(
            progressive_block(curves={"vertical": stop, "lateral": stop}), load_cases=(push,)
        )
        group = vehicle.mount_groups[0]
        rates = MountRates(1.3 * stop.rate, 1.3 * stop.rate, 1e6)
        case = statics_of(replace(vehicle, mount_groups=(group.with_rates(rates),)), {}).case("push")
        carried = case.connections["m"]
        assert carried.force[:3] == pytest.approx([-30.0, 20.0, -force], rel=1e-6)
        assert stop.at(carried.deflection[2:3])[0] == pytest.approx(force, rel=1e-6)


def test_mounts_that_do_not_settle_say_which_and_where(monkeypatch):
    monkeypatch.setattr(settling, "MOST_STEPS", 0)
    words = "'standing': the mounts do not settle within 0 steps; mount 'm' along z is 961 N off its"
    with pytest.raises(SolveError, match=words):
        statics_of(progressive_block(), {})


def test_a_vehicle_that_nothing_holds_works_unloaded():
    """Two blocks on a mount between them, free: nothing presses on it."""
    group = progressive_group()
    mount = replace(group.mounts[0], bodies=("block", "other"))
    vehicle = Vehicle("free", (block("block"), block("other")), (), (replace(group, mounts=(mount,)),))
    assert prepare_modes(vehicle).vehicle.mounts[0].stiffness[2] == pytest.approx(1.3e5)


@pytest.mark.parametrize(
    ("deflection", "force", "words"),
    [
        ([0.0, 0.005, 0.004], [0.0, 1.0, 2.0], "deflection: found 0.004 after 0.005, expected rising"),
        ([0.0, 0.005, 0.008], [0.0, 3.0, 2.0], "force: found 2 after 3, expected rising"),
        ([0.001, 0.005], [1.0, 3.0], "deflection: found 0.001 to 0.005 m, expected from zero"),
        ([-0.001, 0.005], [1.0, 3.0], "force: found 1.33333 N at no deflection, expected none"),
        ([0.0], [0.0], "found 1 point, expected two or more"),
    ],
)
def test_a_curve_that_no_mount_has_is_refused(deflection, force, words):
    with pytest.raises(VehicleError, match=words):
        ForceCurve(np.array(deflection), np.array(force))


def test_a_curve_from_zero_holds_both_ways():
    assert CURVE.at(np.array([-0.006, 0.0, 0.006, 0.011])) == pytest.approx(
        [-800.0, 0.0, 800.0, 2300.0]
    )
    assert CURVE.slope(np.array([-0.006, 0.001])) == pytest.approx([300e3, 100e3])
    assert CURVE.rate == pytest.approx(100e3)


def test_the_rate_of_a_corner_at_zero_is_the_mean_of_both_sides():
    curve = ForceCurve(np.array([-0.01, 0.0, 0.01]), np.array([-1000.0, 0.0, 3000.0]))
    assert curve.rate == pytest.approx(200e3)


def test_a_mount_beyond_the_last_point_of_its_curve_is_noted():
    statics = statics_of(progressive_block(), scaled(0.3))
    assert statics.case("standing").notes == (
        "mount 'm' along z is at -14.2 mm, beyond the last point of its curve, which is taken to go on "
        "straight",
    )
    assert statics_of(progressive_block(), {}).case("standing").notes == ()
