"""An absorber's rate as a variable of the optimiser."""

from dataclasses import replace

import pytest
from cabin_problem import PROBLEM
from differences import central_difference
from mounted_cabin import mounted_cabin

from modeviz.analysis.sensitivity import rate_variables
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.search import prepare_search
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.problem import DesignGroup

SEAT = Absorber("seat", "cab", (1.2, -0.4, 0.9), 12.0, 11.0, 0.1)


@pytest.fixture(scope="module")
def vehicle():
    return with_absorbers(mounted_cabin(), [SEAT])


@pytest.mark.parametrize("goal", ["accelerations", "peak"])
def test_derivatives_by_its_rate_are_those_of_differences(vehicle, goal):
    worth = prepare_goal(vehicle, replace(PROBLEM, goal=goal), vehicle.rates, vehicle.speed)
    own = vehicle.rates["seat"]
    number = [(v.group, v.direction) for v in rate_variables(vehicle)].index(("seat", "vertical"))
    found = worth.value_and_gradient({})[1][number]
    expected = central_difference(
        lambda k: worth.value({"seat": replace(own, vertical=k)}), own.vertical, 1e-3
    )
    assert found != 0
    assert found == pytest.approx(expected, rel=1e-5)


def test_its_rate_alone_is_what_a_search_chooses(vehicle):
    problem = replace(PROBLEM, groups=(DesignGroup("seat", ("vertical",)),), reference="")
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    (variable,) = search.space.variables
    assert (variable.group, variable.fields) == ("seat", ("vertical",))
    space = search.space
    low, high = (space.rates(ends)["seat"] for ends in (space.lower, space.upper))
    # half its frequency to twice it
    assert low.vertical == pytest.approx(vehicle.rates["seat"].vertical / 4)
    assert high.vertical == pytest.approx(4 * vehicle.rates["seat"].vertical)
    assert low.lateral == high.fore_aft == 0
