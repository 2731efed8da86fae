import threading
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from builtin_truck import builtin_truck, truck_modes
from cabin_problem import cabin_search
from limits_kept import excess
from mounted_cabin import mounted_cabin
from rounding import CABIN, EPSILON, SEARCHED
from threadpoolctl import threadpool_limits
from toy_goals import CENTER, MINIMUM, logarithmic_search, paraboloid

from modeviz.compute.cancel import CancelToken
from modeviz.compute.runner import HERE
from modeviz.errors import SolveError
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET
from modeviz.optimise.evolution import evolve
from modeviz.optimise.run import LEFT, best_of, optimise, optimise_on, search_globally, why_ended
from modeviz.optimise.search import prepare_search
from modeviz.optimise.starts import SCREENED, start_points
from modeviz.optimise.verification import verify
from modeviz.optimise.windows import prepare_windows
from modeviz.scatter.searching import SearchOptions
from modeviz.vehicle.problem import FrequencyWindow

WELLS = np.array([-0.8, 0.5])


def two_wells(u):
    """Along A vertical two minima, the better one at the first; a bowl along all others."""
    step = u.copy()
    step[0] = 0.0
    distance = u[0] - WELLS
    value = 10 * np.prod(distance**2) + 0.05 * u[0] + 0.5 * step @ step + 1
    slope = 20 * np.prod(distance) * distance.sum() + 0.05
    return value, np.concatenate([[slope], step[1:]])


def along(x0):
    return np.array([x0, 0, 0, 0])


def test_of_several_starts_the_best_end_is_kept():
    search = logarithmic_search(two_wells)
    optimum = optimise(search, [along(0.6), along(-0.7)])
    near, far = optimum.descents
    assert near.value > far.value == optimum.value
    assert optimum.x[0] == pytest.approx(-0.8, abs=0.01)
    assert optimum.converged
    assert optimum.evaluations == near.evaluations + far.evaluations
    assert optimum.rates["A"].vertical == pytest.approx(8e5 * np.exp(optimum.x[0]), rel=1e-12)


def test_a_convex_problem_has_one_end_from_everywhere():
    search = logarithmic_search(paraboloid(CENTER))
    optimum = optimise(search, start_points(search, {}, 8))
    for descent in optimum.descents:
        np.testing.assert_allclose(descent.x, MINIMUM, atol=1e-6)
    assert {c.name for c in optimum.active} == {"B rates: upper bound", "A lateral: lower ratio limit"}
    assert optimum.verification.difference == 0


def test_starts_are_the_given_rates_and_the_best_of_many_designs():
    search = cabin_search()
    rates = mounted_cabin().rate_sets["soft"]
    first, *others = start_points(search, rates, 4, seed=5)
    np.testing.assert_array_equal(first, search.space.to_x(rates))
    values = sorted(search.value(x) for x in search.space.samples(3 * SCREENED, seed=5))
    found = [search.value(x) for x in others]
    np.testing.assert_allclose(found, sorted(found), rtol=CABIN)
    assert found[-1] < values[0]  # after some steps, all
    again = start_points(search, rates, 4, seed=5)
    np.testing.assert_allclose(again, [first, *others], rtol=0, atol=8 * EPSILON)
    assert len(start_points(search, rates, 1)) == 1


def test_starts_are_chosen_from_what_there_is_when_it_is_cancelled():
    token = CancelToken()
    token.cancel()
    assert len(start_points(cabin_search(), {}, 4, token=token)) == 1


class Patience(CancelToken):
    """Is cancelled after so many designs."""

    def __init__(self, n_designs):
        super().__init__()
        self.n_left = n_designs

    def check(self):
        if not self.n_left:
            self.cancel()
        self.n_left -= 1
        super().check()


@pytest.mark.parametrize("n_looked_at", [2, 3 * SCREENED - 1, 3 * SCREENED + 4, 3 * SCREENED + 40])
def test_cancelled_on_the_way_the_best_so_far_are_the_starts(n_looked_at):
    search = cabin_search()
    starts = start_points(search, {}, 4, token=Patience(n_looked_at))
    assert len(starts) == 1 + min(3, n_looked_at)
    values = [search.value(x) for x in starts[1:]]
    np.testing.assert_allclose(values, sorted(values), rtol=CABIN)
    spread = [search.value(x) for x in search.space.samples(3 * SCREENED, 0)[:n_looked_at]]
    assert values[0] <= min(spread) * (1 + CABIN)


def test_the_global_search_finds_the_better_of_two_minima():
    search = logarithmic_search(two_wells)
    assert optimise(search, [along(0.6)]).x[0] == pytest.approx(0.5, abs=0.01)
    optimum = search_globally(search, seed=2)
    assert optimum.x[0] == pytest.approx(-0.8, abs=0.01)
    assert optimum.converged
    evolved, polished = optimum.descents
    assert polished.value <= evolved.value
    assert excess(search.space, optimum.x) < 1e-12


