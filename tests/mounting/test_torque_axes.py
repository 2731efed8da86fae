"""Axes and centres against closed forms, brute force and statics."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from four_cylinder import engine, four_cylinder, on_subframe

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import body_axes, rigid_figures
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.mounting.axes import elastic_axes, torque_roll_axis
from modeviz.mounting.frames import crank_direction
from modeviz.mounting.rigid_part import rigid_parts
from modeviz.mounting.stiffness import held_bodies, holding, mounted_bodies
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

HALF_WIDTH, TILT = 0.3, np.radians(40.0)
COMPRESSION, SHEAR = 4e5, 1e5


def on_v_mounts(height: float, compression=COMPRESSION, shear=SHEAR) -> Vehicle:
    """A body on two pairs of mounts that lean towards its middle, at a height above them."""
    body = RigidBody(
        "engine", "powertrain", "engine", 150.0, np.array([0.0, 0.0, height]), np.diag([5.0, 9.0, 8.0])
    )
    rates = MountRates(vertical=compression, lateral=shear, fore_aft=shear)
    mounts = []
    for x in (-0.4, 0.4):
        for side in (-1, 1):
            axis = np.array([0.0, -side * np.sin(TILT), np.cos(TILT)])
            axes = np.array([[1.0, 0, 0], np.cross(axis, [1.0, 0, 0]), axis])
            place = [x, side * HALF_WIDTH, 0.0]
            mounts.append(
                Mount(f"{x} {side}", "v", ("engine", GROUND), np.array([place, place]), axes=axes)
            )
    group = MountGroup("v", "v", rates, 0.1, usual_bounds(rates), tuple(mounts))
    return Vehicle("on V mounts", (body,), (), (group,))


def elastic_height(compression=COMPRESSION, shear=SHEAR) -> float:
    """Where a sideward force does not roll a body on a pair of leaning mounts, by hand.

    Pushed sideways, each mount answers with F_y = k_yy u and F_z = ± k_yz u, whose moment b k_yz u is
    that of the force at the height h = b k_yz / k_yy.
    """
    s, c = np.sin(TILT), np.cos(TILT)
    return HALF_WIDTH * (compression - shear) * s * c / (compression * s**2 + shear * c**2)


def figures(vehicle):
    return rigid_figures(solve_modal(prepare_modes(vehicle, 200.0), {}))[0]


def test_leaning_mounts_decouple_sideward_motion_and_roll_with_the_body_at_their_elastic_axis():
    at_height = figures(on_v_mounts(elastic_height())).purity
    assert at_height.purity("y") == pytest.approx(1.0, abs=1e-9)
    assert at_height.purity("rx") == pytest.approx(1.0, abs=1e-9)
    above = figures(on_v_mounts(elastic_height() + 0.1)).purity
    assert above.purity("y") < 0.99


def test_the_line_of_sideward_forces_is_at_the_height_found_by_hand():
    held = figures(on_v_mounts(0.15)).axes.held
    assert held.lines[1].point[2] == pytest.approx(elastic_height())
    assert held.lines[0].point[2] == pytest.approx(0.0, abs=1e-12)  # no mount leans lengthways
    assert held.center[:2] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert 0 < held.center[2] < elastic_height()


def test_leaning_mounts_meet_at_their_focus():
    vehicle = on_v_mounts(0.2)
    found = figures(vehicle).axes.focus
    assert found.point == pytest.approx([0.0, 0.0, HALF_WIDTH / np.tan(TILT)])
    assert found.miss == pytest.approx(0.4)  # lengthways: one pair aims there, the other here
    assert len(found.mounts) == 4
    assert figures(four_cylinder()).axes.focus is None


def test_mounts_without_shear_stiffness_have_their_elastic_axis_at_the_focus():
    held = figures(on_v_mounts(0.2, shear=1e-3 * COMPRESSION)).axes.held
    assert held.lines[1].point[2] == pytest.approx(HALF_WIDTH / np.tan(TILT), rel=5e-3)


def test_the_elastic_centre_of_upright_mounts_is_their_weighted_mean():
    vehicle = four_cylinder()
    k = np.array([m.stiffness for m in vehicle.mounts])
    p = np.array([m.center for m in vehicle.mounts])
    others = k.sum(axis=1)[:, None] - k
    expected = (others * p).sum(axis=0) / others.sum(axis=0)
    assert figures(vehicle).axes.held.center == pytest.approx(expected)


def test_a_force_along_a_line_of_the_elastic_axes_does_not_turn_the_body():
    vehicle = four_cylinder()
    system, axes = assemble(vehicle), figures(vehicle).axes.held
    center = vehicle.bodies[0].center_of_gravity
    for line, direction, moment in zip(axes.lines, axes.principal_axes, axes.moments, strict=True):
        force = np.r_[direction, np.cross(line.point - center, direction) + moment * direction]
        motion = np.linalg.solve(system.stiffness, force)
        assert motion[3:] == pytest.approx(0.0, abs=1e-9 * np.abs(motion).max())


def test_the_torque_roll_axis_is_what_a_free_body_turns_about():
    part = rigid_parts(assemble(four_cylinder()))[0]
    crank = np.array([0.6, 0.8, 0.0])
    axis = torque_roll_axis(part, crank)
    assert np.cross(engine().inertia @ axis.direction, crank) == pytest.approx(0.0, abs=1e-12)
    assert axis.direction @ crank > 0


def test_the_elastic_torque_axis_rests_under_the_torque():
    """What a torque about the crank moves: points on the axis only slide along it."""
    vehicle = four_cylinder()
    system, axes = assemble(vehicle), figures(vehicle).axes.held
    motion = np.linalg.solve(system.stiffness, [0, 0, 0, 0, 1.0, 0])
    arm = axes.torque_axis.point - vehicle.bodies[0].center_of_gravity
    moved = motion[:3] + np.cross(motion[3:], arm)
    assert moved == pytest.approx(axes.pitch * motion[3:], abs=1e-12)
    angle = np.arccos(axes.torque_axis.direction @ figures(vehicle).axes.torque_roll_axis.direction)
    assert axes.angle == pytest.approx(angle)


def test_the_distance_of_both_axes_is_the_least_between_any_of_their_points():
    axes = figures(four_cylinder()).axes
    roll, torque = axes.torque_roll_axis, axes.held.torque_axis
    A = np.stack([roll.direction, -torque.direction], axis=1)
    s, t = np.linalg.lstsq(A, torque.point - roll.point, rcond=None)[0]
    apart = roll.point + s * roll.direction - torque.point - t * torque.direction
    assert axes.held.offset == pytest.approx(np.linalg.norm(apart))


def test_on_what_is_elastic_a_body_has_the_compliance_of_the_whole_system():
    vehicle = on_subframe()
    system = assemble(vehicle)
    whole = np.linalg.inv(system.stiffness)
    rates = mount_stiffness(vehicle).real
    for i, part in enumerate(rigid_parts(system)):
        found = mounted_bodies(system).compliance(i, rates)
        assert found == pytest.approx(whole[part.own, part.own], rel=1e-8, abs=1e-14)


def test_with_the_other_ends_still_the_subframe_is_as_good_as_the_ground():
    still = held_bodies(assemble(on_subframe()))[0].compliance(mount_stiffness(four_cylinder()).real)
    on_ground = np.linalg.inv(assemble(four_cylinder()).stiffness)
    assert still == pytest.approx(on_ground, rel=1e-10)


def test_other_rates_give_what_a_vehicle_with_them_has():
    vehicle = on_subframe()
    rates = {"M1": MountRates(1e5, 5e5, 2e5), "M3": MountRates(9e5, 1e4, 3e5)}
    found = body_axes(solve_modal(prepare_modes(vehicle), rates), 0)
    fresh = body_axes(solve_modal(prepare_modes(vehicle.with_rates(rates)), {}), 0)
    for one, other in ((found.held, fresh.held), (found.mounted, fresh.mounted)):
        assert one.torque_axis.direction == pytest.approx(other.torque_axis.direction, rel=1e-8)
        assert one.center == pytest.approx(other.center, rel=1e-8)


def test_a_vehicle_that_nothing_holds_is_told_with_its_inertia_against_the_force():
    """Static motion under a force that the inertia of the whole balances, free of the whole's own."""
    mounted = on_subframe()
    vehicle = Vehicle("free", mounted.bodies, (), mounted.mount_groups)
    system = assemble(vehicle)
    M, K = system.mass, system.stiffness
    free = scipy.linalg.null_space(K, rcond=1e-10)
    free = free @ np.linalg.inv(scipy.linalg.cholesky(free.T @ M @ free))
    P = np.eye(len(M)) - M @ free @ free.T
    expected = P.T @ np.linalg.pinv(K, rcond=1e-10) @ P
    found = mounted_bodies(system).compliance(0, mount_stiffness(vehicle).real)
    own = system.dofs["engine"]
    assert found == pytest.approx(expected[own, own], rel=1e-6, abs=1e-13)


