"""What is chosen on the page, as a problem."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import SOFT, STIFF, mounted_cabin

from modeviz.errors import VehicleError
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import UNLIMITED, DesignGroup, FrequencyWindow, Performance, Problem
from modeviz.viewer.session.planning.plan import first_plan, plan_of, planned

FIXED = DesignGroup("A", fixed_ratios=True)
YAW = FrequencyWindow("cab yaw", 3.0, 9.0)
ROLL = FrequencyWindow("cab roll", high_hz=5.0)


@pytest.fixture
def vehicle():
    shaken = Performance(np.array([8.0]), roads=("flat",))
    own = Problem("own", (FIXED,), (shaken,), windows=(YAW, ROLL), is_normalised=False)
    other = Problem("other", (DesignGroup("B"),), (shaken,), goal="rms")
    return replace(mounted_cabin(), problems=(own, other))


def showing(vehicle, group):
    """A plan of the first problem in which both groups may change and one is shown."""
    return replace(first_plan(vehicle), free=frozenset("AB"), shown_group=group)


def designs(vehicle, plan):
    return {group.group: group for group in planned(vehicle, plan).groups}


def test_the_first_plan_is_the_vehicles_usual_problem_as_it_is(vehicle):
    plan = first_plan(vehicle)
    assert (plan.problem, plan.goal, plan.is_normalised) == ("own", "accelerations", False)
    assert (plan.free, plan.mode, plan.low_hz, plan.high_hz) == ({"A"}, "cab yaw", 3.0, 9.0)
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
    found = designs(vehicle, showing(vehicle, "A"))
    assert found["A"] is FIXED
    assert not found["B"].fixed_ratios


def test_a_band_that_reaches_the_highest_frequency_has_no_upper_end(vehicle):
    plan = plan_of(vehicle, vehicle.problems[1])
    assert planned(vehicle, plan).windows == ()
    (window,) = planned(vehicle, replace(plan, mode="cab yaw", low_hz=4.0)).windows
    assert (window.low_hz, window.high_hz, window.is_inside) == (4.0, np.inf, True)


def test_bounds_and_directions_are_those_of_the_group_that_is_shown(vehicle):
    softer = replace(SOFT, lateral=5e3)
    plan = showing(vehicle, "B").with_group(softest=softer, free=frozenset({"lateral", "vertical"}))
    found = designs(vehicle, plan)
    assert found["A"] is FIXED
    assert found["B"].bounds == (softer, STIFF)
    assert found["B"].directions == ("vertical", "lateral")
    held = replace(plan, free=frozenset("A"))
    assert designs(vehicle, replace(held, free=frozenset("AB")))["B"].bounds == (softer, STIFF)


def test_bounds_of_the_mount_group_are_left_to_it(vehicle):
    plan = showing(vehicle, "B").with_group(free=frozenset({"vertical"}))
    assert designs(vehicle, plan)["B"].bounds is None


@pytest.mark.parametrize(
    ("ratios", "own", "asked"),
    [
        ("limited", None, (0.25, 0.8)),
        ("limited", (0.3, 0.9), None),
        ("free", None, None),
        ("free", (0.3, 0.9), UNLIMITED),
        ("fixed", (0.3, 0.9), None),
    ],
)
def test_ratios_are_limited_kept_or_free(vehicle, ratios, own, asked):
    a, b = vehicle.mount_groups
    vehicle = replace(vehicle, mount_groups=(a, replace(b, ratio_limits=own)))
    plan = showing(vehicle, "B")
    assert plan.group.ratios == ("limited" if own else "free")
    found = designs(vehicle, plan.with_group(ratios=ratios))["B"]
    assert found.ratio_limits == asked
    assert found.fixed_ratios == (ratios == "fixed")


def test_ratios_that_a_problem_leaves_free_are_shown_so(vehicle):
    free = DesignGroup("A", ratio_limits=UNLIMITED)
    limited = [replace(group, ratio_limits=(0.3, 0.9)) for group in vehicle.mount_groups]
    problem = replace(vehicle.problems[0], groups=(free,))
    vehicle = replace(vehicle, mount_groups=tuple(limited), problems=(problem,))
    plan = first_plan(vehicle)
    assert plan.group.ratios == "free"
    changed = plan.with_group(stiffest=MountRates(2e6, 2e6, 2e6))
    assert designs(vehicle, changed)["A"].ratio_limits == UNLIMITED


def test_accelerations_are_changed_a_part_at_a_time(vehicle):
    plan = first_plan(vehicle).with_one_more_load()
    assert plan.shown_load == 1
    plan = plan.with_load(
        roads=frozenset(),
        wheel_loads=frozenset({"front left radial force"}),
        frequencies="11, 13",
        directions=frozenset({"fore-aft"}),
        weight=2.0,
        target=0.1,
    )
    road, wheel = planned(vehicle, plan).performance
    assert road is vehicle.problems[0].performance[0]
    assert (wheel.roads, wheel.wheel_loads) == ((), ("front left radial force",))
    assert wheel.frequency_hz.tolist() == [11, 13]
    assert (wheel.directions, wheel.points) == (("fore-aft",), ())
    assert (wheel.weight, wheel.target) == (2.0, 0.1)
    left = plan.without_load()
    assert (left.loads, left.shown_load) == (plan.loads[:1], 0)


def test_a_problem_without_accelerations_gets_some_if_asked(vehicle):
    rated = replace(vehicle.problems[1], performance=(), goal="rating")
    plan = plan_of(vehicle, rated)
    vehicle = replace(vehicle, problems=(vehicle.problems[0], rated))
    assert planned(vehicle, plan).performance == ()
    assert plan.with_load(weight=3.0) == plan
    (road,) = planned(vehicle, plan.with_one_more_load()).performance
    assert (road.roads, road.points, road.directions) == (("flat",), (), ("lateral", "vertical"))
    assert (road.frequency_hz == np.linspace(6, 14, 25)).all()
    assert plan.with_one_more_load().without_load() == plan


def test_roads_of_iso_8608_are_chosen_and_kept_as_a_problem_has_them(vehicle):
    """Those the page offers, in their order, and others that a file names."""
    plan = first_plan(vehicle)
    roads = frozenset({"ISO C", "flat", "ISO A", "ISO 100 cm³"})
    changed = replace(plan, loads=(replace(plan.load, roads=roads),))
    problem = planned(vehicle, changed)
    assert problem.performance[0].roads == ("flat", "ISO A", "ISO C", "ISO 100 cm³")
    assert first_plan(replace(vehicle, problems=(problem,))).load.roads == roads


def test_some_of_the_points_are_named_and_all_are_not(vehicle):
    seat = vehicle.response_points[0]
    vehicle = replace(vehicle, response_points=(seat, replace(seat, name="toe")))
    plan = first_plan(vehicle)
    toe = plan.with_load(points=frozenset({"toe"}))
    assert planned(vehicle, toe).performance[0].points == ("toe",)
    heavier = plan.with_load(weight=3.0)
    assert planned(vehicle, heavier).performance[0].points == ()


def test_what_cannot_be_is_refused(vehicle):
    plan = first_plan(vehicle)
    with pytest.raises(VehicleError, match="no group of mounts may change"):
        planned(vehicle, replace(plan, free=frozenset()))
    with pytest.raises(VehicleError, match="found 9 to 4 Hz"):
        planned(vehicle, replace(plan, low_hz=9.0, high_hz=4.0))
    with pytest.raises(VehicleError, match="group 'A': bounds: lateral: found 10 to 5 N/mm"):
        planned(vehicle, plan.with_group(stiffest=replace(STIFF, lateral=5e3)))
    with pytest.raises(VehicleError, match=r"ratio limits: found 0\.9 to 0\.3"):
        planned(vehicle, plan.with_group(ratios="limited", ratio_limits=(0.9, 0.3)))
    with pytest.raises(VehicleError, match="found 'x', expected numbers and ranges in Hz"):
        planned(vehicle, plan.with_load(frequencies="x"))
    with pytest.raises(VehicleError, match="found neither roads nor wheel_loads"):
        planned(vehicle, plan.with_load(roads=frozenset()))
    with pytest.raises(VehicleError, match="no response point is chosen"):
        planned(vehicle, plan.with_load(points=frozenset()))
