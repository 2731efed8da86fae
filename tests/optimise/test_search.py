from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from cabin_problem import PROBLEM, cabin_search
from differences import central_difference
from limits_kept import excess
from mounted_cabin import mounted_cabin
from rounding import CABIN
from scipy.optimize import nnls
from threadpoolctl import threadpool_limits
from toy_goals import CENTER, MINIMUM, logarithmic_search, paraboloid

from modeviz.analysis.modal_results import solve_modal
from modeviz.compute.cancel import CancelToken
from modeviz.errors import SolveError, VehicleError
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET
from modeviz.optimise.search import prepare_search
from modeviz.optimise.windows import SLACK
from modeviz.vehicle.problem import FrequencyWindow


def gradient_differences(function, x):
    """∂f/∂x of a function of designs, the last axis."""

    def along(i, step):
        return function(np.where(np.arange(len(x)) == i, x + step - 1, x))

    return np.stack(
        [central_difference(lambda s, i=i: along(i, s), 1.0, step=1e-3) for i in range(len(x))], axis=-1
    )


def test_the_minimum_of_a_convex_goal_under_limits_is_the_one_found_by_hand():
    search = logarithmic_search(paraboloid(CENTER))
    descent = descend(search, np.zeros(4), budget=100)
    assert descent.converged
    np.testing.assert_allclose(descent.x, MINIMUM, atol=1e-7)
    u = search.space.members @ MINIMUM
    assert descent.value == pytest.approx(0.5 * np.sum((u - CENTER) ** 2) + 1, rel=1e-12)


def test_a_goal_of_any_size_is_followed_as_far():
    search = logarithmic_search(lambda u: tuple(1e-9 * v for v in paraboloid(CENTER)(u)))
    np.testing.assert_allclose(descend(search, np.zeros(4), budget=100).x, MINIMUM, atol=1e-7)


@pytest.mark.parametrize("start", np.array([[-9.0, 9, -9, 9], [9, -9, 9, -9], [0, 9, -9, -9]]))
def test_every_design_it_tells_keeps_all_limits(start):
    search, steps = cabin_search(), []
    descent = descend(search, start, budget=200, tell=steps.append)
    assert len(steps) == descent.evaluations > 5
    assert max(excess(search.space, step.x) for step in steps) < 1e-12
    assert [step.evaluations for step in steps] == list(range(1, len(steps) + 1))
    values = [step.value for step in steps]
    assert values == sorted(values, reverse=True)
    assert values[-1] == descent.value
    assert search.value(descent.x) == pytest.approx(descent.value, rel=1e-12)


def test_derivatives_follow_the_numbers_that_are_searched():
    search, x = cabin_search(), np.array([0.3, 0.1, -0.2, 0.4])
    value, gradient = search.evaluate(x)
    assert value == pytest.approx(search.value(x), rel=CABIN)
    expected = gradient_differences(search.value, x)
    np.testing.assert_allclose(gradient, expected, rtol=0, atol=1e-6 * np.abs(expected).max())


def test_it_stops_when_its_budget_is_spent_and_keeps_the_best():
    search, steps = cabin_search(), []
    descent = descend(search, np.zeros(4), budget=4, tell=steps.append)
    assert descent.reason == OUT_OF_BUDGET
    assert not descent.converged
    assert descent.evaluations == 4
    assert descent.value == steps[-1].value <= 1.0


def test_it_stops_when_it_is_cancelled_and_keeps_the_best():
    token = CancelToken()

    def cancel(step):
        if step.evaluations == 3:
            token.cancel()

    search = cabin_search()
    descent = descend(search, np.zeros(4), 100, token, cancel)
    assert (descent.reason, descent.evaluations) == (CANCELLED, 3)
    assert search.value(descent.x) == pytest.approx(descent.value, rel=1e-12)


def test_cancelled_before_it_starts_it_keeps_the_start():
    token = CancelToken()
    token.cancel()
    descent = descend(cabin_search(), np.zeros(4), 100, token)
    assert (descent.reason, descent.evaluations) == (CANCELLED, 1)
    np.testing.assert_array_equal(descent.x, np.zeros(4))


