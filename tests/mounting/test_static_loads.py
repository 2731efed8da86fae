"""Sag and static forces against published numbers, closed forms, equilibrium and full solutions."""

from dataclasses import replace

import numpy as np
import pytest
from engine_on_mounts import ENGINE, engine_group, engine_on_mounts
from oracles import direct_system
from small_systems import block, joined_beams

from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError, VehicleError
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import StaticCase, Statics, solve_statics
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle


def statics_of(vehicle: Vehicle, **rates: MountRates) -> Statics:
    return solve_statics(prepare_statics(assemble(vehicle)), rates)


def spring_between(bodies, at, k, **properties) -> Spring:
    return Spring(
        f"{bodies} {at}", "springs", bodies, np.array([at, at], float), np.array(k, float), **properties
    )


def forces_on(vehicle: Vehicle, case: StaticCase, body: str) -> np.ndarray:
    """Force and moment about the body's centre of gravity of all connections on it, (6,)."""
    center, total = vehicle.body(body).center_of_gravity, np.zeros(6)
    for carried in case.connections.values():
        for sign, name in zip((1, -1), carried.connection.bodies, strict=True):
            if name == body:
                action = sign * carried.vehicle_force
                arm = carried.connection.center - center
                total += action + np.r_[0, 0, 0, np.cross(arm, action[:3])]
    return total


def test_an_engine_sags_as_a_public_study_says():
    case = statics_of(engine_on_mounts()).case("standing")
    # ../shared/cases/powertrain/README.md, printed to 1e-5 mm and 1e-3 N
    assert 1e3 * case.bodies["engine"][:3] == pytest.approx([0.07420, 0.04945, -1.23843], abs=5.1e-6)
    forces = [case.connections[name].force[2] for name in ("M1", "M2", "M3")]
    assert forces == pytest.approx([392.819, 248.390, 508.130], abs=5.1e-4)


def test_a_static_ratio_makes_mounts_softer_under_a_load_that_stays():
    stiff = tuple(engine_group(name, static_ratio=1.0) for name in ("M1", "M2", "M3"))
    soft = statics_of(engine_on_mounts()).case("standing").bodies["engine"]
    hard = statics_of(engine_on_mounts(mount_groups=stiff)).case("standing").bodies["engine"]
    assert soft == pytest.approx(1.3 * hard)


def test_two_springs_share_a_weight_by_their_levers():
    """A block off the middle of two springs: forces by moments, deflections by Hooke."""
    k, front, rear = 1e4, -0.4, 0.6
    held = [
        spring_between(
            ("block", GROUND), (x, 0, 0), (k, k, k), rotational_stiffness=np.array([1e3, 0, 0])
        )
        for x in (front, rear)
    ]
    vehicle = Vehicle("two springs", (block("block", 10.0),), tuple(held))
    case = statics_of(vehicle).case("standing")
    weight = 10.0 * STANDARD_GRAVITY
    shares = weight * rear / (rear - front), -weight * front / (rear - front)
    found = [carried.force[2] for carried in case.connections.values()]
    assert found == pytest.approx(shares)
    assert [c.deflection[2] for c in case.connections.values()] == pytest.approx(
        [-share / k for share in shares]
    )


def test_forces_and_inertia_of_every_body_of_the_truck_balance():
    vehicle = read_vehicle(builtin_vehicle())
    for case in statics_of(vehicle).cases:
        if case.name not in ("standing", "braking 1 g"):
            continue
        load = {"standing": [0, 0, -1], "braking 1 g": [-1, 0, -1]}[case.name]
        for body in vehicle.bodies:
            added = [m for m in vehicle.added_masses if m.body == body.name]
            expected = np.zeros(6)
            for mass, place in [
                (body.mass, body.center_of_gravity),
                *((m.mass, m.position) for m in added),
            ]:
                weight = mass * STANDARD_GRAVITY * np.array(load)
                expected[:3] += weight
                expected[3:] += np.cross(place - body.center_of_gravity, weight)
            found = forces_on(vehicle, case, body.name)
            # the modes of flexible bodies are given to some 1e-6
            assert found == pytest.approx(-expected, abs=1e-4 * 16588)


