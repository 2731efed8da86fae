from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from cabin_problem import cabin_search
from mounted_cabin import SOFT, mounted_cabin

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.optimise.search import prepare_search
from modeviz.optimise.verification import verify
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Problem

X = np.array([0.3, 0.1, -0.2, 0.4])
HARD = 1e14
"""N/m: too stiff beside the tyres for the equations of motion, not for receptances."""

GOALS = ("accelerations", "rms", "rating", "iso 2631", "change")


def verification(search, x=X):
    return verify((search,), x, search.evaluate(x)[:1])


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("is_normalised", [True, False])
def test_every_goal_is_that_of_the_full_model(goal, is_normalised):
    found = verification(cabin_search(goal=goal, is_normalised=is_normalised))
    assert found.value > 0
    assert found.difference < 1e-9


def test_the_papers_goal_is_that_of_the_full_truck():
    vehicle = builtin_truck()
    problem = vehicle.problem("paper")
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    paper = search.space.to_x(vehicle.rate_sets[problem.reference])
    for x in (np.zeros(search.space.n_variables), paper):
        assert verification(search, x).difference < 1e-9


def test_a_wrong_value_differs_by_as_much():
    search = cabin_search()
    value, _ = search.evaluate(X)
    assert verify((search,), X, (1.001 * value,)).difference == pytest.approx(1e-3, rel=1e-6)


def test_wrong_receptances_are_found():
    search = cabin_search()
    driven = search.goal.driven
    wrong = replace(search.goal, driven=replace(driven, springs=1.01 * driven.springs))
    assert verification(replace(search, goal=wrong)).difference > 1e-4


def test_a_mode_of_a_window_is_where_the_full_eigenproblem_has_it():
    windows = FrequencyWindow("cab yaw", high_hz=9.0), FrequencyWindow("cab bounce", low_hz=15.0)
    search = cabin_search(windows=windows)
    found = verification(search)
    tuned = search.space.vehicle.with_rates(search.space.rates(X))
    exact = solve_modes(assemble(tuned)).frequency_hz
    for frequency_hz in found.frequency_hz:
        assert np.abs(exact / frequency_hz - 1).min() < 1e-12
    yaw, bounce = found.frequency_hz
    assert 9 < yaw < 12
    assert bounce > 15
    assert not found.are_kept


def test_windows_that_are_kept_are_said_to_be():
    inside = FrequencyWindow("cab yaw", 9.0, 12.0)
    assert verification(cabin_search(windows=(inside,))).are_kept
    outside = replace(inside, is_inside=False)
    assert not verification(cabin_search(windows=(outside,))).are_kept


def test_a_model_that_cannot_be_solved_exactly_enough_is_said_to_be_so():
    vehicle = mounted_cabin()
    front, rear = vehicle.mount_groups
    hard = replace(rear, rates=MountRates(*[HARD] * 3), bounds=(SOFT, MountRates(*[2 * HARD] * 3)))
    vehicle = replace(vehicle, mount_groups=(front, hard))
    problem = Problem("hard", (DesignGroup("A"),), goal="rating")
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    found = verification(search, np.zeros(3))
    assert np.isnan(found.difference)
    assert found.impossible.startswith("no accurate response at")
