from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM, cabin_search
from limits_kept import excess
from mounted_cabin import mounted_cabin
from toy_goals import logarithmic_search, paraboloid

from modeviz.compute.cancel import CancelToken
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET
from modeviz.optimise.pareto import find_front
from modeviz.optimise.trade_off import TradeOff, prepare_trade_off, sides
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow

GROUPS = (DesignGroup("A"), DesignGroup("B"))
FIRST, SECOND = np.array([0.4, -0.3, 0.2, -0.5, 0.3, 0.1]), np.array([-0.2, 0.5, 0.6, 0.1, -0.4, 0.5])
LATERAL_VERTICAL = "lateral against vertical"


def toy(first, second):
    return TradeOff(("first", "second"), tuple(logarithmic_search(f, GROUPS) for f in (first, second)))


def cabin_trade_off(**changes):
    vehicle = mounted_cabin()
    problem = replace(PROBLEM, **changes)
    pair = sides(vehicle, problem)[LATERAL_VERTICAL]
    return prepare_trade_off(vehicle, problem, pair, vehicle.rates, vehicle.speed)


def distances(front):
    """Of designs from the line between the two best, and along it from 0 to 1."""
    line = SECOND - FIRST
    x = np.array([d.x for d in front.designs])
    along = (x - FIRST) @ line / (line @ line)
    return np.linalg.norm(x - FIRST - along[:, None] * line, axis=1), along


def test_the_front_of_two_paraboloids_is_the_line_between_their_centers():
    front = find_front(toy(paraboloid(FIRST), paraboloid(SECOND)), [{}])
    assert front.reason == CONVERGED
    assert len(front.designs) == 11
    off, along = distances(front)
    assert off.max() < 1e-4
    assert (along[0], along[-1]) == pytest.approx((0, 1), abs=1e-5)
    assert np.diff(along).max() < 0.25
    for design in front.designs:
        roots = np.sqrt(2 * (np.array(design.values) - 1))
        assert roots.sum() == pytest.approx(np.linalg.norm(SECOND - FIRST), rel=1e-6)


def test_designs_are_found_also_where_the_front_is_not_convex():
    """C. M. Fonseca and P. J. Fleming's goals: a weighted sum is smallest at the ends alone."""

    def hill(center):
        def function(u):
            step = 1.6 * (u - center)
            fall = np.exp(-step @ step)
            return 1.01 - fall, 3.2 * fall * step

        return function

    front = find_front(toy(hill(FIRST), hill(SECOND)), [{}])
    off, along = distances(front)
    assert off.max() < 1e-4
    assert np.count_nonzero((along > 0.1) & (along < 0.9)) >= 5
    first, second = np.array([d.values for d in front.designs]).T
    chord = np.interp(first, first[[0, -1]], second[[0, -1]])
    assert (second[1:-1] > chord[1:-1]).all()


@pytest.fixture(scope="module")
def cabin():
    trade_off = cabin_trade_off()
    return trade_off, find_front(trade_off, [{}], n_designs=7)


def test_every_design_keeps_all_limits_and_none_dominates_another(cabin):
    trade_off, front = cabin
    first, second = np.array([d.values for d in front.designs]).T
    assert len(first) >= 3
    assert (np.diff(first) > 0).all()
    assert (np.diff(second) < 0).all()
    for design in front.designs:
        assert excess(trade_off.searches[0].space, design.x) < 1e-12
        exact = [s.goal.exact_value(design.rates) for s in trade_off.searches]
        off = [abs(v / e - 1) for v, e in zip(design.values, exact, strict=True)]
        assert design.verification.difference == pytest.approx(max(off), abs=1e-15)
    assert front.difference == max(d.verification.difference for d in front.designs) < 1e-9


@pytest.mark.parametrize("is_cancelled", [False, True])
def test_designs_are_checked_one_after_the_other_also_after_a_cancel(cabin, is_cancelled):
    trade_off, _ = cabin
    token, told = CancelToken(), []

    def tell(progress):
        told.append(progress)
        if is_cancelled:
            token.cancel()

    front = find_front(trade_off, [{}], 4, n_starts=1, token=token, tell=tell)
    n = len(front.designs)
    checks = [[d.verification is not None for d in p.designs] for p in told[-n:]]
    assert checks == [[True] * i + [False] * (n - i) for i in range(1, n + 1)]
    assert told[-1].designs == front.designs