def test_the_truck_stands_on_its_tyres_with_all_its_weight_and_by_moments():
    vehicle = read_vehicle(builtin_vehicle())
    case = statics_of(vehicle).case("standing")
    masses = [(b.mass, b.center_of_gravity) for b in vehicle.bodies]
    masses += [(m.mass, m.position) for m in vehicle.added_masses]
    weight = STANDARD_GRAVITY * sum(m for m, _ in masses)
    moment = STANDARD_GRAVITY * sum(m * place[0] for m, place in masses)
    tyres = [(t.center[0], case.connections[t.name].vehicle_force) for t in vehicle.tyres]
    lengthwise = sum(t.center[2] * case.connections[t.name].vehicle_force[0] for t in vehicle.tyres)
    assert sum(force[2] for _, force in tyres) == pytest.approx(weight, rel=1e-5)
    assert sum(x * force[2] for x, force in tyres) - lengthwise == pytest.approx(moment, rel=1e-5)


def test_other_rates_give_what_a_vehicle_with_these_gives():
    vehicle = read_vehicle(builtin_vehicle())
    rates = {"C1": vehicle.mount_group("C1").bounds[0], "E": vehicle.mount_group("E").bounds[1]}
    updated, solved = statics_of(vehicle, **rates), statics_of(vehicle.with_rates(rates))
    for one, other in zip(updated.cases, solved.cases, strict=True):
        for name, carried in one.connections.items():
            assert carried.force == pytest.approx(other.connections[name].force, abs=1e-6 * 16588)


def test_rigid_joints_carry_what_springs_leave():
    """A block bolted to another that hangs on a spring: the joint carries its weight and moment."""
    held = spring_between(
        ("upper", GROUND), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.full(3, 1e4)
    )
    joint = Spring(
        "joint", "joints", ("lower", "upper"), np.array([[0.3, 0, 0]] * 2),
        rigid=("x", "y", "z", "rx", "ry", "rz"),
    )  # fmt: skip
    lower = block("lower", 10.0, (0.5, 0.0, 0.0))
    vehicle = Vehicle("joint", (block("upper", 5.0), lower), (held, joint))
    case = statics_of(vehicle).case("standing")
    weight = 10.0 * STANDARD_GRAVITY
    # about the joint, 0.2 m ahead: the weight turns the lower body down, the joint holds it
    assert case.connections["joint"].force == pytest.approx([0, 0, weight, 0, -0.2 * weight, 0])
    assert case.connections["joint"].deflection == pytest.approx(np.zeros(6), abs=1e-12)
    assert forces_on(vehicle, case, "upper")[2] == pytest.approx(5.0 * STANDARD_GRAVITY)


def test_elastic_bodies_bend_as_their_finite_elements_do():
    """Of few modes and residual vectors at what holds them, pushed where there is one."""
    joint = [(8, d) for d in range(6)], [(0, d) for d in range(6)]
    feet = [(2, d) for d in range(6)], [(5, d) for d in range(6)]
    loads = tuple([*ends, *held] for ends, held in zip(joint, feet, strict=True))
    beams, vehicle = joined_beams(n_modes=8, loads=loads)
    push = StaticLoad("front", np.array([10.0, 20.0, 30.0]), position=np.array([2.0, 0, 0]))
    vehicle = replace(vehicle, load_cases=(LoadCase("pushed", loads=(push,)),))
    case = statics_of(vehicle).case("pushed")
    mass, stiffness = direct_system(beams, vehicle)
    fall = np.tile([0, 0, -STANDARD_GRAVITY, 0, 0, 0], sum(b.n_nodes for b in beams.values()))
    forces = mass @ fall
    forces[6 * 8 : 6 * 8 + 3] += push.force
    u = np.linalg.solve(stiffness, forces)
    for name, first, node, place in (("front", 0, 8, 2.0), ("rear", 54, 5, 3.25)):
        moved = assemble(vehicle).motion(name, np.array([place, 0, 0])) @ case.motion
        at = first + 6 * node
        assert moved == pytest.approx(u[at : at + 6], rel=1e-6, abs=1e-9)


