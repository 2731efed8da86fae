"""Goals of bodies on their mounts against finite differences, theory and what `rigid` prints."""

from dataclasses import replace

import numpy as np
import pytest
from differences import central_difference, rate_derivatives, relative_to_largest
from dynamic_mounts import MAXWELL, on_mounts
from four_cylinder import four_cylinder, on_subframe
from mounted_cabin import mounted_cabin
from mounted_machine import mounted_machine

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import body_purity
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.mounting.body_modes import BasisModes, body_modes, body_rows
from modeviz.mounting.stiffness import held_bodies
from modeviz.optimise.decoupling import prepare_decoupling
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.run import optimise
from modeviz.optimise.search import prepare_search
from modeviz.optimise.starts import start_points
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.decoupling import USUAL, DecoupledBody, Decoupling
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.problem import DesignGroup, Problem
from modeviz.vehicle.vehicle import Vehicle

BOTH = DecoupledBody("engine"), DecoupledBody("subframe", ("y", "rx"), "principal")


def problem_of(vehicle: Vehicle, goal: str, *bodies: DecoupledBody) -> Problem:
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    return Problem("decoupled", groups, goal=goal, decoupling=bodies)


def goal_of(vehicle: Vehicle, goal: str, *bodies: DecoupledBody):
    return prepare_goal(vehicle, problem_of(vehicle, goal, *bodies), vehicle.rates, 20.0)


def shifted(vehicle: Vehicle) -> dict[str, MountRates]:
    return {
        g.name: replace(g.rates, vertical=1.07 * g.rates.vertical, lateral=0.93 * g.rates.lateral)
        for g in vehicle.mount_groups
    }


@pytest.mark.parametrize("goal", ["purity", "decoupling"])
@pytest.mark.parametrize(
    ("vehicle", "bodies"),
    [
        (four_cylinder(), ()),
        (on_subframe(), BOTH),
        (mounted_cabin(), (DecoupledBody("cab", ("x", "y", "rz"), "crank"),)),
    ],
    ids=["engine", "subframe", "cabin"],
)
def test_derivatives_are_central_differences(goal, vehicle, bodies):
    found, rates = goal_of(vehicle, goal, *bodies), shifted(vehicle)
    value, gradient = found.value_and_gradient(rates)
    assert value == pytest.approx(found.value(rates), rel=1e-12)
    expected = rate_derivatives(found.value, rates)
    assert relative_to_largest(gradient, expected, over=0).max() < 1e-5


def test_of_the_truck_each_purity_has_the_derivatives_of_its_reduced_model():
    truck = read_vehicle(builtin_vehicle())
    found, rates = goal_of(truck, "purity", DecoupledBody("engine")), shifted(truck)
    parts, gradients = found.parts_and_gradients(rates)
    assert len(parts) == 6
    group, field = "E", "lateral"  # steps so small that veering modes hardly turn
    expected = central_difference(
        lambda k: found.parts_and_gradients({**rates, group: replace(rates[group], **{field: k})})[0],
        getattr(rates[group], field),
        step=1e-4,
    )
    own = [f"{g.name}.{d}" for g in truck.mount_groups for d in ("vertical", "lateral", "fore_aft")]
    column = gradients[:, own.index("E.lateral")]
    largest = np.abs(gradients).max(axis=1)
    assert (np.abs(column - expected) < 1e-5 * largest).all()
    assert found.value(rates) == pytest.approx(found.exact_value(rates), rel=1e-6)


@pytest.mark.parametrize("goal", ["purity", "decoupling"])
def test_the_full_model_has_the_same_value(goal):
    vehicle = on_subframe()
    found, rates = goal_of(vehicle, goal, *BOTH), shifted(vehicle)
    assert found.value(rates) == pytest.approx(found.exact_value(rates), rel=1e-9)


def test_impurity_is_what_rigid_says():
    vehicle = on_subframe()
    rates = shifted(vehicle)
    results = solve_modal(prepare_modes(vehicle, 200.0), rates)
    said = body_purity(results, 0, "vehicle", USUAL)
    assert goal_of(vehicle, "purity", BOTH[0]).value(rates) == pytest.approx(1 - said.least, rel=1e-6)
    bounce = goal_of(vehicle, "purity", DecoupledBody("engine", ("z",))).value(rates)
    assert bounce == pytest.approx(1 - said.purity("z"), rel=1e-6)


