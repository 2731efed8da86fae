from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin
from rounding import CABIN

from modeviz.dynamics.truncation_gap import gap_if_solved
from modeviz.errors import VehicleError
from modeviz.optimise.trade_off import Side, prepare_trade_off, sides
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.problem import Performance


def two_rows():
    """The cabin with a seat and a toe panel on either side."""
    points = tuple(
        ResponsePoint(f"{place} {side}", "cab", np.array([x, y, 0.9]))
        for place, x in (("seat track", 1.2), ("toe panel", 0.5))
        for side, y in (("left", -0.4), ("right", 0.4))
    )
    return replace(mounted_cabin(), response_points=points)


def test_directions_and_places_are_traded():
    found = sides(two_rows(), PROBLEM)
    assert list(found) == ["lateral against vertical", "seat track against toe panel"]
    seat, toe = found["seat track against toe panel"]
    assert seat == Side("seat track", points=("seat track left", "seat track right"))
    assert toe.points == ("toe panel left", "toe panel right")


def test_only_what_the_problem_names_is_traded():
    points = ("seat track left",)
    problem = replace(PROBLEM, performance=(replace(PROBLEM.performance[0], points=points),))
    assert list(sides(two_rows(), problem)) == ["lateral against vertical"]
    one = replace(PROBLEM.performance[0], directions=("vertical",))
    assert not sides(mounted_cabin(), replace(PROBLEM, performance=(one,)))


@pytest.mark.parametrize("goal", ["accelerations", "peak", "rms"])
def test_both_goals_together_are_the_whole(goal):
    vehicle = two_rows()
    road = Performance(np.array([8.0, 9, 10]), ("flat",))
    problem = replace(PROBLEM, performance=(road,), goal=goal, is_normalised=False)
    for pair in sides(vehicle, problem).values():
        trade_off = prepare_trade_off(vehicle, problem, pair, vehicle.rates, vehicle.speed)
        first, second = (search.goal.value({}) for search in trade_off.searches)
        both = prepare_trade_off(
            vehicle, problem, (Side("all"), Side("all")), vehicle.rates, vehicle.speed
        )
        together = max(first, second) if goal == "peak" else first + second
        for search in both.searches:
            assert search.goal.value({}) == pytest.approx(together, rel=CABIN)


def test_of_both_goals_the_one_that_differs_more_is_said_and_what_truncation_does_is_found_once(
    monkeypatch,
):
    found = []

    def noted(vehicle):
        found.append(vehicle.rates)
        return gap_if_solved(vehicle)

    monkeypatch.setattr("modeviz.optimise.verification.gap_if_solved", noted)
    vehicle = two_rows()
    pair = next(iter(sides(vehicle, PROBLEM).values()))
    trade_off = prepare_trade_off(vehicle, PROBLEM, pair, vehicle.rates, vehicle.speed)
    design = trade_off.compromise(np.zeros(trade_off.searches[0].space.n_variables))
    first, second = design.values
    wrong = replace(design, values=(first, 1.01 * second))
    verification = trade_off.verified(wrong).verification
    assert verification.difference == pytest.approx(0.01, rel=1e-6)
    assert verification.value == pytest.approx(second, rel=CABIN)
    assert len(found) == 1


def test_the_worse_of_two_goals_has_the_parts_of_both():
    vehicle = two_rows()
    (pair, _) = sides(vehicle, PROBLEM).values()
    trade_off = prepare_trade_off(vehicle, PROBLEM, pair, vehicle.rates, vehicle.speed)
    weights, x = np.array([3.0, 0.5]), np.array([0.1, 0.2, 0.1, -0.2])
    search = trade_off.weighted(weights)
    values = [s.value(x) for s in trade_off.searches]
    parts, gradients = search.parts(x)
    np.testing.assert_allclose(parts, weights * values, rtol=1e-12)
    for part, own, weight in zip(gradients, trade_off.searches, weights, strict=True):
        np.testing.assert_allclose(part, weight * own.evaluate(x)[1], rtol=1e-12)
    assert search.value(x) == pytest.approx(max(weights * values), rel=1e-12)
    exact = search.goal.exact_value(search.space.rates(x))
    assert exact == pytest.approx(search.value(x), rel=1e-9)


def test_what_cannot_be_traded_is_an_error():
    vehicle, pair = (
        mounted_cabin(),
        (Side("lateral", directions=("lateral",)), Side("nowhere", ("roof",))),
    )
    with pytest.raises(VehicleError, match=r"problem 'cabin': nowhere: has no performance variables"):
        prepare_trade_off(vehicle, PROBLEM, pair, vehicle.rates, vehicle.speed)
    rating = replace(PROBLEM, goal="rating")
    with pytest.raises(VehicleError, match=r"goal 'rating' has no points and directions to trade"):
        prepare_trade_off(vehicle, rating, pair, vehicle.rates, vehicle.speed)