def test_a_torque_turns_a_body_by_its_mounts_alone():
    torque = StaticLoad("engine", torque=np.array([0.0, 100.0, 0.0]))
    cases = LoadCase("standing"), LoadCase("torque", np.zeros(3), (torque,))
    case = statics_of(engine_on_mounts(load_cases=cases)).case("torque")
    turned = case.bodies["engine"][3:]
    # ../shared/cases/powertrain/README.md: the elastic torque axis
    axis = turned / np.linalg.norm(turned)
    assert axis == pytest.approx([-0.162989, 0.967415, 0.193759], abs=5e-6)
    assert forces_on(engine_on_mounts(), case, "engine") == pytest.approx(
        [0, 0, 0, 0, -100, 0], abs=1e-9
    )


def test_a_body_that_turns_by_more_than_five_degrees_is_said_to_be_off_by_half_its_turn():
    """Beside r θ, the end of an arm r is as far off as it leaves the tangent of its circle."""
    unit = StaticLoad("engine", torque=np.array([0.0, 1.0, 0.0]))
    turn = statics_of(engine_on_mounts(load_cases=(LoadCase("t", np.zeros(3), (unit,)),))).cases[0]
    per_torque = np.linalg.norm(turn.bodies["engine"][3:])

    def notes(degrees):
        torque = StaticLoad("engine", torque=np.array([0.0, np.radians(degrees) / per_torque, 0.0]))
        cases = (LoadCase("torque", np.zeros(3), (torque,)),)
        return statics_of(engine_on_mounts(load_cases=cases)).cases[0].notes

    assert notes(4.9) == ()
    (said,) = notes(12.0)
    assert said.startswith("body 'engine' turns by 12°, and turns are taken for small")
    angle = np.radians(12.0)
    off = np.hypot(np.sin(angle) - angle, 1 - np.cos(angle)) / angle
    assert said.endswith(f"is known to about {100 * off:.0f} %")


def test_a_force_acts_where_it_is_put():
    at = ENGINE.center_of_gravity + np.array([0, 0.5, 0])
    force = StaticLoad("engine", np.array([0.0, 0.0, 10.0]), position=at)
    twist = StaticLoad("engine", np.array([0.0, 0.0, 10.0]), np.array([5.0, 0.0, 0.0]))
    cases = LoadCase("off", loads=(force,)), LoadCase("twist", loads=(twist,))
    statics = statics_of(engine_on_mounts(load_cases=cases))
    assert statics.case("off").motion == pytest.approx(statics.case("twist").motion)


def test_what_nothing_holds_is_said_and_everything_falls():
    free = Vehicle("free", (block("block"),), ())
    with pytest.raises(SolveError, match=r"'standing': nothing holds 'block' along z, so it falls"):
        statics_of(free)