def test_a_design_that_cannot_be_solved_is_named():
    def function(u):
        if u[0] > 0.2:
            raise SolveError("no accurate response at 9 Hz")
        return paraboloid(CENTER)(u)

    search = logarithmic_search(function)
    with pytest.raises(SolveError, match=r"^no accurate response at 9 Hz; with A vertical 1\d+ N/mm"):
        descend(search, np.array([0.3, 0, 0, 0]), budget=100)
    with pytest.raises(SolveError, match=r"B rates × 1$"):
        search.value(np.array([0.3, 0, 0, 0]))


def test_a_goal_that_is_no_number_is_an_error():
    search = logarithmic_search(lambda u: (np.nan, u))
    with pytest.raises(SolveError, match=r"the goal is nan .* with A vertical 800 N/mm"):
        descend(search, np.zeros(4), budget=10)


def test_a_window_is_kept_by_what_it_finds():
    free = cabin_search()
    windows = (FrequencyWindow("cab yaw", high_hz=9.0),)
    search = cabin_search(windows=windows)
    descent = descend(search, np.zeros(4), budget=300)
    assert descent.converged
    assert (search.margins(descent.x)[0] >= -SLACK).all()
    (f,) = search.windows.exact_frequencies(search.space.rates(descent.x))
    assert 8.9 < f <= 9.0
    assert descent.value > descend(free, np.zeros(4), budget=300).value


@pytest.mark.parametrize(("goal", "high_hz"), [("accelerations", 10.0), ("peak", 9.0)])
def test_what_a_design_has_left_to_windows_is_one_eigenproblem(monkeypatch, goal, high_hz):
    search, solved = cabin_search(goal=goal, windows=(FrequencyWindow("cab yaw", 0, high_hz),)), []

    def counted(prepared, rates):
        solved.append(rates)
        return solve_modal(prepared, rates)

    monkeypatch.setattr("modeviz.optimise.windows.solve_modal", counted)
    descent = descend(search, np.zeros(4), budget=300)
    assert descent.converged
    assert 5 < len(solved) <= descent.evaluations + 1


def test_without_a_design_that_keeps_the_window_there_is_none():
    search = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=1.0),))
    descent = descend(search, np.zeros(4), budget=20)
    assert descent.x is None
    assert descent.value == np.inf


def test_locked_rates_stay():
    vehicle = mounted_cabin()
    locked = frozenset({("A", "lateral")})
    search = prepare_search(vehicle, PROBLEM, vehicle.rates, vehicle.speed, locked)
    descent = descend(search, np.zeros(search.space.n_variables), budget=100)
    assert search.space.rates(descent.x)["A"].lateral == vehicle.rates["A"].lateral
    assert descent.value < 1


def test_an_unknown_mode_of_a_window_is_an_error():
    with pytest.raises(VehicleError, match=r"window: unknown mode 'cab yawn': did you mean 'cab yaw'"):
        cabin_search(windows=(FrequencyWindow("cab yawn", high_hz=9.0),))


@pytest.fixture(scope="module")
def truck():
    vehicle = builtin_truck()
    with threadpool_limits(limits=1, user_api="blas"):
        yield prepare_search(vehicle, vehicle.problem("paper"), vehicle.rates, vehicle.speed)


def residual(search, x):
    """By how much the goal's derivatives differ from what the limits it sits on could balance."""
    _, gradient = search.evaluate(x)
    on = search.space.rows @ x - search.space.values > -1e-9
    rows = search.space.rows[on]
    multipliers, _ = nnls(rows.T, -gradient)
    return np.abs(gradient + rows.T @ multipliers).max() / np.abs(gradient).max()


def test_on_the_truck_every_step_keeps_the_papers_limits_and_ends_at_a_minimum(truck):
    for start in (np.zeros(truck.space.n_variables), *truck.space.samples(2, seed=1)):
        steps = []
        descent = descend(truck, start, budget=500, tell=steps.append)
        assert max(excess(truck.space, step.x) for step in steps) < 1e-12
        assert descent.reason == CONVERGED
        assert residual(truck, descent.x) < 1e-5


def test_on_the_truck_cab_yaw_is_kept_under_ten_hertz_in_the_full_model(truck):
    vehicle = truck.space.vehicle
    window = FrequencyWindow("cab yaw", high_hz=10.0)
    problem = replace(vehicle.problem("paper"), windows=(window,))
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    descent = descend(search, np.zeros(search.space.n_variables), budget=500)
    (f,) = search.windows.exact_frequencies(search.space.rates(descent.x))
    assert search.windows.exact_frequencies({}) > 11
    assert f <= 10.0