def test_a_body_that_moves_freely_has_no_elastic_axes():
    body = RigidBody("block", "other", "block", 10.0, np.zeros(3), np.eye(3))
    spring = Spring("s", "s", ("block", GROUND), np.zeros((2, 3)), np.array([0.0, 0.0, 1e4]))
    axes = figures(Vehicle("hung", (body,), (spring,))).axes
    assert axes.held is None
    assert axes.torque_roll_axis.direction.tolist() == [1.0, 0.0, 0.0]
    assert axes.mounted.torque_axis is None
    assert axes.mounted.center is None


def test_a_rigid_joint_holds_a_body_as_it_says():
    """Hinged about y, a body turns about that line alone, whatever else it hangs on."""
    body = RigidBody("arm", "other", "arm", 10.0, np.array([0.5, 0.0, 0.0]), np.diag([1.0, 2.0, 3.0]))
    places = np.zeros((2, 3)), np.tile([1.0, 0.0, 0.0], (2, 1))
    hinge = Spring("hinge", "s", ("arm", GROUND), places[0], rigid=("x", "y", "z", "rx", "rz"))
    spring = Spring("spring", "s", ("arm", GROUND), places[1], np.array([0.0, 0.0, 1e4]))
    held = figures(Vehicle("arm", (body,), (hinge, spring))).axes.held
    assert held is not None
    compliance = held_bodies(assemble(Vehicle("arm", (body,), (hinge, spring))))[0].compliance(
        np.zeros(0)
    )
    assert compliance[4, 4] == pytest.approx(1 / 1e4)  # 1 N m gives 1 N at 1 m
    turned = elastic_axes(body.center_of_gravity, compliance, np.array([0, 1.0, 0]), None)
    assert turned.torque_axis.direction == pytest.approx([0, 1, 0])
    assert turned.torque_axis.point == pytest.approx(np.zeros(3), abs=1e-9)


