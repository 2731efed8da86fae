"""Energy in six directions against theory and brute force."""

import numpy as np
import pytest
from dynamic_mounts import MAXWELL, frozen_at, on_mounts
from four_cylinder import engine, four_cylinder, on_subframe
from oracles import Beam

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import body_purity, rigid_figures
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.energy import kinetic_energy
from modeviz.dynamics.modes import solve_modes
from modeviz.mounting.frames import frame, principal_axes
from modeviz.mounting.purity import direction_energy, sorted_modes
from modeviz.mounting.rigid_part import rigid_parts
from modeviz.vehicle.bodies import AddedMass, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.decoupling import Decoupling
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle


@pytest.mark.parametrize("axes", ["vehicle", "principal", "crank"])
def test_energies_add_up_to_the_body_s_share_along_any_axes(axes):
    load = AddedMass("tank", "subframe", np.array([2.9, 0.3, 0.2]), 12.0)
    system = assemble(on_subframe((load,)))
    shapes = solve_modes(system).shapes
    shares = kinetic_energy(system, shapes)
    for part in rigid_parts(system):
        crank = np.array([0.3, 0.9, -0.2]) / np.linalg.norm([0.3, 0.9, -0.2])
        energy = direction_energy(part, shapes, frame(part, axes, crank))
        assert energy.sum(axis=1) == pytest.approx(shares[part.body.name], abs=1e-12)


def test_products_of_inertia_make_energies_below_zero():
    system = assemble(on_subframe())
    energies = [
        direction_energy(part, solve_modes(system).shapes, np.eye(3)) for part in rigid_parts(system)
    ]
    assert min(e.min() for e in energies) < -1e-4
    turned = [
        direction_energy(part, solve_modes(system).shapes, frame(part, "principal", np.eye(3)[0]))
        for part in rigid_parts(system)
    ]
    assert min(e.min() for e in turned) > -1e-12  # in principal axes each is m v² or I ω²


def test_energy_is_velocity_times_momentum_of_the_body_by_hand():
    system = assemble(four_cylinder())
    modes = solve_modes(system)
    M = np.zeros((6, 6))
    M[:3, :3], M[3:, 3:] = 117.2 * np.eye(3), engine().inertia
    expected = (modes.shapes * (M @ modes.shapes)).T
    found = direction_energy(rigid_parts(system)[0], modes.shapes, np.eye(3))
    assert found == pytest.approx(expected, abs=1e-12)


def test_of_a_flexible_body_the_rigid_part_is_that_of_its_rigid_modes():
    beam = Beam(8)
    feet = tuple(
        Spring(f"foot {i}", "feet", ("beam", GROUND), np.tile(beam.nodes[i], (2, 1)), np.full(3, 2e5))
        for i in (0, 3, 8)
    )
    system = assemble(Vehicle("beam", (beam.body("beam"),), feet))
    shapes = solve_modes(system, 14).shapes
    energy = direction_energy(rigid_parts(system)[0], shapes, np.eye(3))
    assert energy.sum(axis=1) == pytest.approx(np.sum(shapes[:6] ** 2, axis=0), abs=1e-9)
    assert energy.sum(axis=1).max() > 0.5 > energy.sum(axis=1).min()


def test_the_least_change_of_momentum_is_left_to_bending():
    """The rigid motion found is the closest by mass: what is left is orthogonal to all of them."""
    beam = Beam(6)
    load = AddedMass("load", "beam", beam.nodes[5] + [0, 0.05, 0.02], 7.0)
    foot = Spring("foot", "feet", ("beam", GROUND), np.tile(beam.nodes[2], (2, 1)), np.full(3, 1e5))
    system = assemble(Vehicle("beam", (beam.body("beam"),), (foot,), added_masses=(load,)))
    (part,) = rigid_parts(system)
    shapes = solve_modes(system, 12).shapes
    left = shapes - part.coordinates @ part.rows @ shapes
    assert part.coordinates.T @ system.mass @ left == pytest.approx(0.0, abs=1e-9)


