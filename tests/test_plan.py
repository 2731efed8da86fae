"""What is chosen on the page, as a problem."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.errors import VehicleError
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Performance, Problem
from modeviz.viewer.plan import Plan, first_plan, plan_of, planned

FIXED = DesignGroup("A", fixed_ratios=True)
YAW = FrequencyWindow("cab yaw", 3.0, 9.0)
ROLL = FrequencyWindow("cab roll", high_hz=5.0)


@pytest.fixture
def vehicle():
    shaken = Performance(np.array([8.0]), roads=("flat",))
    own = Problem("own", (FIXED,), (shaken,), windows=(YAW, ROLL), is_normalised=False)
    other = Problem("other", (DesignGroup("B"),), (shaken,), goal="rms")
    return replace(mounted_cabin(), problems=(own, other))


def test_the_first_plan_is_the_vehicles_usual_problem_as_it_is(vehicle):
    plan = first_plan(vehicle)
    assert plan == Plan("own", "accelerations", False, frozenset("A"), "cab yaw", 3.0, 9.0)
    problem, own = planned(vehicle, plan), vehicle.problems[0]
    assert problem.groups == own.groups
    assert problem.performance == own.performance
    assert problem.windows[1] is ROLL
    assert (problem.windows[0].mode, problem.windows[0].low_hz) == ("cab yaw", 3.0)


def test_without_a_problem_in_its_file_a_vehicle_gets_one_if_it_can():
    vehicle = mounted_cabin()
    assert first_plan(vehicle).problem == "ride"
    assert first_plan(replace(vehicle, response_points=())) is None


def test_groups_that_are_freed_keep_what_the_problem_says_of_them(vehicle):
    plan = replace(first_plan(vehicle), groups=frozenset("AB"))
    a, b = planned(vehicle, plan).groups
    assert a is FIXED
    assert (b.group, b.fixed_ratios) == ("B", False)


def test_a_band_that_reaches_the_highest_frequency_has_no_upper_end(vehicle):
    plan = plan_of(vehicle.problems[1])
    assert planned(vehicle, plan).windows == ()
    (window,) = planned(vehicle, replace(plan, mode="cab yaw", low_hz=4.0)).windows
    assert (window.low_hz, window.high_hz, window.is_inside) == (4.0, np.inf, True)


def test_what_cannot_be_is_refused(vehicle):
    plan = first_plan(vehicle)
    with pytest.raises(VehicleError, match="no group of mounts may change"):
        planned(vehicle, replace(plan, groups=frozenset()))
    with pytest.raises(VehicleError, match="found 9 to 4 Hz"):
        planned(vehicle, replace(plan, low_hz=9.0, high_hz=4.0))
