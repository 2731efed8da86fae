"""The mount optimisation of a vehicle whose file has none."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from mounted_cabin import mounted_cabin

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.optimise.search import prepare_search
from modeviz.vehicle.default_problem import ROAD_HZ, default_problem
from modeviz.vehicle.mount_rates import MountRates


def test_it_has_every_rate_the_first_road_and_all_wheel_loads():
    problem = default_problem(mounted_cabin())
    assert [(g.group, g.directions) for g in problem.groups] == [
        ("A", ("vertical", "lateral", "fore-aft")),
        ("B", ("vertical", "lateral", "fore-aft")),
    ]
    road, wheels = problem.performance
    assert (road.roads, road.wheel_loads) == (("flat",), ())
    assert (wheels.roads, wheels.wheel_loads) == ((), ("front left radial force",))
    assert problem.reference == "soft"
    assert problem.is_normalised


def test_it_can_be_searched():
    vehicle = mounted_cabin()
    search = prepare_search(vehicle, default_problem(vehicle), vehicle.rates, vehicle.speed)
    value, gradient = search.evaluate(np.zeros(6))
    assert value == pytest.approx(1.0, rel=1e-12)
    assert gradient.all()


def test_of_the_pickup_it_has_the_papers_loads_and_points():
    vehicle = builtin_truck()
    paper, found = vehicle.problem("paper"), default_problem(vehicle)
    for ours, theirs in zip(found.performance, paper.performance, strict=True):
        np.testing.assert_allclose(ours.frequency_hz, theirs.frequency_hz, rtol=1e-12)
        assert (ours.roads, ours.wheel_loads) == (theirs.roads, theirs.wheel_loads)
    assert found.reference == paper.reference


def test_rates_that_no_factor_moves_are_left_out():
    vehicle = mounted_cabin()
    front, rear = vehicle.mount_groups
    front = replace(
        front, rates=MountRates(8e5, 0.0, 4e5), bounds=(MountRates(1, 0, 0), front.bounds[1])
    )
    loose = replace(rear, rates=MountRates(0.0, 0.0, 0.0))
    problem = default_problem(replace(vehicle, mount_groups=(front, loose)))
    assert [(g.group, g.directions) for g in problem.groups] == [("A", ("vertical",))]


def test_of_a_short_road_only_the_frequencies_it_holds_at_the_vehicles_speed_are_asked_for():
    vehicle = mounted_cabin()
    road = vehicle.roads[0]
    f, f_max = road.frequency_hz, 5.0
    short = replace(road, frequency_hz=f[f < f_max], spectrum=road.spectrum[f < f_max])
    with_short = replace(vehicle, roads=(short,), speed=2 * road.speed)
    wanted = default_problem(with_short).performance[0].frequency_hz
    assert wanted[0] == 6.0
    assert 9.5 < wanted[-1] <= 2 * f_max
    prepare_search(with_short, default_problem(with_short), vehicle.rates, with_short.speed)


@pytest.mark.parametrize(
    ("lacking", "named"),
    [
        ({"response_points": ()}, "a [[response_point]];"),
        (
            {"roads": (), "wheel_loads": (), "connections": ()},
            "what shakes it: a [[tyre]] with stiffness along z, which roads move, a [[wheel_load]], a "
            "[[force]] or a [[base_motion]];",
        ),
        (
            {"mount_groups": (), "rate_sets": {}, "response_points": ()},
            "a [[mount_group]] with rates above zero and a [[response_point]];",
        ),
    ],
)
def test_what_is_missing_is_named(lacking, named):
    with pytest.raises(VehicleError) as error:
        default_problem(replace(mounted_cabin(), **lacking))
    assert named in str(error.value)


def test_a_vehicle_on_tyres_without_a_road_is_tuned_for_the_usual_one():
    cabin = mounted_cabin()
    (performance,) = default_problem(replace(cabin, roads=(), wheel_loads=(), problems=())).performance
    assert performance.roads == ("ISO C",)
    assert len(performance.frequency_hz) == len(ROAD_HZ)


@pytest.mark.parametrize(("kind", "load"), [("cab", "shaking frame"), ("machine", "shaft")])
def test_what_only_the_ground_or_a_force_shakes_is_tuned_for_its_rms_there(tmp_path, kind, load):
    vehicle = read_vehicle(new_vehicle(kind, tmp_path / kind))
    problem = default_problem(vehicle)
    assert problem.goal == "rms"
    assert problem.performance[0].roads == (load,)
    spectrum = vehicle.random_load(load).amplitude
    np.testing.assert_array_equal(problem.performance[0].frequency_hz, spectrum.frequency_hz[[0, -1]])
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    value, gradient = search.evaluate(np.zeros(len(search.space.variables)))
    assert value == pytest.approx(1.0, rel=1e-9)
    assert gradient.all()