def test_what_goes_along_with_an_engine_does_not_hold_it():
    shaft = RigidBody("shaft", "linkage", "shaft", 5.0, np.array([3.0, 0, 0.1]), np.eye(3))
    end = np.tile([2.7, 0.0, 0.1], (2, 1))
    joint = Spring("joint", "joints", ("shaft", "engine"), end, np.full(3, 1e7))
    vehicle = four_cylinder(others=(shaft,), held=(joint,))
    assert holding(vehicle, vehicle.bodies[0]).tolist() == [True, True, True, False]
    assert holding(vehicle, shaft).tolist() == [False, False, False, True]
    assert figures(vehicle).axes.held.center == pytest.approx(figures(four_cylinder()).axes.held.center)


def test_an_engine_s_crank_lies_along_the_smaller_of_both_moments():
    across, along = np.diag([4.0, 2.0, 5.0]), np.diag([2.0, 4.0, 5.0])
    for inertia, expected in ((across, [0, 1, 0]), (along, [1, 0, 0]), (np.eye(3), [1, 0, 0])):
        body = RigidBody("engine", "powertrain", "engine", 100.0, np.zeros(3), inertia)
        part = rigid_parts(assemble(Vehicle("engine", (body,), ())))[0]
        assert crank_direction(part).tolist() == expected


@pytest.mark.parametrize("vehicle", [four_cylinder(), on_subframe()], ids=["ground", "subframe"])
def test_rates_of_zero_leave_a_body_without_elastic_axes(vehicle):
    """Which come back with the rates."""
    slack = {g.name: replace(g.rates, lateral=0.0) for g in vehicle.mount_groups}
    axes = body_axes(solve_modal(prepare_modes(vehicle), slack), 0)
    assert axes.held is None
    assert axes.mounted is None
    born_slack = prepare_modes(vehicle.with_rates(slack))
    own = {g.name: g.rates for g in vehicle.mount_groups}
    back = body_axes(solve_modal(born_slack, own), 0)
    expected = figures(vehicle).axes
    assert back.held.center == pytest.approx(expected.held.center)
    assert back.mounted.center == pytest.approx(expected.mounted.center, rel=1e-6)
