from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM, cabin_search
from toy_goals import CENTER, MINIMUM, logarithmic_search, paraboloid

from modeviz.optimise.active_limits import active_constraints
from modeviz.optimise.descent import descend
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import FrequencyWindow


def best(search):
    return descend(search, np.zeros(search.space.n_variables), budget=300)


def test_multipliers_and_gains_are_those_by_hand():
    search = logarithmic_search(paraboloid(CENTER))
    value, _ = search.evaluate(MINIMUM)
    bound, ratio = active_constraints(search, MINIMUM)
    # ∂F/∂u of B's three rates, which are one number, and of A lateral.
    assert bound.name == "B rates: upper bound"
    assert bound.multiplier == pytest.approx(3 * (2 - np.log(2.5)), rel=1e-9)
    assert ratio.name == "A lateral: lower ratio limit"
    assert ratio.multiplier == pytest.approx(MINIMUM[1] + 3, rel=1e-9)
    for constraint in (bound, ratio):
        expected = constraint.multiplier * np.log(1.1) / value
        assert constraint.gain == pytest.approx(expected, rel=1e-9)


def test_inside_all_limits_there_are_none():
    search = logarithmic_search(paraboloid(np.zeros(6)))
    assert active_constraints(search, np.zeros(4)) == ()


def test_a_limit_that_costs_nothing_has_no_multiplier():
    bound = np.log(2.5)
    search = logarithmic_search(paraboloid(np.array([0, 0, 0, bound, bound, bound])))
    (limit,) = active_constraints(search, np.array([0, 0, 0, bound]))
    assert limit.name == "B rates: upper bound"
    assert limit.multiplier == pytest.approx(0, abs=1e-12)


def test_of_a_goal_of_zero_there_is_nothing_to_gain():
    bound = np.log(2.5)
    search = logarithmic_search(paraboloid(np.array([0, 0, 0, bound, bound, bound]), offset=0.0))
    (limit,) = active_constraints(search, np.array([0, 0, 0, bound]))
    assert limit.gain == 0


def with_ratio_limit(high):
    front, rear = PROBLEM.groups
    return cabin_search(groups=(replace(front, ratio_limits=(0.25, high)), rear))


def with_stiffest(rate):
    front, rear = PROBLEM.groups
    stiffest = MountRates(rate, 2e6, 2e6)
    return cabin_search(groups=(replace(front, bounds=(front.bounds[0], stiffest)), rear))


def with_window(high_hz):
    return cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=high_hz),))


def with_band(low_hz):
    return cabin_search(windows=(FrequencyWindow("cab yaw", low_hz, 25.0, is_inside=False),))


@pytest.mark.parametrize(
    ("searched", "limit", "name"),
    [
        (with_ratio_limit, 0.8, "upper ratio limit"),  # of lateral and fore-aft
        (with_stiffest, 1.2e6, "A vertical: upper bound"),
        (with_window, 9.0, "cab yaw: at most 9 Hz"),
        (with_band, 10.0, "cab yaw: not 10 Hz to 25 Hz"),
    ],
)
def test_a_gain_is_what_a_relaxed_limit_takes_off(searched, limit, name):
    moved = 1.001
    search = searched(limit)
    at, better = best(search), best(searched(limit * moved))
    gain = sum(c.gain for c in active_constraints(search, at.x) if c.name.endswith(name))
    gained = (at.value - better.value) / at.value
    assert gained > 1e-6
    assert gain * np.log(moved) / np.log(1.1) == pytest.approx(gained, rel=2e-2)


def test_costly_limits_come_first():
    search = cabin_search()
    multipliers = [c.multiplier for c in active_constraints(search, best(search).x)]
    assert multipliers == sorted(multipliers, reverse=True)