def test_what_is_missing_is_the_sum_of_squares_by_hand():
    targets = Decoupling(0.97, 10.5, 30.0, 1.6, 20.0)
    vehicle = replace(four_cylinder(), decoupling=targets)
    found = body_purity(solve_modal(prepare_modes(vehicle, 100.0), {}), 0, "vehicle", targets)
    missing = [1 - found.purity(m) / 0.97 for m in ("x", "y", "z", "rx", "ry", "rz")]
    f = np.sort([found.frequency(m) for m in ("x", "y", "z", "rx", "ry", "rz")])
    missing += [*(1 - f / 10.5), *(f / 30 - 1), *(1 - np.diff(f) / 1.6)]
    missing.append(1 - abs(found.frequency("z") - found.frequency("ry")) / 20)
    expected = np.sum(np.maximum(missing, 0) ** 2)
    assert goal_of(vehicle, "decoupling").value({}) == pytest.approx(expected, rel=1e-9)


def test_a_search_decouples_the_engine():
    vehicle = four_cylinder()
    problem = problems(vehicle)[0]
    assert problem.goal == "decoupling"
    search = prepare_search(vehicle, problem, vehicle.rates, 20.0)
    found = optimise(search, start_points(search, {}, 3))
    assert found.value == pytest.approx(0.0, abs=1e-9)
    assert found.verification.value == pytest.approx(0.0, abs=1e-9)
    results = solve_modal(prepare_modes(vehicle), found.rates)
    slightly_less = replace(USUAL, purity=0.8499, gap=1.4999, bounce_gap=1.9999)
    assert body_purity(results, 0, "vehicle", slightly_less).passes


def test_a_search_makes_the_least_pure_mode_purer():
    vehicle = four_cylinder()
    search = prepare_search(vehicle, problem_of(vehicle, "purity"), vehicle.rates, 20.0)
    before = search.goal.value({})
    found = optimise(search, start_points(search, {}, 2))
    assert found.value < 0.2 * before
    assert found.verification.value == pytest.approx(found.value, rel=1e-6)


def block(rate_x: float, rate_y: float) -> Vehicle:
    """A body on mounts at its centre of gravity, whose motions are all uncoupled."""
    body = RigidBody("block", "powertrain", "block", 100.0, np.zeros(3), np.diag([4.0, 6.0, 8.0]))
    rates = MountRates(4e5, rate_y, rate_x)
    mount = Mount("m", "m", ("block", GROUND), np.zeros((2, 3)))
    turns = np.array([2e4, 5e4, 9e4])
    group = MountGroup("m", "m", rates, 0.1, usual_bounds(rates), (mount,), rotational_stiffness=turns)
    return Vehicle("block", (body,), (), (group,))


def test_modes_that_cross_uncoupled_pass_each_other():
    """Lateral goes through fore-aft: every direction keeps its own mode, pure all the way."""
    vehicle = block(2e5, 1.9e5)
    goal = goal_of(vehicle, "purity")
    for factor in (0.9, 0.99, 0.999999, 1.0, 1.000001, 1.01, 1.1):
        rates = {"m": MountRates(4e5, 2e5 * factor, 2e5)}
        parts, gradients = goal.parts_and_gradients(rates)
        assert parts == pytest.approx(np.zeros(6), abs=1e-9)
        assert gradients == pytest.approx(np.zeros((6, 3)), abs=1e-12)
    for lateral, is_above in ((2.2e5, True), (1.8e5, False)):
        own = goal.modes.at({"m": MountRates(4e5, lateral, 2e5)})[0]
        x, y = own.leading.argmax(axis=0)[:2]
        assert bool(own.frequency_hz[y] > own.frequency_hz[x]) is is_above


def test_repeated_modes_count_as_their_purest_mixture():
    """However a solver mixes modes of one frequency, as it may."""
    system = assemble(block(2e5, 2e5))
    found, held = solve_modes(system), held_bodies(system)[0]
    rows = body_rows(held, np.eye(3), np.eye(6))
    same = np.flatnonzero(np.diff(found.frequency_hz) < 1e-6)[0]
    turn = np.eye(6)
    angle = 0.7
    turn[same : same + 2, same : same + 2] = [
        [np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)],
    ]  # fmt: skip
    mixed = found.shapes @ turn
    stretch = system.mount_motions @ mixed
    modes = BasisModes(found.omega_n_squared, mixed, stretch, 6, np.zeros(len(stretch), bool))
    k = np.array([2e5, 2e5, 4e5, 2e4, 5e4, 9e4])
    own = body_modes(rows, modes, k)
    modes_of = own.leading.argmax(axis=0)
    assert sorted(modes_of) == list(range(6))
    assert own.purity[modes_of, range(6)] == pytest.approx(np.ones(6), abs=1e-9)
    for direction, mode in enumerate(modes_of):
        assert own.purity_gradient(mode, direction) == pytest.approx(np.zeros(6), abs=1e-12)


