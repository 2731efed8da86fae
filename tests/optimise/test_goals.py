from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM
from differences import rate_derivatives, relative_to_largest
from full_solutions import wheel_forces
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.optimise.goals import prepare_goal
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.connections import Tyre
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import Performance

RATES = {"A": MountRates(2e5, 1e5, 3e5, loss_factor=0.4), "B": MountRates(9e5, 4e5, 2e5)}
ON_ROAD = ("rms", "rating", "iso 2631")


def goal_of(vehicle=None, base=None, **changes):
    vehicle = vehicle or mounted_cabin()
    return prepare_goal(vehicle, replace(PROBLEM, **changes), base or vehicle.rates, vehicle.speed)


def ride(rates):
    vehicle = mounted_cabin()
    return solve(prepare(vehicle), rates, Conditions("flat", vehicle.speed))


def with_target(target):
    road, wheel = PROBLEM.performance
    return (replace(road, target=target), replace(wheel, target=2 * target))


@pytest.mark.parametrize(
    "changes",
    [
        {}, {"is_normalised": False}, {"performance": with_target(1e-3)}, {"goal": "peak"},
        {"goal": "rms"}, {"goal": "rating"}, {"goal": "iso 2631"}, {"goal": "change"},
    ],
)  # fmt: skip
def test_derivatives_are_central_differences(changes):
    goal = goal_of(**changes)
    value, gradient = goal.value_and_gradient(RATES)
    assert value == pytest.approx(goal.value(RATES), rel=1e-12)
    expected = rate_derivatives(goal.value, RATES)
    assert relative_to_largest(gradient, expected, over=0).max() < 1e-6


@pytest.mark.parametrize("goal", ["accelerations", "peak", *ON_ROAD])
def test_normalised_it_is_one_with_the_original_rates(goal):
    assert goal_of(goal=goal).value({}) == pytest.approx(1.0, rel=1e-12)


def test_a_change_of_nothing_is_zero():
    value, gradient = goal_of(goal="change").value_and_gradient({})
    assert value == 0
    np.testing.assert_array_equal(gradient, 0)


def test_the_plain_sum_is_the_papers():
    """Σ a² over lines, points and directions, from the equations of motion."""
    vehicle = mounted_cabin()
    system = assemble(vehicle.with_rates(RATES))
    point = vehicle.response_points[0]
    outputs = system.motion(point.body, point.position)[1:3]
    road, wheel = PROBLEM.performance

    f = road.frequency_hz
    H = direct_response(system, f, track_forces(system, f, vehicle.speed), outputs)
    S = road_spectrum(vehicle.random_load("flat"), f, vehicle.speed)
    powers = np.einsum("foi,fij,foj->fo", H, S, H.conj()).real
    expected = ((2 * np.pi * f)[:, None] ** 4 * powers).sum() / STANDARD_GRAVITY**2

    f = wheel.frequency_hz
    forces = wheel_forces(system, vehicle.wheel_loads, f)
    peaks = (2 * np.pi * f)[:, None, None] ** 2 * np.abs(direct_response(system, f, forces, outputs))
    expected += wheel.weight * (peaks**2).sum() / STANDARD_GRAVITY**2
    assert goal_of(is_normalised=False).value(RATES) == pytest.approx(expected, rel=1e-9)


def test_a_target_is_what_accelerations_are_to_be():
    vehicle, target = mounted_cabin(), 2e-3
    problem = {"performance": (replace(PROBLEM.performance[0], target=target),), "is_normalised": False}
    results = solve(
        prepare(vehicle, PROBLEM.performance[0].frequency_hz),
        RATES,
        Conditions("flat", vehicle.speed),
    )
    expected = ((np.sqrt(results.psd[:, 0, 1:]) - target) ** 2).sum()
    assert goal_of(**problem).value(RATES) == pytest.approx(expected, rel=1e-9)


def test_normalised_cases_are_weighed_relative_to_the_original():
    road, wheel = (replace(PROBLEM, performance=(own,)).performance for own in PROBLEM.performance)
    shares = [goal_of(performance=own).value(RATES) for own in (road, wheel)]
    assert goal_of().value(RATES) == pytest.approx((shares[0] + 2 * shares[1]) / 3, rel=1e-12)


def test_goals_on_the_road_are_what_the_ride_says():
    now, was = ride(RATES), ride({})
    squares = (now.rms[:, 1:] ** 2).sum() / (was.rms[:, 1:] ** 2).sum()
    assert goal_of(goal="rms").value(RATES) == pytest.approx(squares, rel=1e-9)
    combined = now.rating.combined_g / was.rating.combined_g
    assert goal_of(goal="rating").value(RATES) == pytest.approx(combined**2, rel=1e-9)
    total = now.rating.weighted_total / was.rating.weighted_total
    assert goal_of(goal="iso 2631").value(RATES) == pytest.approx(total**2, rel=1e-9)
    plain = goal_of(goal="iso 2631", is_normalised=False).value(RATES)
    assert plain == pytest.approx(now.rating.weighted_total**2, rel=1e-9)


def test_rms_is_of_the_points_and_directions_that_are_named():
    vertical = (Performance(np.array([9.0]), ("flat",), directions=("vertical",)),)
    goal = goal_of(goal="rms", performance=vertical, is_normalised=False)
    assert goal.value(RATES) == pytest.approx(ride(RATES).rms[0, 2] ** 2, rel=1e-9)


def test_rms_is_of_every_road_that_is_named():
    vehicle = mounted_cabin()
    named = Performance(np.array([5.0]), roads=("flat", "rough"))
    problem = replace(PROBLEM, goal="rms", performance=(named,), is_normalised=False)
    both = prepare_goal(vehicle, problem, vehicle.rates, 20.0).value({})
    expected = [
        (solve(prepare(vehicle), {}, Conditions(road, 20.0)).rms[:, 1:] ** 2).sum()
        for road in ("flat", "rough")
    ]
    assert both == pytest.approx(sum(expected), rel=1e-9)


def test_a_change_is_measured_from_the_rates_that_are_given():
    base = {**mounted_cabin().rates, "B": RATES["B"]}
    goal = goal_of(goal="change", base=base)
    own = mounted_cabin().rates["A"]
    expected = np.sum(np.log(np.divide(RATES["A"].as_tuple(), own.as_tuple())) ** 2) / 6
    assert goal.value(RATES) == pytest.approx(expected, rel=1e-12)


def test_a_rate_of_zero_has_no_change():
    vehicle = mounted_cabin()
    base = {**vehicle.rates, "B": MountRates(0.0, 4e5, 2e5)}
    value, gradient = goal_of(goal="change", base=base).value_and_gradient(base)
    assert (value, gradient.any()) == (0, False)


def test_a_case_that_is_silent_with_the_original_rates_counts_as_it_is():
    silent = replace(
        mounted_cabin(), wheel_loads=(replace(mounted_cabin().wheel_loads[0], amplitude=0.0),)
    )
    goal = goal_of(silent)
    assert goal.value({}) == pytest.approx(1 / 3, rel=1e-12)


def test_names_that_are_not_there_and_missing_roads_are_errors():
    with pytest.raises(VehicleError, match="unknown random load 'moon'"):
        goal_of(performance=(Performance(np.array([9.0]), ("moon",)),))
    cabin = mounted_cabin()
    rigid = tuple(c for c in cabin.connections if not isinstance(c, Tyre))
    bare = replace(cabin, roads=(), connections=rigid, wheel_loads=())
    with pytest.raises(VehicleError, match=r"goal 'rating' needs a \[\[tyre\]\]"):
        goal_of(bare, goal="rating", performance=())