def test_symmetric_mounts_around_the_centre_of_gravity_decouple_all_six():
    body = RigidBody("block", "powertrain", "block", 100.0, np.zeros(3), np.diag([4.0, 6.0, 8.0]))
    places = [(x, y, 0.0) for x in (-0.4, 0.4) for y in (-0.25, 0.25)]
    mounts = tuple(
        Mount(f"m{i}", "m", ("block", GROUND), np.array([p, p])) for i, p in enumerate(places)
    )
    rates = MountRates(3e5, 1e5, 2e5)
    group = MountGroup("m", "m", rates, 0.1, usual_bounds(rates), mounts)
    vehicle = Vehicle("block", (body,), (), (group,))
    found = rigid_figures(solve_modal(prepare_modes(vehicle, 100.0), {}))[0]
    assert found.purity.least == pytest.approx(1.0, abs=1e-9)
    assert found.axes.held.center == pytest.approx(np.zeros(3), abs=1e-12)
    f = np.sqrt(4 * 3e5 / 100.0) / (2 * np.pi)
    assert found.purity.frequency("z") == pytest.approx(f)


def test_a_direction_has_no_mode_where_the_body_only_goes_along():
    """Of two modes one strains the mounts; the other, with more of the body in it, does not."""
    energy = np.zeros((2, 6))
    energy[:, 2] = 0.4, 0.5
    assert sorted_modes(energy, np.array([0.9, 0.01]))[2] == 0
    assert sorted_modes(energy, np.array([0.0, 0.0]))[2] is None


def test_two_directions_never_have_the_same_mode():
    rng = np.random.default_rng(3)
    modes = sorted_modes(rng.dirichlet(np.ones(6), 6), np.ones(6))
    assert sorted(modes) == list(range(6))


def test_gaps_and_bands_are_held_against_what_the_vehicle_says():
    results = solve_modal(prepare_modes(four_cylinder()), {})
    found = body_purity(results, 0, "vehicle", Decoupling(gap=1.6, bounce_gap=20.0))
    close = [gap.motions for gap in found.gaps if not gap.passes]
    assert close == [("y", "x")]  # 1.50 Hz
    assert [gap.motions for gap in found.bounce_gaps] == [("z", "ry")]  # the crank lies along y
    assert not found.bounce_gaps[0].passes
    low = body_purity(results, 0, "vehicle", Decoupling(lowest_frequency=11.0, highest_frequency=32.0))
    assert [m for m in ("x", "y", "z", "rx", "ry", "rz") if not low.is_in_band(m)] == ["y"]


def test_principal_axes_are_laid_near_the_vehicle_s():
    turn = np.linalg.qr(np.eye(3) + 0.2 * np.random.default_rng(1).normal(size=(3, 3)))[0]
    turn *= np.sign(np.diag(turn))
    tensor = turn @ np.diag([3.0, 1.0, 2.0]) @ turn.T
    values, axes = principal_axes(tensor)
    assert values == pytest.approx([3.0, 1.0, 2.0])
    assert axes == pytest.approx(turn.T)
    assert np.linalg.det(axes) == pytest.approx(1.0)


def test_equal_principal_values_leave_the_vehicle_s_axes():
    for values in ([2.0, 2.0, 5.0], [5.0, 2.0, 2.0], [1.0, 1.0, 1.0], [2.0, 5.0, 2.0]):
        assert principal_axes(np.diag(values))[1] == pytest.approx(np.eye(3))


def test_crank_axes_are_the_vehicle_s_but_for_the_crank_s_tilt():
    part = rigid_parts(assemble(four_cylinder()))[0]
    tilted = np.array([0.1, -0.99, 0.05]) / np.linalg.norm([0.1, -0.99, 0.05])
    axes = frame(part, "crank", tilted)
    assert axes @ axes.T == pytest.approx(np.eye(3))
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes[1] == pytest.approx(-tilted)


def test_rubber_that_depends_on_frequency_has_the_energies_of_each_mode():
    """Of a mode at its own frequency they are those of plain springs with the rates there."""
    vehicle = on_mounts(MAXWELL)
    results = solve_modal(prepare_modes(vehicle), {})
    found = body_purity(results, 0, "vehicle", Decoupling())
    assert found.energy.sum(axis=1) == pytest.approx(results.kinetic_energy["engine"])
    for mode in (0, 4):
        f = float(results.modes.frequency_hz[mode])
        frozen = assemble(frozen_at(vehicle, vehicle.rates["E"], f))
        modes = solve_modes(frozen)
        same = int(np.argmin(np.abs(modes.frequency_hz - f)))
        plain = direction_energy(rigid_parts(frozen)[0], modes.shapes[:, [same]], np.eye(3))
        assert found.energy[mode] == pytest.approx(plain[0], abs=1e-5)