@pytest.mark.parametrize("goal", ["purity", "decoupling"])
def test_where_modes_veer_and_change_hands_no_goal_jumps(goal):
    """Bounce and yaw of the engine are coupled, and change hands where they are half and half."""
    vehicle = four_cylinder()
    found = goal_of(vehicle, goal, DecoupledBody("engine", ("z", "rz")))

    def values(low, high, n):
        ways = np.linspace(low, high, n)
        rates = [{"M1": replace(vehicle.rates["M1"], vertical=4.16e5 * way)} for way in ways]
        return np.array([found.value(r) for r in rates])

    coarse, fine = (np.abs(np.diff(values(0.6, 1.6, n))).max() for n in (201, 1601))
    assert fine < coarse / 6  # eight times as many steps are an eighth as high
    assert np.ptp(values(0.6, 1.6, 41)) > 0.1


def test_a_direction_without_a_mode_is_not_pure_at_all():
    """A body that nothing turns about z has no mode there, and no derivative."""
    body = RigidBody("block", "powertrain", "block", 100.0, np.zeros(3), np.diag([4.0, 6.0, 8.0]))
    rates = MountRates(4e5, 3e5, 2e5)
    mount = Mount("m", "m", ("block", GROUND), np.zeros((2, 3)))
    group = MountGroup("m", "m", rates, 0.1, usual_bounds(rates), (mount,))
    goal = goal_of(Vehicle("hung", (body,), (), (group,)), "purity")
    parts, gradients = goal.parts_and_gradients({})
    assert parts == pytest.approx([0, 0, 0, 1, 1, 1], abs=1e-9)
    assert np.isfinite(gradients).all()


def test_a_body_that_is_not_there_or_on_no_mounts_is_named():
    with pytest.raises(VehicleError, match="engin"):
        goal_of(mounted_cabin(), "purity", DecoupledBody("engin"))
    problem = Problem("pure", (DesignGroup("M1"),), goal="purity")
    with pytest.raises(VehicleError, match="'pure': goal 'purity' needs a body on mounts"):
        prepare_decoupling(replace(four_cylinder(), mount_groups=()), problem)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"motions": ("w",)}, "motion"),
        ({"motions": ()}, "expected some of x, y, z"),
        ({"motions": ("x", "x")}, "each once"),
        ({"axes": "engine"}, "axes"),
    ],
)
def test_a_body_to_decouple_is_checked(fields, words):
    with pytest.raises(VehicleError, match=words):
        DecoupledBody("engine", **fields)


def test_mounts_that_depend_on_frequency_are_refused():
    """Their modes have other rates each, which these derivatives do not know."""
    with pytest.raises(VehicleError, match="goal 'purity' needs mounts whose rates do not depend"):
        goal_of(on_mounts(MAXWELL), "purity")


def test_a_search_ends_where_the_full_model_agrees():
    machine = replace(mounted_machine(), mode_damping=())
    groups = tuple(DesignGroup(group.name) for group in machine.mount_groups)
    problem = Problem("p", groups, goal="decoupling", decoupling=(DecoupledBody("engine"),))
    search = prepare_search(machine, problem, machine.rates, machine.speed)
    found = optimise(search, start_points(search, {}, 1), 60)
    assert found.value < 0.7 * search.goal.value({})
    assert found.verification.value == pytest.approx(found.value, rel=1e-4)


@pytest.mark.slow
def test_a_search_of_the_truck_ends_where_the_full_model_agrees():
    """Not where another mode takes the lead, which the full model would see on the other side."""
    truck = read_vehicle(builtin_vehicle())
    problem = replace(truck.problems[0], goal="decoupling")
    search = prepare_search(truck, problem, truck.rates, truck.speed)
    found = optimise(search, start_points(search, {}, 1))
    assert found.value < 0.1 * search.goal.value({})
    assert found.verification.value == pytest.approx(found.value, rel=1e-4)
