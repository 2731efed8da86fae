"""An engine's orders in a vehicle: against one solve a frequency, read from tables, and as a goal."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from dynamic_mounts import MAXWELL, OTHER_RATES, on_mounts

import modeviz as mv
from modeviz.analysis.driven import driven
from modeviz.analysis.engine_results import solve_engine
from modeviz.analysis.preparation import prepare
from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.mounting.forces import solve_forces
from modeviz.optimise.goals import prepare_goal
from modeviz.vehicle.engine import Engine, EngineOrder, InlineEngine
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Problem
from modeviz.vehicle.vehicle import Vehicle

X, Z = np.eye(3)[[0, 2]]
SPEEDS = np.linspace(10.0, 30.0, 81)
IDLE = 12.5


def with_engine(vehicle: Vehicle) -> Vehicle:
    """The vehicle with a four in line that idles at 750 rpm, and an order of a half beside it."""
    pistons = InlineEngine(
        cylinders=4, stroke=0.09, rod_ratio=0.3, reciprocating_mass=0.6, firing_torque=120.0
    )
    loads = pistons.loads(SPEEDS, X, Z) | {0.5: np.tile([3.0, 1j, 0, 0, 2.0, 1 - 1j], (len(SPEEDS), 1))}
    orders = tuple(
        EngineOrder(f"four order {order:g}", "four", order, order * SPEEDS, load)
        for order, load in sorted(loads.items())
    )
    engine = Engine("four", "engine", np.array([0.1, 0.0, 0.95]), SPEEDS, IDLE, orders)
    return replace(vehicle, engines=(engine,))


VEHICLE = with_engine(on_mounts(MAXWELL))


def test_accelerations_are_those_of_the_full_model_at_each_speed():
    prepared, engine = prepare(VEHICLE), VEHICLE.engines[0]
    speeds = np.array([10.3, 12.5, 17.77, 29.0])
    found = solve_engine(prepared, {"E": OTHER_RATES}, engine, speeds)
    system = assemble(VEHICLE.with_rates({"E": OTHER_RATES}))
    rows = system.motion("engine", engine.position)
    for number, order in enumerate(engine.orders):
        for i, f in enumerate((order.order * speeds).tolist()):
            line = np.array([f])
            if f > VEHICLE.highest_frequency:
                assert np.isnan(found.acceleration_g[i, number]).all()
                continue
            push = (rows.T @ order.at(line)[0])[None, :, None]
            x = direct_response(system, line, push, prepared.outputs)[0, :, 0]
            expected = np.abs(x) * (2 * np.pi * f) ** 2 / 9.80665
            assert np.abs(found.acceleration_g[i, number].ravel() - expected).max() < 1e-8 * max(
                expected
            )


def test_orders_add_up_by_their_powers():
    found = solve_engine(prepare(VEHICLE), {}, VEHICLE.engines[0])
    at = found.idle
    assert found.speed_hz[at] == IDLE
    expected = np.sqrt((found.acceleration_g[at] ** 2).sum(axis=0) / 2)
    np.testing.assert_allclose(found.rms[at], expected, rtol=1e-12)


def test_forces_under_an_order_hold_the_engine_in_balance():
    order, f = VEHICLE.engine_orders[1], np.array([25.0])
    system = assemble(VEHICLE)
    forces = solve_forces(system, order, f, VEHICLE.speed)
    expected = system.motion("engine", VEHICLE.engines[0].position).T @ order.at(f)[0]
    np.testing.assert_allclose(forces.loads[0, :, 0], expected, rtol=1e-12, atol=1e-12)


def test_forces_of_mounts_are_those_of_all_connections_solved_at_each_speed():
    vehicle = replace(VEHICLE, response_points=())
    prepared, engine, speeds = prepare(vehicle), vehicle.engines[0], np.array([12.5, 17.77])
    found = solve_engine(prepared, {"E": OTHER_RATES}, engine, speeds)
    system = assemble(vehicle.with_rates({"E": OTHER_RATES}))
    order, f = engine.orders[1], engine.orders[1].order * speeds
    forces = solve_forces(system, order, f, vehicle.speed)
    n = 6 * len(vehicle.mounts)
    for part, solved in (
        (found.force, forces.force),
        (found.force_in_vehicle_axes, forces.in_vehicle_axes),
    ):
        expected = solved[:, :n, 0].reshape(len(f), -1, 6)
        np.testing.assert_allclose(part[:, 1], expected, atol=1e-8 * np.abs(expected).max())


def test_a_run_up_leaves_no_resonance_out_between_few_speeds():
    vehicle = with_engine(on_mounts(None))
    engine = vehicle.engines[0]
    ends = [0, -1]
    orders = tuple(
        replace(order, frequency_hz=order.frequency_hz[ends], loads=order.loads[ends])
        for order in engine.orders[1:2]
    )
    coarse = replace(engine, speed_hz=SPEEDS[ends], orders=orders)
    prepared = prepare(replace(vehicle, engines=(coarse,)))
    run = solve_engine(prepared, {}, coarse)
    f = orders[0].order * run.speed_hz
    assert np.diff(f[f <= vehicle.highest_frequency]).max() <= vehicle.frequency_step + 1e-9
    fine = solve_engine(prepared, {}, coarse, np.linspace(10.0, 20.0, 3001))
    assert run.rms[:, 0, 2].max() == pytest.approx(fine.rms[:, 0, 2].max(), rel=1e-3)
    assert coarse.idle_hz in run.speed_hz


def test_some_lines_of_a_band_are_solved_as_all_of_them():
    prepared, order = prepare(VEHICLE), VEHICLE.engine_orders[1]
    under = driven(prepared, [order], VEHICLE.speed)
    stiffness, lines = prepared.mount_stiffness({"E": OTHER_RATES}), np.array([23.0, 25.0, 31.0])
    at = np.searchsorted(prepared.frequency_hz, lines)
    for solve in (under.response, under.stretches):
        every = solve(stiffness, prepared.frequency_hz)
        np.testing.assert_allclose(solve(stiffness, lines), every[at], rtol=1e-9)
    H, a, b = under.response_gradient(stiffness, lines)
    assert [len(part) for part in (H, a, b)] == [3, 3, 3]


def test_few_springs_on_fewer_coordinates_are_solved_as_the_equations_of_motion():
    prepared, order = prepare(VEHICLE), VEHICLE.engine_orders[1]
    under = driven(prepared, [order], VEHICLE.speed)
    rates = {name: MountRates(7e4, 9e4, 8e4) for name in ("E", "F")}
    stiffness, lines = prepared.mount_stiffness(rates), np.array([21.3, 25.0, 39.0])
    assert len(under.receptances.changed(stiffness)) > prepared.system.n_dofs
    exact = under.exact_response(stiffness, lines)
    np.testing.assert_allclose(under.response(stiffness, lines), exact, atol=1e-9 * np.abs(exact).max())


def test_idle_quality_is_a_goal_with_derivatives():
    problem = Problem("idle", (DesignGroup("E"),), goal="idle", is_normalised=False)
    goal = prepare_goal(VEHICLE, problem, VEHICLE.rates, VEHICLE.speed)
    value, gradient = goal.value_and_gradient({"E": OTHER_RATES})
    found = solve_engine(prepare(VEHICLE), {"E": OTHER_RATES}, VEHICLE.engines[0], np.array([IDLE]))
    assert value == pytest.approx((found.rms[0, 0] ** 2).sum(), rel=1e-8)
    assert goal.exact_value({"E": OTHER_RATES}) == pytest.approx(value, rel=1e-8)
    h = 1e-5
    for number, field in enumerate(("vertical", "lateral", "fore_aft")):
        k = getattr(OTHER_RATES, field)
        ends = [
            goal.value({"E": MountRates(**{**vars(OTHER_RATES), field: k * x})}) for x in (1 + h, 1 - h)
        ]
        assert gradient[number] == pytest.approx((ends[0] - ends[1]) / (2 * h * k), rel=1e-5)


def test_idle_beyond_the_band_is_refused():
    fast = replace(VEHICLE, highest_frequency=5.0)
    problem = Problem("idle", (DesignGroup("E"),), goal="idle")
    with pytest.raises(VehicleError, match=r"within the band, 0\.1 to 5 Hz"):
        prepare_goal(fast, problem, fast.rates, fast.speed)


def test_a_written_engine_reads_back(tmp_path):
    write_vehicle(VEHICLE, tmp_path / "folder")
    again = read_vehicle(tmp_path / "folder").engines[0]
    was = VEHICLE.engines[0]
    assert (again.name, again.body, again.idle_hz) == (was.name, was.body, was.idle_hz)
    for one, other in zip(was.orders, again.orders, strict=True):
        assert one.order == other.order
        np.testing.assert_allclose(other.frequency_hz, one.frequency_hz, rtol=1e-12)
        np.testing.assert_allclose(other.loads, one.loads, atol=1e-9)


INLINE = """
[[engine]]
name = "four"
body = "engine"
crank_axis = [1.0, 0.0, 0.0]
[engine.inline]
cylinders = 4
stroke = 0.09
rod_ratio = 0.3
reciprocating_mass = 0.6
lowest_speed = 600
highest_speed = 1200
"""


def folder_with(tmp_path: Path, text: str, table: str = "") -> Path:
    """A folder of the vehicle with an engine as it stands in a file."""
    folder = tmp_path / "folder"
    write_vehicle(replace(VEHICLE, engines=()), folder)
    file = folder / "vehicle.toml"
    units = '\n[units]\ntorque = "N m"'
    file.write_text(file.read_text("utf-8").replace("\n[units]", units) + text, "utf-8")
    (folder / "orders.csv").write_text(table, "utf-8")
    return folder


def test_pistons_of_a_file_are_those_of_the_formula(tmp_path):
    engine = read_vehicle(folder_with(tmp_path, INLINE)).engines[0]
    assert 60 * engine.idle_hz == pytest.approx(600)
    assert engine.position.tolist() == VEHICLE.body("engine").center_of_gravity.tolist()
    second = engine.orders[0]
    omega = 2 * np.pi * second.frequency_hz / 2
    np.testing.assert_allclose(second.loads[:, 2].real, 4 * 0.6 * 0.045 * 0.3 * omega**2)


FILE = '\n[[engine]]\nname = "four"\nbody = "engine"\ncrank_axis = [1, 0, 0]\nfile = "orders.csv"\n'


def test_a_table_has_torque_and_forces_with_phases(tmp_path):
    table = (
        "speed (rpm),order,torque (N m),torque_phase (deg),force_z (kN)\n"
        "600,2,100,90,0.5\n900,2,80,0,0.7\n600,4,10,0,0\n"
    )
    engine = read_vehicle(folder_with(tmp_path, FILE, table)).engines[0]
    assert [order.order for order in engine.orders] == [2, 4]
    np.testing.assert_allclose(engine.orders[0].loads[0], [0, 0, 500, 100j, 0, 0], atol=1e-9)
    np.testing.assert_allclose(engine.orders[0].at(np.array([25.0]))[0, 3], 40 + 50j, atol=1e-9)
    np.testing.assert_allclose(engine.orders[0].at(np.array([19.0, 31.0])), 0)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("speed,order,torque\n600,2,1\n", "column speed: found no unit, expected rpm"),
        ("speed (rpm),order\n600,2\n", "expected one or more of force_x"),
        ("speed (rpm),order,torque\n900,2,1\n600,2,1\n", "line 3, column speed: found 600 at order 2"),
        ("speed (rpm),order,torque\n900,0,1\n", "line 2, column order: found 0"),
        ("speed (rpm),order,torque_phase (deg)\n900,1,1\n", "expected one or more of"),
        ("speed (rpm),order,force_x,torque_phase (deg)\n900,1,1,2\n", "torque_phase without torque"),
        ("speed (rpm),order,torque (kg)\n900,1,1\n", "column torque: unknown unit of torque 'kg'"),
        ("speed (rpm),order,torque\n", "found no lines"),
    ],
)
def test_wrong_tables_are_refused_in_a_sentence(tmp_path, table, words):
    with pytest.raises(VehicleError) as refused:
        read_vehicle(folder_with(tmp_path, FILE, table))
    assert words in str(refused.value)
    assert "orders.csv" in str(refused.value)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("crank_axis = [1.0, 0.0, 0.0]\n", "", "crank_axis: missing"),
        ("highest_speed = 1200", "highest_speed = 500", "highest_speed: expected more than lowest"),
        ("[1.0, 0.0, 0.0]", "[0.0, 0.0, 1.0]", "cylinder_axis: expected one at a right angle"),
        ('body = "engine"', 'body = "motor"', "body: unknown body 'motor'"),
        ('body = "engine"', 'body = "engine"\nidle_speed = 100', "idle_speed: found 100 rpm"),
        ('body = "engine"', 'body = "engine"\nfile = "orders.csv"', "found file and inline"),
        ("cylinders = 4", "cylinders = 40", "cylinders: found 40"),
    ],
)
def test_wrong_engines_are_refused_by_their_key(tmp_path, old, new, words):
    with pytest.raises(VehicleError) as refused:
        read_vehicle(folder_with(tmp_path, INLINE.replace(old, new)))
    assert words in str(refused.value)


TABLE = """
[[engine]]
name = "four"
body = "engine"
file = "orders.csv"
"""


def test_an_order_that_is_missing_at_some_speeds_is_told(tmp_path):
    table = "speed (rpm),order,force_z\n" + "".join(
        f"{rpm},{order},{rpm * order}\n"
        for rpm in (600, 700, 800, 900)
        for order in (1, 2)
        if order == 1 or rpm not in (700, 900)
    )
    vehicle = read_vehicle(folder_with(tmp_path, TABLE, table))
    assert vehicle.notes == (
        "orders.csv: column force_z says no unit: taken in N, the force of [units]",
        "orders.csv: order 2 is missing at 700, 900 rpm, where others are given: it goes straight "
        "between its own speeds, and is nothing beyond them",
    )
    second = vehicle.engines[0].orders[1]
    np.testing.assert_allclose(second.at(np.array([2 * 700 / 60, 30.0]))[:, 2], [1400.0, 0.0])


def test_the_command_prints_idle_and_speeds(tmp_path, capsys):
    folder = folder_with(tmp_path, INLINE)
    assert main(["engine", str(folder), "--json"]) == 0
    record, study = json.loads(capsys.readouterr().out), mv.Study(folder).engine()
    said = study.table()
    assert "four at 600 rpm" in said
    assert "order 2" in said
    (order,) = [each for each in record["orders"] if each["order"] == 2]
    assert order["forces"][0] | {"force_n": []} == {"mount": "E0", "motion": "x", "force_n": []}
    at_idle = record["speeds_rpm"].index(record["idle_rpm"])
    z = np.abs(study.force(2, "E0", "z"))
    assert order["forces"][2]["force_n"][at_idle] == pytest.approx(z[at_idle])
    assert record["force_rms"][2]["force_n"] == pytest.approx(study.force_rms("E0", "z").tolist())
    assert f"{study.force_rms('E0', 'z')[at_idle]:.2f}" in said
    with pytest.raises(VehicleError, match="unknown mount 'nowhere'"):
        study.force_rms("nowhere", "z")
    assert main(["engine", str(folder), "--engine", "six"]) == 2
    assert "unknown engine 'six': there are four" in capsys.readouterr().err


def test_forces_are_told_where_there_is_no_response_point(tmp_path, capsys):
    write_vehicle(replace(VEHICLE, response_points=()), tmp_path / "folder")
    assert main(["engine", str(tmp_path / "folder")]) == 0
    said = capsys.readouterr().out
    assert "RMS of all orders, N, along its own axes, at 750 rpm" in said
    assert "0.001 g" not in said
    assert "Order 2: left out at speeds" in said


def test_a_vehicle_without_engines_says_what_it_wants(tmp_path, capsys):
    write_vehicle(replace(VEHICLE, engines=()), tmp_path / "folder")
    assert main(["engine", str(tmp_path / "folder")]) == 2
    assert "[[engine]]" in capsys.readouterr().err
