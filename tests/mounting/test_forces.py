"""Forces of connections against the whole dynamic stiffness with Lagrange's multipliers."""

import numpy as np
import pytest
from mounted_machine import mounted_machine

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.mounting.forces import solve_forces
from modeviz.mounting.free_bodies import body_motions, free_stiffness
from modeviz.ride.excitation import generalised_forces
from modeviz.vehicle.connections import MOTIONS

F = np.array([0.7, 3.0, 9.5, 14.0, 22.0, 37.0])
MACHINE = mounted_machine()
SYSTEM = with_mode_damping(assemble(MACHINE), 60.0)
LOADS = [*MACHINE.random_loads, *MACHINE.harmonic_loads]


def solved(load):
    return solve_forces(SYSTEM, load, F, MACHINE.speed)


def whole_answer(load):
    """x (n_freqs, n_dofs, n_inputs) and the force of each rigid motion, from all equations at once."""
    actions = generalised_forces(SYSTEM, load, F, MACHINE.speed)
    held = SYSTEM.held_motions
    n, n_held = SYSTEM.n_dofs, len(held)
    answer = []
    for f, action in zip(F, actions, strict=True):
        omega = 2 * np.pi * f
        Z = SYSTEM.stiffness + 1j * SYSTEM.structural_damping
        Z = Z + 1j * omega * SYSTEM.damping - omega**2 * SYSTEM.mass
        bordered = np.block([[Z, held.T], [held, np.zeros((n_held, n_held))]])
        answer.append(np.linalg.solve(bordered, action))
    answer = np.array(answer)
    return answer[:, :n], answer[:, n:]


def largest(values):
    return np.abs(values).max(axis=1, keepdims=True)


@pytest.mark.parametrize("load", LOADS, ids=lambda load: load.name)
def test_forces_on_each_body_are_its_mass_times_acceleration(load):
    """Of an elastic body in its modal coordinates: with what its own modes hold."""
    forces = solved(load)
    x, _ = whole_answer(load)
    for body, own in SYSTEM.dofs.items():
        inertia = free_stiffness(SYSTEM, body, F) @ x[:, own]
        parts = np.abs(SYSTEM.connection_motions[:, own].T) @ np.abs(forces.force)
        scale = largest(parts + np.abs(forces.loads[:, own]))
        assert (np.abs(forces.on_bodies[:, own] - inertia) <= 1e-9 * scale).all(), body


@pytest.mark.parametrize("load", LOADS, ids=lambda load: load.name)
def test_motions_of_bodies_cut_free_are_those_of_the_whole_vehicle(load):
    forces = solved(load)
    x, _ = whole_answer(load)
    found = body_motions(SYSTEM, F, forces.on_bodies)
    moving = [own for own in SYSTEM.dofs.values() if np.abs(x[:, own]).max() > 1e-12 * np.abs(x).max()]
    assert len(moving) >= 3
    for own in moving:
        assert (np.abs(found - x)[:, own] <= 1e-8 * largest(np.abs(x[:, own]))).all()


@pytest.mark.parametrize("load", LOADS, ids=lambda load: load.name)
def test_rigid_joints_hold_with_the_multipliers_of_the_whole_equations(load):
    forces = solved(load)
    _, multipliers = whole_answer(load)
    is_rigid = [m in c.rigid for c in forces.connections for m in MOTIONS]
    found = forces.force[:, is_rigid]
    assert (np.abs(found - multipliers) <= 1e-8 * largest(np.abs(multipliers))).all()


def test_a_force_is_the_dynamic_stiffness_times_the_stretch_less_the_motion_of_the_ground():
    load = MACHINE.harmonic_load("floor")
    forces, (x, _) = solved(load), whole_answer(load)
    i = [c.name for c in forces.connections].index("foot")
    mount = forces.connections[i]
    ground = -(mount.axes @ load.direction)[None] / (2 * np.pi * F[:, None]) ** 2
    stretch = (SYSTEM.connection_motions[6 * i : 6 * i + 3] @ x)[:, :, 0] - ground
    z = mount.stiffness * (1 + 0.2j) + 2j * np.pi * F[:, None] * mount.damping
    expected = z * stretch
    error = np.abs(forces.force[:, 6 * i : 6 * i + 3, 0] - expected)
    assert (error <= 1e-9 * np.abs(expected).max(axis=1, keepdims=True)).all()


def test_the_carrying_ground_gets_all_that_shakes_a_body_at_rest():
    """Slowly, a force on the engine goes through the feet, the tyre and the bolt to the ground."""
    load = MACHINE.harmonic_load("firing")
    forces = solve_forces(SYSTEM, load, np.array([0.01]), MACHINE.speed)
    total = sum(
        c.axes.T @ forces.force[0, 6 * i : 6 * i + 3, 0]
        for i, c in enumerate(forces.connections)
        if c.bodies[1] == "ground"
    )
    np.testing.assert_allclose(total, 10.0 * load.direction, atol=0.02)
