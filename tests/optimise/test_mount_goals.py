"""Goals of what gets through mounts against finite differences and the vehicle solved anew."""

from dataclasses import replace

import pytest
from differences import rate_derivatives, relative_to_largest
from dynamic_mounts import MAXWELL, on_mounts
from mounted_cabin import mounted_cabin
from mounted_machine import mounted_machine

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.optimise.goals import prepare_goal
from modeviz.study.study import Study
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import DesignGroup, Problem

ENGINE = MountTarget(("front", "rear"), loads=("road", "firing"))
ONE = MountTarget(("rear",), ("vertical",), ("noise",), weight=3.0)


def problem_of(vehicle, goal, *targets, is_normalised=False):
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    return Problem("mounts", groups, goal=goal, mounts=targets, is_normalised=is_normalised)


def goal_of(vehicle, goal, *targets, **options):
    return prepare_goal(vehicle, problem_of(vehicle, goal, *targets, **options), vehicle.rates, 20.0)


def shifted(vehicle):
    return {
        g.name: replace(g.rates, vertical=1.07 * g.rates.vertical, lateral=0.93 * g.rates.lateral)
        for g in vehicle.mount_groups
    }


CASES = {
    "machine": (mounted_machine(), (ENGINE, ONE)),
    "cabin": (mounted_cabin(), (MountTarget(loads=("flat", "front left radial force")),)),
    "rubber": (on_mounts(MAXWELL), (MountTarget(("E0", "E2"), loads=("random", "shaker", "floor")),)),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("goal", ["forces", "transmissibility"])
def test_derivatives_are_those_of_finite_differences(case, goal):
    vehicle, targets = CASES[case]
    wanted, rates = goal_of(vehicle, goal, *targets), shifted(vehicle)
    value, gradient = wanted.value_and_gradient(rates)
    assert value == pytest.approx(wanted.value(rates), rel=1e-12)
    expected = rate_derivatives(wanted.value, rates)
    assert relative_to_largest(gradient, expected, over=0).max() < 1e-5


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("goal", ["forces", "transmissibility"])
def test_values_are_those_of_the_vehicle_solved_anew(case, goal):
    vehicle, targets = CASES[case]
    wanted, rates = goal_of(vehicle, goal, *targets), shifted(vehicle)
    assert wanted.value(rates) == pytest.approx(wanted.exact_value(rates), rel=1e-6)


def test_forces_are_the_squares_of_the_rms_that_is_printed():
    forces = Study(mounted_machine()).forces("noise")
    found = goal_of(mounted_machine(), "forces", ONE).value({})
    assert found == pytest.approx(3 * forces.rms("rear", "z") ** 2, rel=1e-6)


def test_transmissibility_is_the_square_of_what_is_printed_of_a_mount_whose_ends_are_in_one_place():
    cabin = mounted_cabin()
    target = MountTarget(("A -0.5",), ("vertical",), ("flat",))
    found = goal_of(cabin, "transmissibility", target).value({})
    loaded = Study(cabin).forces("flat").found
    _, overall = loaded.transmissibility(loaded.number("A -0.5"))
    assert found == pytest.approx(overall[2] ** 2, rel=1e-6)


def test_a_normalised_goal_is_one_with_the_vehicles_own_rates():
    for goal in ("forces", "transmissibility"):
        wanted = goal_of(mounted_machine(), goal, ENGINE, ONE, is_normalised=True)
        assert wanted.value({}) == pytest.approx(1.0)


def test_a_search_makes_the_forces_of_mounts_smaller():
    cabin = mounted_cabin()
    problem = problem_of(cabin, "forces", MountTarget(("A -0.5", "A 0.5"), loads=("flat",)))
    study = Study(cabin)
    before = study.forces("flat").rms("A 0.5", "z")
    found = study.optimise(replace(problem, is_normalised=True), starts=1, budget=40)
    study.rates.use(found.rates)
    assert study.forces("flat").rms("A 0.5", "z") < 0.9 * before


def test_targets_of_mounts_survive_a_vehicle_folder(tmp_path):
    machine = mounted_machine()
    problem = problem_of(machine, "forces", ENGINE, ONE)
    write_vehicle(replace(machine, problems=(problem,)), tmp_path / "machine")
    (read,) = read_vehicle(tmp_path / "machine").problems
    assert (read.goal, read.mounts) == ("forces", (ENGINE, ONE))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mounts": ("raer",)}, "unknown mount 'raer'"),
        ({"loads": ("thunder",)}, "unknown load 'thunder'"),
        ({"mounts": ("rear", "rear")}, "expected each of them once"),
        ({"directions": ("up",)}, "unknown direction 'up'"),
        ({"weight": 0.0}, "weight: found 0.0, expected more than 0"),
    ],
)
def test_a_target_that_cannot_be_is_said_in_a_sentence(change, words):
    with pytest.raises(VehicleError, match=words):
        goal_of(mounted_machine(), "forces", replace(ONE, **change))


def test_the_ground_has_no_acceleration_to_become_small():
    with pytest.raises(VehicleError, match="mount 'foot' stands on the ground"):
        goal_of(mounted_machine(), "transmissibility", MountTarget(loads=("floor",)))


def test_the_command_line_takes_the_goal(tmp_path, capsys):
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    assert main(["optimise", str(tmp_path / "cabin"), "--goal", "forces", "--starts", "1"]) == 0
    assert "mean squares of mounts' forces" in capsys.readouterr().out


def test_forces_under_an_order_of_an_engine_are_a_goal_where_nothing_else_shakes(tmp_path):
    vehicle = read_vehicle(new_vehicle("powertrain", tmp_path / "mine"))
    vehicle = replace(vehicle, highest_frequency=40.0)
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    goal = prepare_goal(vehicle, Problem("forces", groups, goal="forces"), vehicle.rates, vehicle.speed)
    assert goal.cases[0].load.name == "four-cylinder order 2"
    softer = {"M1": MountRates(9e4, 5e4, 7e4)}
    assert goal.value(softer) == pytest.approx(goal.exact_value(softer), rel=1e-8)
    assert goal.value_and_gradient(softer)[0] == pytest.approx(goal.value(softer), rel=1e-12)
