"""What an optimisation problem refuses to be, and what a vehicle says of names in it."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import SOFT, STIFF, mounted_cabin

from modeviz.errors import VehicleError
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Performance, Problem

NAN, INF = float("nan"), float("inf")
HZ = np.array([6.0, 8.0])
GROUP = DesignGroup("A")
ON_ROAD = Performance(HZ, ("flat",))
WINDOW = FrequencyWindow("cab yaw", 5.0, 10.0)
PROBLEM = Problem("comfort", (GROUP,), (ON_ROAD,))


def refused(value, **changes) -> str:
    with pytest.raises(VehicleError) as caught:
        replace(value, **changes)
    return str(caught.value)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"directions": ("up",)}, "unknown direction 'up': there are vertical, lateral, fore-aft"),
        ({"directions": ()}, "directions: found [], expected some of vertical"),
        ({"directions": ("lateral", "lateral")}, "found ['lateral', 'lateral'], expected some of"),
        (
            {"directions": ("vertical", "lateral"), "fixed_ratios": True},
            "directions: found vertical, lateral with fixed ratios",
        ),
        ({"bounds": (STIFF, SOFT)}, "bounds: vertical: found 10000 to 10 N/mm, expected the"),
        ({"ratio_limits": (0.8, 0.25)}, "ratio limits: found 0.8 to 0.25, expected finite numbers"),
        ({"ratio_limits": (-0.1, 0.8)}, "ratio limits: found -0.1 to 0.8"),
        ({"ratio_limits": (0.0, 0.0)}, "ratio limits: found 0 to 0"),
        ({"ratio_limits": (NAN, 0.8)}, "ratio limits: found nan to 0.8"),
        ({"ratio_limits": (0.25, NAN)}, "ratio limits: found 0.25 to nan"),
        ({"ratio_limits": (0.25, INF)}, "ratio limits: found 0.25 to inf"),
    ],
)
def test_a_design_group_that_cannot_be_is_refused(changes, words):
    text = refused(GROUP, **changes)
    assert text.startswith("design group 'A': ")
    assert words in text


def test_a_ratio_may_be_held_by_equal_limits():
    assert replace(GROUP, ratio_limits=(0.5, 0.5)).ratio_limits == (0.5, 0.5)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"frequency_hz": []},
            "frequencies (frequency_hz): found none, expected rising values above zero",
        ),
        ({"frequency_hz": [8.0, 6.0]}, "frequencies (frequency_hz): found 8, 6, expected rising"),
        ({"frequency_hz": [6.0, 6.0]}, "frequencies (frequency_hz): found 6, 6, expected rising"),
        ({"frequency_hz": [0.0, 6.0]}, "frequencies (frequency_hz): found 0, 6, expected rising"),
        ({"frequency_hz": [1.0, NAN]}, "frequency_hz: found 1 values that are not finite"),
        ({"frequency_hz": 6.0}, "frequency_hz: found shape (), expected any"),
        ({"roads": ()}, "found neither roads nor wheel_loads, expected one or more"),
        ({"roads": ("flat", "flat")}, "roads: found flat, flat, expected each of them once"),
        ({"wheel_loads": ("a", "b", "a")}, "wheel_loads: found a, b, a, expected each of them once"),
        ({"points": ("seat", "seat")}, "points: found seat, seat, expected each of them once"),
        ({"directions": ("up",)}, "unknown direction 'up'"),
        ({"directions": ()}, "directions: found []"),
        ({"target": -1.0}, "target: found -1.0, expected zero or more"),
        ({"target": INF}, "target: found inf"),
        ({"weight": -0.5}, "weight: found -0.5"),
        ({"weight": NAN}, "weight: found nan"),
    ],
)
def test_performance_that_cannot_be_is_refused(changes, words):
    text = refused(ON_ROAD, **changes)
    assert text.lower().startswith("performance: ")
    assert words in text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"low_hz": 10.0}, "found 10 to 10 Hz, expected zero or more and the lower one first"),
        ({"low_hz": -1.0}, "found -1 to 10 Hz"),
        ({"low_hz": NAN}, "found nan to 10 Hz"),
        ({"high_hz": NAN}, "found 5 to nan Hz"),
        ({"low_hz": 0.0, "high_hz": INF}, "found neither low_hz nor high_hz, expected one or both"),
        ({"low_hz": 0.0, "is_inside": False}, "to stay out of a band it needs low_hz and high_hz"),
        ({"high_hz": INF, "is_inside": False}, "to stay out of a band it needs low_hz and high_hz"),
    ],
)
def test_a_window_that_cannot_be_is_refused(changes, words):
    text = refused(WINDOW, **changes)
    assert text.startswith("window of 'cab yaw': ")
    assert words in text


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"goal": "rsm"}, "unknown goal 'rsm': did you mean 'rms'? there are accelerations, peak"),
        ({"groups": ()}, "has no groups, so nothing may change; expected one or more"),
        ({"groups": (GROUP, GROUP)}, "design group 'A' is there twice"),
        ({"performance": ()}, "performance: found none with a weight above zero, expected one or more"),
        ({"performance": (replace(ON_ROAD, weight=0.0),)}, "found none with a weight above zero"),
        ({"goal": "peak", "performance": ()}, "performance: found none with a weight above zero"),
        (
            {"windows": (FrequencyWindow("cab yaw", 5.0, 8.0), FrequencyWindow("cab yaw", 9.0))},
            "windows of 'cab yaw': found one from 9 Hz and one to 8 Hz, which no frequency keeps",
        ),
    ],
)
def test_a_problem_that_cannot_be_is_refused(changes, words):
    text = refused(PROBLEM, **changes)
    assert text.startswith("problem 'comfort': ")
    assert words in text


@pytest.mark.parametrize("goal", ["rms", "rating", "iso 2631", "change"])
def test_only_accelerations_need_performance_variables(goal):
    assert replace(PROBLEM, goal=goal, performance=()).goal == goal


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"groups": (DesignGroup("C"),)}, "unknown mount group 'C': there are A, B"),
        (
            {"performance": (ON_ROAD, replace(ON_ROAD, roads=("flat", "rogh")))},
            "unknown random load 'rogh': did you mean 'rough'? there are flat, rough",
        ),
        (
            {"performance": (Performance(HZ, wheel_loads=("x",)),)},
            "unknown harmonic load 'x': there are",
        ),
        (
            {"performance": (replace(ON_ROAD, points=("toe",)),)},
            "unknown response point 'toe': there are",
        ),
        ({"reference": "best"}, "unknown set of rates 'best': there are soft"),
    ],
)
def test_a_name_in_a_problem_that_the_vehicle_does_not_have_is_told(changes, words):
    with pytest.raises(VehicleError) as caught:
        replace(mounted_cabin(), problems=(replace(PROBLEM, **changes),))
    assert str(caught.value).startswith(f"problem 'comfort': {words}")


def test_every_name_that_the_vehicle_has_is_accepted():
    vehicle = mounted_cabin()
    every = Performance(
        HZ,
        tuple(road.name for road in vehicle.roads),
        tuple(load.name for load in vehicle.wheel_loads),
        tuple(point.name for point in vehicle.response_points),
    )
    problem = Problem("all", tuple(map(DesignGroup, vehicle.rates)), (every,), reference="stiff")
    found = replace(vehicle, rate_sets={"stiff": {"A": STIFF}}, problems=(problem,))
    assert found.problem("all") is problem


def test_a_problem_is_told_from_others_by_its_name():
    with pytest.raises(VehicleError, match="problem 'comfort' is there twice"):
        replace(mounted_cabin(), problems=(PROBLEM, PROBLEM))
    with pytest.raises(VehicleError, match="unknown problem 'paper': there are none"):
        mounted_cabin().problem("paper")


def test_accelerations_need_a_point_where_they_are_felt():
    nowhere = replace(mounted_cabin(), response_points=())
    with pytest.raises(VehicleError, match=r"goal 'accelerations' needs a \[\[response_point\]\]"):
        replace(nowhere, problems=(PROBLEM,))
    assert replace(nowhere, problems=(replace(PROBLEM, goal="change", performance=()),)).problems