def test_a_population_keeps_all_limits_and_windows():
    window = FrequencyWindow("cab yaw", high_hz=9.5)
    search, steps = cabin_search(windows=(window,)), []
    descent = evolve(search, seed=0, budget=400, tell=steps.append)
    assert descent.reason == OUT_OF_BUDGET
    assert descent.evaluations == len(steps) == 400
    assert all(excess(search.space, s.x) < 1e-12 for s in steps if s.x is not None)
    (f,) = search.windows.exact_frequencies(search.space.rates(descent.x))
    assert f <= 9.5


@pytest.mark.bitwise
def test_the_same_seed_evolves_the_same():
    first, again = (evolve(cabin_search(), seed=0, budget=200) for _ in range(2))
    np.testing.assert_array_equal(again.x, first.x)


def test_a_global_search_ends_with_its_budget_or_when_it_is_cancelled():
    search, token = cabin_search(), CancelToken()
    spent = search_globally(search, budget=50)
    assert (spent.reason, spent.evaluations) == (OUT_OF_BUDGET, 50)
    optimum = search_globally(search, token=token, tell=lambda _: token.cancel())
    assert (optimum.reason, optimum.evaluations) == (CANCELLED, 1)


def test_the_budget_is_for_all_starts_together():
    search = cabin_search()
    starts = start_points(search, {}, 5)
    optimum = optimise(search, starts, budget=20)
    assert optimum.evaluations == 20
    assert optimum.reason == OUT_OF_BUDGET
    assert not optimum.converged
    assert len(optimum.descents) < 5
    assert optimum.value == min(d.value for d in optimum.descents)


def test_progress_tells_the_best_so_far_of_all_starts():
    search, told = cabin_search(), []
    optimum = optimise(search, start_points(search, {}, 3), tell=told.append)
    told = [p for p in told if not p.is_checking]
    values = [p.value for p in told]
    assert values == sorted(values, reverse=True)
    assert values[-1] == optimum.value
    assert [p.evaluations for p in told] == list(range(1, optimum.evaluations + 1))
    assert [p.start for p in told] == sorted(p.start for p in told)
    assert {(p.start, p.n_starts) for p in told} == {(1, 3), (2, 3), (3, 3)}
    assert search.goal.value(told[-1].rates) == pytest.approx(optimum.value, rel=1e-12)


@pytest.mark.parametrize("find", [optimise, search_globally, partial(optimise_on, HERE)])
def test_it_is_told_before_the_full_model_is_solved(monkeypatch, find):
    search, told, at_check = logarithmic_search(two_wells), [], []

    def noted(*arguments):
        at_check.append(told[-1])
        return verify(*arguments)

    monkeypatch.setattr("modeviz.optimise.run.verify", noted)
    what = {"seed": 1} if find is search_globally else {"starts": [along(0.6), along(-0.7)]}
    optimum = find(search, **what, tell=told.append)
    (last,) = at_check
    assert [p.is_checking for p in told] == [False] * (len(told) - 1) + [True]
    assert (last.value, last.rates) == (optimum.value, optimum.rates)
    assert (last.start, last.n_starts, last.evaluations) == (2, 2, optimum.evaluations)


def in_thread(search, token, tell):
    """An optimisation in a thread of its own, and where its result will be."""
    found = []
    starts = start_points(search, {}, 20)
    thread = threading.Thread(target=lambda: found.append(optimise(search, starts, 5000, token, tell)))
    thread.start()
    return thread, found


def test_cancelled_from_outside_it_answers_at_once_with_the_best():
    token, told, has_begun = CancelToken(), [], threading.Event()

    def tell(progress):
        told.append(progress)
        if len(told) == 10:
            has_begun.set()

    thread, found = in_thread(cabin_search(), token, tell)
    assert has_begun.wait(60)
    token.cancel()
    n_told = len(told)
    thread.join(60)
    assert len(told) <= n_told + 3  # what was in hand, and the check of the best; of 111
    (optimum,) = found
    assert optimum.reason == CANCELLED
    assert optimum.value == told[-1].value
    assert optimum.evaluations == told[-1].evaluations
    assert optimum.verification.difference < 1e-9


def test_held_it_waits_and_then_finds_the_same():
    token, told, is_held = CancelToken(), [], threading.Event()

    def tell(progress):
        told.append(progress)
        if len(told) == 10:
            token.pause()
            is_held.set()

    search = cabin_search()
    thread, found = in_thread(search, token, tell)
    assert is_held.wait(60)
    thread.join(0.2)
    assert thread.is_alive()
    assert len(told) == 10
    token.resume()
    thread.join(60)
    (optimum,) = found
    assert optimum.reason == CONVERGED
    expected = optimise(search, start_points(search, {}, 20))
    assert optimum.value == pytest.approx(expected.value, rel=SEARCHED)


