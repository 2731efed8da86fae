"""Offsets and angles of mounts as variables of a search: derivatives, and vehicles made anew."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from cab_on_struts import cab_on_struts
from dynamic_mounts import MAXWELL, on_mounts
from four_cylinder import four_cylinder
from mounted_cabin import mounted_cabin, twisted_cabin
from mounted_machine import FLAT, SLANTED, mounted_machine

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.pareto import find_front
from modeviz.optimise.place_variables import seen_from
from modeviz.optimise.search import prepare_search
from modeviz.optimise.trade_off import prepare_trade_off, sides
from modeviz.report.front import front_csv, front_record
from modeviz.study.study import Study
from modeviz.vehicle import placement
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint
from modeviz.vehicle.mode_damping import ModeDamping
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.vehicle.problem import (
    DeflectionLimit,
    DesignGroup,
    FrequencyWindow,
    Performance,
    Problem,
)

MOVED = dict.fromkeys("xyz", (-0.03, 0.03))
BAND = {"highest_frequency": 30.0, "frequency_step": 0.25}
STEP = 1e-5
"""Of a number: its derivatives are to be good to 1e-5 of the largest."""


@cache
def engine():
    """A four-cylinder on a subframe, that something shakes."""
    subframe = RigidBody(
        "subframe", "frame", "subframe", 60.0, np.array([2.3, 0.0, 0.0]), 4 * np.eye(3)
    )
    bushings = Spring(
        "bushings", "bushings", ("subframe", GROUND), np.tile([2.3, 0.0, 0.0], (2, 1)),
        np.full(3, 2e6), rotational_stiffness=np.full(3, 5e5), loss_factor=0.05,
    )  # fmt: skip
    vehicle = four_cylinder(carrier="subframe", others=(subframe,), held=(bushings,))
    return replace(
        vehicle,
        **BAND,
        forces=(Force("shaker", "engine", np.array([2.3, 0.1, 0.3]), SLANTED, FLAT),),
        response_points=(ResponsePoint("head", "engine", np.array([2.0, 0.1, 0.5])),),
    )


@cache
def symmetric():
    """An engine on two pairs of mounts of rubber, to a frame that stands on four, on shaken ground."""
    vehicle = on_mounts(MAXWELL)
    return replace(
        vehicle,
        **BAND,
        forces=(Force("shaker", "engine", np.array([0.1, 0.0, 1.0]), SLANTED, 10.0),),
        base_motions=(BaseMotion("floor", SLANTED, "acceleration", FLAT, ("F0", "F3")),),
    )


ENGINE = (
    DesignGroup("M1", offsets={"x": (-0.03, 0.03), "y": (-0.01, 0.05)}),
    DesignGroup("M2", ("vertical",), offsets={"z": (-0.02, 0.04)}, angles={"y": (-0.5, 0.5)}),
)
RUBBER = (
    DesignGroup("E", (), offsets={"y": (-0.02, 0.03)}, angles={"x": (-0.4, 0.4)}),
    DesignGroup("F", offsets={"y": (-0.02, 0.02)}),
)
SHAKEN = (Performance(np.linspace(5, 30, 4), roads=("shaker",)),)


def design(search, seed=1):
    """Some design well within its limits."""
    spread = np.random.default_rng(seed).uniform(0.3, 0.7, search.space.n_variables)
    return search.space.sampled(spread)


def derivatives(function, x, step=STEP):
    """∂f/∂x along the last axis, by central differences."""
    steps = step * np.eye(len(x))
    return np.stack(
        [np.subtract(function(x + dx), function(x - dx)) / (2 * step) for dx in steps], axis=-1
    )


def search_of(vehicle, goal, groups=ENGINE, **fields):
    fields = {"performance": SHAKEN, **fields}
    return prepare_search(vehicle, Problem("p", groups, goal=goal, **fields), vehicle.rates, 20.0)


def assert_derivatives_hold(search, step=STEP):
    x, n_rates = design(search), search.space.n_rates
    value, gradient = search.evaluate(x)
    expected = derivatives(
        lambda places: search.value(np.append(x[:n_rates], places)), x[n_rates:], step
    )
    assert value == pytest.approx(search.exact_value(x), rel=1e-5)
    assert np.abs(gradient[n_rates:] - expected).max() < 1e-5 * np.abs(expected).max()


@pytest.mark.parametrize(
    "goal",
    ["accelerations", "peak", "rms", "iso 2631", "rating", "forces", "transmissibility", "purity",
     "decoupling", "change"],
)  # fmt: skip
def test_derivatives_to_places_are_those_of_vehicles_made_anew(goal):
    assert_derivatives_hold(search_of(engine(), goal))


RUBBER_GOALS = {
    "accelerations": {"performance": (Performance(np.array([8.0, 15.0]), wheel_loads=("shaker",)),)},
    "rms": {"performance": (Performance(np.array([8.0]), roads=("floor",)),)},
    "forces": {"mounts": (MountTarget(("E1", "F0"), ("vertical", "lateral"), ("floor", "shaker")),)},
    "transmissibility": {
        "mounts": (MountTarget(("E1", "E2"), ("vertical",), ("floor",)),),
        "groups": (DesignGroup("E", (), offsets={"y": (-0.02, 0.03)}),),
    },
}


@pytest.mark.parametrize("goal", RUBBER_GOALS)
def test_mirrored_mounts_of_rubber_on_moving_ground_have_derivatives_too(goal):
    fields = {"performance": (), "groups": RUBBER, **RUBBER_GOALS[goal]}
    assert_derivatives_hold(search_of(symmetric(), goal, **fields))


def test_what_resists_turning_may_be_moved_and_turned():
    vehicle = replace(twisted_cabin(), **BAND)
    group = DesignGroup("A", (), offsets={"x": (-0.1, 0.1)}, angles={"x": (-0.4, 0.4)})
    shaken = (Performance(np.array([6.0, 14.0]), roads=("flat",)),)
    assert_derivatives_hold(search_of(vehicle, "accelerations", (group,), performance=shaken))


@pytest.mark.parametrize("goal", ["accelerations", "rms", "forces"])
def test_what_damps_turning_may_be_moved_and_turned(goal):
    first, *others = engine().mount_groups
    damping = np.array([500.0, 20.0, 100.0])
    damped = replace(engine(), mount_groups=(replace(first, rotational_damping=damping), *others))
    moved = DesignGroup("M1", (), offsets={"y": (-0.1, 0.1)}, angles={"x": (-0.4, 0.4)})
    assert_derivatives_hold(search_of(damped, goal, (moved,)))


def test_what_damps_the_turning_of_a_body_that_bends_may_be_moved_and_turned():
    machine = replace(mounted_machine(), **BAND, mode_damping=())
    engine, foot = machine.mount_groups
    (mount,) = foot.mounts
    damped = replace(mount, rotational_damping=np.array([300.0, 800.0, 50.0]))
    vehicle = replace(machine, mount_groups=(engine, replace(foot, mounts=(damped,))))
    moved = DesignGroup("F", (), offsets={"x": (0.0, 0.1)}, angles={"x": (-0.4, 0.4), "z": (-0.3, 0.3)})
    shaken = (Performance(np.array([9.0, 21.0]), wheel_loads=("firing",)),)
    assert_derivatives_hold(search_of(vehicle, "accelerations", (moved,), performance=shaken))


@pytest.fixture(scope="module")
def cab(tmp_path_factory):
    """A cab on struts whose dampers are tuned along z, those in front with some of their own across."""
    vehicle = cab_on_struts(tmp_path_factory.mktemp("cab") / "cab")
    front, *others = vehicle.mount_groups
    across = replace(front, damping=np.array([900.0, 700.0, 0.0]))
    shaker = Force("shaker", "cab", np.array([-0.3, -0.4, 1.6]), SLANTED, 10.0)
    return replace(
        vehicle, highest_frequency=12.0, frequency_step=0.25, mount_groups=(across, *others),
        forces=(shaker,),
    )  # fmt: skip


STRUTS = (
    DesignGroup(
        "F", ("vertical", "damping-vertical"), offsets={"y": (-0.1, 0.1)}, angles={"x": (-0.5, 0.5)}
    ),
    DesignGroup("D", ("damping-vertical",), offsets={"x": (-0.1, 0.2)}),
)
CAB_GOALS = {
    "accelerations": {"performance": (Performance(np.array([2.0, 8.0]), wheel_loads=("shaker",)),)},
    "peak": {"performance": (Performance(np.array([1.0, 6.0]), roads=("shaking frame",)),)},
    "rms": {"performance": (Performance(np.array([8.0]), roads=("shaking frame",)),)},
    "forces": {
        "mounts": (MountTarget(loads=("shaking frame", "shaker")),),
        "performance": (),
    },
    "purity": {"performance": ()},
}


@pytest.mark.parametrize("goal", CAB_GOALS)
def test_struts_whose_dampers_are_tuned_or_their_own_have_derivatives_too(cab, goal):
    assert_derivatives_hold(search_of(cab, goal, STRUTS, **CAB_GOALS[goal]))


@pytest.mark.parametrize("goal", ["accelerations", "forces"])
def test_mounts_on_a_flexible_frame_have_derivatives_too(goal):
    machine = mounted_machine()
    vehicle = replace(machine, **BAND, mode_damping=())
    target = MountTarget(("front",), loads=("firing",))
    search = search_of(
        vehicle, goal, (DesignGroup("E", (), offsets={"x": (-0.1, 0.1), "z": (-0.02, 0.02)}),),
        performance=(Performance(np.array([9.0, 21.0]), wheel_loads=("firing",)),), mounts=(target,),
    )  # fmt: skip
    assert_derivatives_hold(search)


def test_windows_and_deflections_have_derivatives_to_places():
    third = Study(engine()).modes()[3].name
    search = search_of(
        engine(), "purity",
        windows=(FrequencyWindow(third, 5.0, 25.0),),
        deflections=(
            DeflectionLimit("M1", "vertical", 0.01), DeflectionLimit("M2", "fore-aft", 0.01),
            DeflectionLimit("M3", "lateral", 0.01),
        ),
    )  # fmt: skip
    x = design(search)
    margins, slopes = search.margins(x)
    expected = derivatives(lambda x: search.margins(x)[0], x)
    assert len(margins) == 5
    assert (np.abs(slopes - expected).max(axis=1) < 1e-5 * np.abs(expected).max(axis=1)).all()
    windows, deflections = search.at(x).kept
    built = search.space.built(x)
    assert windows.exact_frequencies(search.space.rates(x))[0] == pytest.approx(
        next(mode.frequency_hz for mode in Study(built).modes() if mode.name == third), rel=1e-6
    )
    assert deflections.exact(search.space.rates(x)) == pytest.approx(
        [Study(built).static().results.cases[0].connections[name].deflection[axis]
         for name, axis in (("M1", 2), ("M2", 0), ("M3", 1))], rel=1e-6,
    )  # fmt: skip


def test_a_design_is_worth_what_the_folder_written_with_it_is(tmp_path):
    search = search_of(engine(), "rms")
    x = design(search)
    write_vehicle(search.space.built(x), tmp_path / "found")
    anew = read_vehicle(tmp_path / "found")
    problem = Problem("p", (DesignGroup("M1"),), goal="rms", performance=SHAKEN, is_normalised=False)
    (there, own) = (prepare_goal(v, problem, v.rates, 20.0).exact_value({}) for v in (anew, engine()))
    assert search.value(x) == pytest.approx(there / own, rel=1e-7)


def test_moved_mounts_decouple_an_engine_that_rates_alone_cannot():
    vehicle, groups = four_cylinder(), ("M1", "M2", "M3")
    rates = Problem("rates", tuple(map(DesignGroup, groups)), goal="purity")
    places = replace(rates, groups=tuple(DesignGroup(name, offsets=MOVED) for name in groups))
    alone, found = (Study(vehicle).optimise(problem, 1) for problem in (rates, places))
    assert found.value < 0.5 * alone.value
    assert found.exact_difference < 1e-9
    moved = np.abs([placed.offset for placed in found.placements.values()])
    assert moved.max() <= 0.03 + 1e-12


def test_struts_are_moved_where_the_seat_is_shaken_least(cab):
    group = DesignGroup("F", (), offsets={"x": (-0.4, 0.4)})
    search = search_of(cab, "accelerations", (group,), **CAB_GOALS["accelerations"])
    found = Study(cab).optimise(Problem("p", (group,), **CAB_GOALS["accelerations"]), 1)
    tried = [search.value(np.array([part])) for part in np.linspace(-0.5, 0.5, 9)]
    assert found.value <= min(tried) * (1 + 1e-6)
    assert found.value < 0.99
    assert found.exact_difference < 1e-6


def test_the_goal_of_least_change_takes_moves_for_changes():
    search = search_of(engine(), "change", performance=())
    x = np.zeros(search.space.n_variables)
    assert search.value(x) == 0
    x[search.space.n_rates] = 0.4
    assert search.value(x) == pytest.approx(0.4**2 / 9, rel=1e-12)


def test_limits_that_a_place_sits_on_are_named():
    problem = Problem("p", (DesignGroup("M1", (), offsets={"z": (-0.001, 0.001)}),), goal="purity")
    found = Study(four_cylinder()).optimise(problem, 1)
    assert [limit.name for limit in found.limits] in (
        ["M1 offset z: upper bound"], ["M1 offset z: lower bound"],
    )  # fmt: skip
    (limit,) = found.limits
    wider = replace(problem, groups=(DesignGroup("M1", (), offsets={"z": (-0.0012, 0.0012)}),))
    gained = 1 - Study(four_cylinder()).optimise(wider, 1).value / found.value
    assert limit.gain == pytest.approx(gained, rel=0.05)
    assert "M1 offset z, mm" in found.table()
    assert found.to_dict()["placements"]["M1"]["offset_mm"][2] == pytest.approx(
        1e3 * found.placements["M1"].offset[2]
    )


def test_what_mounts_are_placed_like_already_is_where_a_search_begins():
    given = {"M1": Placement((0.01, 0.0, 0.02)), "M3": Placement((0.0, 0.005, 0.0))}
    problem = Problem("p", (DesignGroup("M1", (), offsets={"x": (-0.03, 0.03)}),), goal="purity")
    vehicle = four_cylinder()
    search = prepare_search(vehicle, problem, vehicle.rates, 20.0, placements=given)
    x = search.space.to_x({})
    assert search.space.placements(x) == given
    own = prepare_goal(with_placements(vehicle, given), problem, vehicle.rates, 20.0)
    assert search.value(x) == pytest.approx(own.value({}), rel=1e-12)


@pytest.mark.parametrize("goal", ["purity", "decoupling"])
def test_modes_with_a_damping_of_their_own_are_decoupled_by_places_as_others_are(goal):
    own = Study(engine()).modes()[3].name
    stated = ModeDamping(0.2, own), ModeDamping(0.1)
    damped, plain = (
        search_of(vehicle, goal) for vehicle in (replace(engine(), mode_damping=stated), engine())
    )
    x = design(damped)
    assert damped.evaluate(x)[0] == pytest.approx(plain.evaluate(x)[0], rel=1e-12)
    assert_derivatives_hold(damped)
    assert damped.space.built(x).mode_damping == stated


def test_what_damping_enters_keeps_mounts_of_such_a_vehicle_where_they_are():
    damped = replace(engine(), mode_damping=(ModeDamping(0.2, 2),))
    with pytest.raises(VehicleError, match=r"of 'M1': modes .* a damping of their own"):
        search_of(damped, "rms")


@pytest.mark.parametrize(
    "fields",
    [
        {"offsets": {"u": (0.0, 1.0)}}, {"offsets": {"x": (0.02, 0.01)}},
        {"offsets": {"x": (0.0, np.inf)}}, {"angles": {"x": (-2.0, 0.0)}}, {"directions": ()},
    ],
)  # fmt: skip
def test_bounds_of_places_that_cannot_be_are_refused(fields):
    with pytest.raises(VehicleError, match="design group 'M1': "):
        DesignGroup("M1", **fields)


def test_bounds_of_places_are_written_and_read_in_any_axes(tmp_path):
    group = DesignGroup(
        "M1", (), offsets={"x": (-0.03, 0.01), "z": (0.0, 0.02)}, angles={"z": (-0.2, 0.3)}
    )
    vehicle = replace(four_cylinder(), problems=(Problem("p", (group,), goal="purity"),))
    write_vehicle(vehicle, tmp_path / "a")
    (read,) = read_vehicle(tmp_path / "a").problem("p").groups
    assert read.directions == ()
    for name in ("offsets", "angles"):
        found, given = getattr(read, name), getattr(group, name)
        assert found.keys() == given.keys()
        for axis, ends in given.items():
            assert found[axis] == pytest.approx(ends)
    text = (tmp_path / "a" / "vehicle.toml").read_text()
    forward = text.replace("name = ", 'axes = "x forward, y left, z up"\nname = ', 1)
    (tmp_path / "a" / "vehicle.toml").write_text(forward)
    (turned,) = read_vehicle(tmp_path / "a").problem("p").groups
    assert turned.offsets["x"] == pytest.approx((-0.01, 0.03))
    assert turned.angles["z"] == pytest.approx((-0.2, 0.3))


def test_a_folder_of_a_design_leaves_its_mounts_the_same_room():
    group = DesignGroup("M1", offsets={"x": (-0.03, 0.03)}, angles={"y": (-0.5, 1.5)})
    problem = Problem("p", (group,), goal="purity")
    vehicle = replace(four_cylinder(), problems=(problem,))
    search = prepare_search(vehicle, problem, vehicle.rates, 20.0)
    found = Placement((0.01, 0.0, 0.0), (0.0, -0.2, 0.0))
    built = search.space.built(search.space.to_x({}, {"M1": found}))
    (group,) = built.problem("p").groups
    assert group.offsets["x"] == pytest.approx((-0.04, 0.02))
    assert group.angles["y"] == pytest.approx((-0.3, np.pi / 2))
    farthest, again = (
        with_placements(v, {"M1": Placement(angles=(0.0, angle, 0.0))})
        for v, angle in ((vehicle, -0.5), (built, group.angles["y"][0]))
    )
    assert again.mounts[0].axes == pytest.approx(farthest.mounts[0].axes, abs=1e-12)


def test_a_folder_of_a_design_has_no_bounds_of_angles_out_of_reach():
    group = DesignGroup("M1", angles={"y": (-1.5, -1.0), "z": (-0.1, 0.1)})
    turned = {"M1": Placement(angles=(0.0, 1.2, 0.0))}
    (left,) = seen_from(Problem("p", (group,), goal="purity"), turned).groups
    assert left.angles == {"z": (-0.1, 0.1)}


def test_the_command_writes_the_vehicle_with_its_mounts_where_they_were_found(tmp_path, capsys):
    problem = Problem("p", (DesignGroup("M1", offsets={"x": (-0.03, 0.03)}),), goal="purity")
    write_vehicle(replace(four_cylinder(), problems=(problem,)), tmp_path / "given")
    asked = ["optimise", str(tmp_path / "given"), "--starts", "1", "--json"]
    assert main([*asked, "--folder", str(tmp_path / "found")]) == 0
    record = json.loads(capsys.readouterr().out)
    given, found = (read_vehicle(tmp_path / name) for name in ("given", "found"))
    moved = 1e3 * (found.mounts[0].points - given.mounts[0].points)
    assert moved == pytest.approx(np.tile(record["placements"]["M1"]["offset_mm"], (2, 1)), abs=1e-9)
    assert abs(moved[0, 0]) > 1
    assert prepare_goal(found, problem, found.rates, 20.0).value({}) == pytest.approx(
        record["objective"]["found"], rel=1e-9
    )


def test_a_folder_that_is_something_else_is_refused_before_the_search(tmp_path, capsys):
    write_vehicle(four_cylinder(), tmp_path / "given")
    (tmp_path / "letter.txt").write_text("Dear")
    asked = ["optimise", str(tmp_path / "given"), "--goal", "purity", "--folder", str(tmp_path)]
    assert main(asked) == 2
    assert "is not a vehicle folder" in capsys.readouterr().err


def test_a_front_has_designs_with_their_mounts_elsewhere():
    group = DesignGroup("A", ("vertical",), offsets={"x": (-0.05, 0.05)})
    shaken = (Performance(np.array([6.0, 14.0]), roads=("flat",)),)
    problem = Problem("p", (group,), performance=shaken)
    vehicle = replace(mounted_cabin(), **BAND)
    pair = sides(vehicle, problem)["lateral against vertical"]
    trade_off = prepare_trade_off(vehicle, problem, pair, vehicle.rates, 20.0)
    front = find_front(trade_off, [vehicle.rates], n_designs=2, n_starts=1)
    assert front.difference < 1e-9
    moved = [design.placements["A"].offset[0] for design in front.designs]
    assert max(map(abs, moved)) == pytest.approx(0.05)
    record = front_record(problem, trade_off, front)
    assert [d["placements"]["A"]["offset_mm"][0] for d in record["designs"]] == pytest.approx(
        [1e3 * x for x in moved]
    )
    assert "A offset x, mm" in front_csv(problem, trade_off, front).splitlines()[0]


def test_what_bodies_lack_is_estimated_of_the_design_that_is_found_alone(monkeypatch):
    told = []
    estimate = placement.missing_compliance
    monkeypatch.setattr(
        placement, "missing_compliance", lambda *given: told.append(1) or estimate(*given)
    )
    vehicle = replace(mounted_machine(), **BAND, mode_damping=())
    group = DesignGroup("E", (), offsets={"x": (-0.1, 0.1)})
    search = search_of(
        vehicle, "accelerations", (group,),
        performance=(Performance(np.array([9.0]), wheel_loads=("firing",)),),
    )  # fmt: skip
    search.evaluate(np.array([0.3]))
    search.value(np.array([0.2]))
    assert not told
    search.space.built(np.array([0.3]))
    assert len(told) == 1
