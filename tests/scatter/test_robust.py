from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import cabin_search
from differences import central_difference, relative_to_largest
from limits_kept import excess
from rounding import CABIN
from scipy.stats import mstats

from modeviz.errors import SolveError
from modeviz.optimise.descent import descend
from modeviz.optimise.run import optimise
from modeviz.optimise.search import Search
from modeviz.scatter.robust import optimise_robustly, percentile_weights, robust, robust_search
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Performance

TOLERANCE = Tolerance(0.3, 0.5)


@pytest.fixture(scope="module")
def search():
    return cabin_search()


@pytest.fixture(scope="module")
def goal(search):
    return robust(search.goal, TOLERANCE, n_samples=60)


@pytest.mark.parametrize(("n_samples", "percent"), [(20, 50), (100, 95), (400, 5)])
def test_the_weights_are_those_of_another_implementation(n_samples, percent):
    values = np.random.default_rng(1).gamma(2.0, size=n_samples)
    found = percentile_weights(n_samples, percent) @ np.sort(values)
    expected = mstats.hdquantiles(values, prob=[percent / 100])[0]
    assert found == pytest.approx(expected, rel=1e-3)


def test_its_value_is_a_percentile_of_the_samples(search, goal):
    parts = scattered_parts(search.goal.prepared, {}, TOLERANCE)
    values = goals(search.goal, parts, goal.deviations)
    low, high = np.percentile(values, [90, 100])
    assert low < goal.value({}) < high
    assert goal.value({}) == pytest.approx(mstats.hdquantiles(values, prob=[0.95])[0], rel=1e-3)


def test_its_gradient_is_central_differences(search, goal):
    robustly = Search(search.space, goal)
    x = search.space.samples(3, 1)[2]
    value, gradient = robustly.evaluate(x)
    assert value == pytest.approx(robustly.value(x), rel=1e-12)
    steps = np.eye(len(x))
    expected = [
        central_difference(lambda h, s=s: robustly.value(x + (h - 1) * s), 1.0, 1e-4) for s in steps
    ]
    assert relative_to_largest(gradient, np.array(expected), over=0).max() < 1e-5


def test_of_a_peak_it_is_the_percentile_of_the_samples_peaks():
    search = cabin_search(goal="peak")
    robustly = replace(search, goal=robust(search.goal, TOLERANCE, n_samples=12))
    x = search.space.samples(3, 1)[2]
    parts = scattered_parts(search.goal.prepared, search.space.rates(x), TOLERANCE)
    stiffness = parts.stiffness(robustly.goal.deviations)
    peaks = search.goal.totals(stiffness)
    expected = mstats.hdquantiles(peaks, prob=[0.95])[0]
    value, gradient = robustly.evaluate(x)
    assert value == pytest.approx(expected, rel=1e-3)
    along = np.array([1.0, -0.6, 0.8, 0.5])
    slope = central_difference(lambda h: robustly.value(x + (h - 1) * along), 1.0, 1e-5)
    assert gradient @ along == pytest.approx(slope, rel=1e-4)
    assert robustly.goal.exact_value({}) == pytest.approx(robustly.goal.value({}), rel=1e-8)


def test_the_full_model_says_the_same(goal):
    assert goal.exact_value({}) == pytest.approx(goal.value({}), rel=1e-8)


def test_a_robust_optimum_is_better_for_vehicles_it_has_not_seen():
    """By the 95th percentile of 2000 others: 12 Hz are nearly cancelled by parts as drawn, and by no
    other.
    """
    wide = MountRates(2e4, 2e4, 2e4), MountRates(5e6, 5e6, 5e6)
    search = cabin_search(
        groups=(DesignGroup("A", bounds=wide), DesignGroup("B", bounds=wide)),
        performance=(Performance(np.array([12.0]), roads=("flat",)),),
    )
    goal = robust(search.goal, TOLERANCE, n_samples=60)
    drawn = optimise(search, [search.space.to_x({})])
    found = descend(Search(search.space, goal), drawn.x, budget=200)
    fresh = scattered_parts(search.goal.prepared, {}, TOLERANCE).samples(2000, 99)

    def percentile(x):
        parts = scattered_parts(search.goal.prepared, search.space.rates(x), TOLERANCE)
        return np.percentile(goals(search.goal, parts, fresh), 95)

    assert found.value < goal.value(drawn.rates)
    assert percentile(found.x) < 0.97 * percentile(drawn.x)
    assert search.goal.value(search.space.rates(found.x)) > drawn.value
    assert excess(search.space, found.x) <= 1e-9


def test_a_robust_search_is_within_the_same_limits_and_windows():
    search = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=10.0),))
    robustly = robust_search(search, TOLERANCE, 90)
    x = search.space.to_x({})
    value = robustly.value(x)
    assert value == pytest.approx(robust(search.goal, TOLERANCE, 90).value({}), rel=CABIN)
    assert value > 1.01 * search.value(x)
    assert (robustly.space, robustly.windows) == (search.space, search.windows)


def test_a_change_does_not_scatter():
    with pytest.raises(SolveError, match="the goal does not scatter with parts: a robust search needs"):
        robust_search(cabin_search(goal="change"), TOLERANCE)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [({"n_samples": 1}, "samples: found 1, expected 2"), ({"percent": 100}, "percentile: found 100")],
)
def test_what_cannot_be_is_an_error(search, arguments, sentence):
    with pytest.raises(SolveError, match=sentence):
        robust(search.goal, TOLERANCE, **arguments)


@pytest.mark.parametrize(("budget", "reason"), [(5_000, "converged"), (3, "out of budget")])
def test_both_searches_count_and_share_one_budget(budget, reason):
    search = cabin_search()
    before = optimise(search, [search.space.to_x({})], budget)
    robustly = robust_search(search, TOLERANCE)
    found = optimise_robustly(robustly, before, budget)
    assert found.reason == before.reason == reason
    first, second = found.descents
    assert found.evaluations == first.evaluations + second.evaluations
    assert first is before.descents[0]
    assert found.evaluations <= budget + 1
    assert found.value == pytest.approx(robustly.value(found.x), rel=1e-12)


def test_a_first_search_that_was_cut_short_leaves_the_whole_so():
    search = cabin_search()
    before = optimise(search, [search.space.to_x({})], 3)
    assert optimise_robustly(robust_search(search, TOLERANCE), before, 5_000).reason == "out of budget"