def test_a_design_that_leaves_its_window_in_the_full_model_is_left_out(monkeypatch):
    trade_off = cabin_trade_off(windows=(FrequencyWindow("cab yaw", high_hz=10.0),))
    windows = type(trade_off.searches[0].windows)
    exact, asked = windows.exact_frequencies, []

    def off(windows, rates):
        asked.append(rates)
        return np.array([10.1]) if rates == asked[0] else exact(windows, rates)

    monkeypatch.setattr(windows, "exact_frequencies", off)
    told = []
    front = find_front(trade_off, [{}], 4, n_starts=1, tell=told.append)
    assert len(front.designs) == len(told[-1].designs) - 1


def test_no_sample_dominates_the_front(cabin):
    trade_off, front = cabin
    for x in trade_off.searches[0].space.samples(200, seed=9):
        first, second = trade_off.compromise(x).values
        better = [d.values[0] <= first or d.values[1] <= second for d in front.designs]
        assert any(better)
        assert not all(first < d.values[0] and second < d.values[1] for d in front.designs)


def test_the_goals_are_one_with_the_original_rates_and_weigh_as_the_whole(cabin):
    trade_off, _ = cabin
    lateral, vertical = trade_off.searches
    assert lateral.goal.value({}) == pytest.approx(1, rel=1e-12)
    assert vertical.goal.value({}) == pytest.approx(1, rel=1e-12)
    plain = cabin_trade_off(is_normalised=False)
    parts = [search.goal.value({}) for search in plain.searches]
    assert sum(parts) == pytest.approx(cabin_search(is_normalised=False).goal.value({}), rel=1e-12)


def test_known_designs_are_not_beaten_by_the_front(cabin):
    trade_off, _ = cabin
    front = find_front(trade_off, [{}, mounted_cabin().rate_sets["soft"]], n_designs=2, n_starts=1)
    assert len(front.designs) == 2


def test_windows_hold_on_the_whole_front():
    front = find_front(
        cabin_trade_off(windows=(FrequencyWindow("cab yaw", high_hz=10.0),)), [{}], n_designs=4
    )
    windows = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=10.0),)).windows
    assert front.designs
    assert all(windows.exact_frequencies(d.rates)[0] <= 10.0 for d in front.designs)


def test_it_tells_each_design_and_can_be_cancelled(cabin):
    trade_off, _ = cabin
    token, told = CancelToken(), []

    def tell(progress):
        told.append(progress)
        if len(told) == 2:
            token.cancel()

    front = find_front(trade_off, [{}], token=token, tell=tell)
    assert front.reason == CANCELLED
    found = [p for p in told if not any(d.verification for d in p.designs)]
    assert [round(p.done * 11) for p in found] == list(range(1, len(found) + 1))
    assert told[1].designs
    assert front.designs[0].values == told[1].designs[0].values
    assert front.evaluations <= told[1].evaluations + 1


def test_cancelled_before_it_begins_it_has_no_designs(cabin):
    token = CancelToken()
    token.cancel()
    front = find_front(cabin[0], [{}], token=token)
    assert (front.reason, front.designs, front.evaluations) == (CANCELLED, (), 0)


def test_a_budget_that_ends_with_a_search_ends_the_front(monkeypatch, cabin):
    used = []

    def counted(*arguments):
        descent = descend(*arguments)
        used.append(descent.evaluations)
        return descent

    monkeypatch.setattr("modeviz.optimise.pareto.descend", counted)
    find_front(cabin[0], [{}], n_designs=2, n_starts=1)
    front = find_front(cabin[0], [{}], n_designs=2, n_starts=1, budget=used[0])
    assert front.evaluations == used[0]
    assert front.reason == OUT_OF_BUDGET


def test_it_ends_with_its_budget(cabin):
    front = find_front(cabin[0], [{}], budget=30)
    assert front.reason == OUT_OF_BUDGET
    assert front.evaluations == 30
    assert front.designs


@pytest.mark.bitwise
def test_the_same_seed_finds_the_same(cabin):
    again = find_front(cabin[0], [{}], n_designs=7)
    assert [d.values for d in again.designs] == [d.values for d in cabin[1].designs]