def test_a_free_vehicle_is_seen_from_itself_while_it_accelerates():
    """Two blocks on a spring pushed apart and along: each bears half of its own inertia."""
    joined = spring_between(
        ("front", "rear"), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.full(3, 1e4)
    )
    push = LoadCase("push", np.zeros(3), (StaticLoad("front", np.array([90.0, 0.0, 0.0])),))
    bodies = block("front", 10.0), block("rear", 20.0)
    statics = statics_of(Vehicle("two", bodies, (joined,), load_cases=(push,)))
    (case,) = statics.cases
    assert case.notes == (
        "nothing holds the vehicle along x: it accelerates as a whole, and what is shown is seen from "
        "it (inertia relief)",
    )
    (carried,) = case.connections.values()
    assert carried.force[0] == pytest.approx(-60.0)  # what takes 20 kg along at 3 m/s²
    assert carried.deflection[0] == pytest.approx(60.0 / 1e4)
    momentum = 10.0 * case.bodies["front"] + 20.0 * case.bodies["rear"]
    assert momentum[:3] == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_mechanism_that_a_load_drives_is_refused_alone():
    hinge = spring_between(
        ("block", GROUND), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.array([1e3, 0, 1e3])
    )
    cases = (
        LoadCase("standing"),
        LoadCase("turned", np.zeros(3), (StaticLoad("block", torque=np.eye(3)[1]),)),
    )
    statics = statics_of(Vehicle("hinged", (block("block"),), (hinge,), load_cases=cases))
    assert [case.name for case in statics.cases] == ["standing"]
    (refused,) = statics.refused
    assert refused.name == "turned"
    assert "nothing holds 'block' about y" in refused.reason
    with pytest.raises(SolveError, match="load case 'turned': nothing holds"):
        statics.case("turned")
    with pytest.raises(VehicleError, match="unknown load case"):
        statics.case("nothing")


def test_mounts_of_no_rate_at_last_hold_nothing():
    rates = MountRates(1e5, 1e5, 1e5)
    mount = Mount("m", "m", ("block", GROUND), np.zeros((2, 3)))
    group = MountGroup(
        "m", "m", rates, 0.1, usual_bounds(rates), (mount,), rotational_stiffness=np.full(3, 10.0)
    )
    vehicle = Vehicle("block", (block("block"),), (), (group,))
    with pytest.raises(SolveError, match="something moves freely that only a mount holds"):
        statics_of(vehicle, m=MountRates(0.0, 1e5, 1e5))
    raised = statics_of(vehicle.with_rates({"m": MountRates(0.0, 1e5, 1e5)}), m=rates).case("standing")
    assert raised.motion == pytest.approx(statics_of(vehicle).case("standing").motion)


def test_a_body_on_a_body_is_pressed_by_both_weights():
    below = spring_between(
        ("lower", GROUND), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.full(3, 1e4)
    )
    above = spring_between(
        ("upper", "lower"), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.full(3, 1e4)
    )
    vehicle = Vehicle("two", (block("lower", 5.0), block("upper", 10.0)), (below, above))
    case = statics_of(vehicle).case("bump 3 g")
    forces = [case.connections[c.name].force[2] / (3 * STANDARD_GRAVITY) for c in (below, above)]
    assert forces == pytest.approx([15.0, 10.0])


def test_turned_mounts_are_told_along_their_axes_and_the_vehicles():
    """A block on one mount that is turned upside down and about: the same force on the body."""
    axes = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    held = spring_between(
        ("block", GROUND), (0, 0, 0), (1e4,) * 3, rotational_stiffness=np.full(3, 1e3)
    )
    vehicle = Vehicle("turned", (block("block"),), (replace(held, axes=axes),))
    (carried,) = statics_of(vehicle).case("standing").connections.values()
    weight = 10.0 * STANDARD_GRAVITY
    assert carried.force[:3] == pytest.approx([0, 0, -weight])
    assert carried.deflection[2] == pytest.approx(weight / 1e4)
    assert carried.vehicle_force[:3] == pytest.approx([0, 0, weight])


def test_a_crank_is_turned_both_ways_where_nothing_else_is_said():
    engine = replace(ENGINE, crank_axis=np.array([0.0, 2.0, 0.0]))
    statics = statics_of(replace(engine_on_mounts(), bodies=(engine,)))
    forward, back = (statics.case(f"engine torque {sign}1000 N m") for sign in "+-")
    still = statics.case("standing").motion
    assert forward.motion - still == pytest.approx(still - back.motion)
    moment = (
        forces_on(statics.vehicle, forward, "engine")[3:]
        - forces_on(statics.vehicle, statics.case("standing"), "engine")[3:]
    )
    assert moment == pytest.approx([0, -1000, 0], abs=1e-6)
    assert len(statics_of(engine_on_mounts()).cases) == len(statics.cases) - 2