def test_without_a_design_that_keeps_the_windows_there_is_an_error():
    search = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=1.0),))
    starts = start_points(search, {}, 2)
    with pytest.raises(
        SolveError,
        match=r"no design was found that keeps the frequency windows \(cab yaw: at most 1 Hz\): widen",
    ):
        optimise(search, starts, budget=40)
    token = CancelToken()
    token.cancel()
    with pytest.raises(SolveError, match="cancelled: no design was found"):
        optimise(search, starts, token=token)


def test_cancelled_while_starts_are_chosen_the_best_of_these_is_kept():
    search = cabin_search()
    token = CancelToken()
    starts = start_points(search, {}, 3)
    token.cancel()
    optimum = optimise(search, starts, token=token)
    assert optimum.reason == CANCELLED
    assert optimum.evaluations == 2
    assert optimum.x.tolist() == starts[1].tolist()
    assert optimum.value < search.value(starts[0])


def test_a_global_search_has_converged_once_its_last_part_has():
    optimum = search_globally(logarithmic_search(two_wells), budget=400)
    assert optimum.descents[0].reason == OUT_OF_BUDGET
    assert optimum.converged


def test_what_the_full_model_does_not_keep_has_not_converged(monkeypatch):
    search = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=10.0),))
    found = optimise(search, start_points(search, {}, 2), budget=60)
    assert found.reason != LEFT
    exact = np.array([10.1])
    monkeypatch.setattr(type(search.windows), "exact_frequencies", lambda *_: exact)
    left = best_of(search, found.descents, CONVERGED, 2)
    assert left.reason == LEFT
    assert not left.converged


def test_the_end_that_is_told_is_why_not_all_was_searched():
    search = logarithmic_search(two_wells)
    descents = optimise(search, [along(0.6), along(-0.7)]).descents
    assert why_ended(descents, 2) == CONVERGED
    assert why_ended(descents, 3) == OUT_OF_BUDGET
    stopped = replace(descents[0], reason=OUT_OF_BUDGET)
    assert why_ended([stopped, descents[1]], 2) == OUT_OF_BUDGET


def test_a_window_that_the_best_design_keeps_by_itself_costs_nothing():
    free = cabin_search()
    start = start_points(free, {}, 3)[1]
    best = optimise(free, [start])
    open_window = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=40.0),)).windows
    (yaw,) = open_window.exact_frequencies(free.space.rates(best.x))
    held = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=float(yaw) + 0.5),))
    assert (held.margins(best.x)[0] >= 0).all()
    found = optimise(held, [start])
    assert found.converged
    assert found.value == pytest.approx(best.value, rel=1e-9)


@pytest.mark.slow
def test_on_the_truck_a_window_that_the_best_design_keeps_by_itself_costs_nothing():
    vehicle = builtin_truck()
    window = FrequencyWindow("cab yaw", high_hz=10.0)
    free = prepare_search(vehicle, vehicle.problem("paper"), vehicle.rates, vehicle.speed)
    held = replace(free, windows=prepare_windows(truck_modes(), [window]))
    start = start_points(free, {}, 3, 0)[1]
    best = optimise(free, [start])
    assert (held.margins(best.x)[0] >= 0).all()
    found = optimise(held, [start])
    assert found.converged
    assert found.value == pytest.approx(best.value, rel=1e-9)


@pytest.mark.slow
def test_on_the_truck_forty_starts_find_the_same_best_whatever_the_seed():
    vehicle = builtin_truck()
    problem = vehicle.problem("paper")
    with threadpool_limits(limits=1, user_api="blas"):
        search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
        found = [optimise(search, start_points(search, {}, 40, seed)) for seed in (0, 1)]
        paper = search.goal.value(vehicle.rate_sets[problem.reference])
    for optimum in found:
        assert optimum.converged
        assert optimum.value == pytest.approx(0.265, rel=1e-2)
        assert optimum.value < paper < 1
        assert excess(search.space, optimum.x) < 1e-12
        assert optimum.verification.difference < 1e-9


def test_on_the_pickup_the_usual_starts_find_one_design_whatever_the_seed():
    """From the best spread designs as they are, seed 0 leads to a design 11 % worse than seed 2."""
    vehicle = builtin_truck()
    search = prepare_search(vehicle, vehicle.problem("paper"), vehicle.rates, vehicle.speed)
    n_starts = SearchOptions.starts
    found = [optimise(search, start_points(search, vehicle.rates, n_starts, s)) for s in (0, 2)]
    assert all(optimum.converged for optimum in found)
    np.testing.assert_allclose([o.value for o in found], found[0].value, rtol=SEARCHED)
