"""Damping of bodies and of turning joints enters the matrices of equation 10 and all made of them."""

from dataclasses import replace

import numpy as np
import pytest
from full_solutions import receptances
from mounted_cabin import mounted_cabin
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.bodies import FlexibleBody, RigidBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.vehicle import Vehicle

BEAM = Beam(6).body("beam", n_modes=14)
"""Eight elastic modes."""


def ratios(body: FlexibleBody) -> np.ndarray:
    """Of its modes, when it is free."""
    return solve_modes(assemble(Vehicle("v", (body,), ()))).damping_ratio


def test_a_body_of_lossy_material_damps_each_mode_with_half_its_loss_factor():
    # ζ = φᵀK_gφ / 2ω² = g/2 at resonance
    found = ratios(replace(BEAM, loss_factor=0.04))
    np.testing.assert_allclose(found[6:], 0.02, rtol=1e-9)
    assert not found[:6].any()


def test_modes_of_a_body_have_their_own_damping_and_the_last_holds_above():
    found = ratios(replace(BEAM, damping_ratio=(0.01, 0.02, 0.05)))
    np.testing.assert_allclose(found[6:], [0.01, 0.02, *[0.05] * 6], rtol=1e-9)


def test_residual_vectors_are_damped_as_the_highest_mode():
    body = Beam(6).body("beam", n_modes=9, loads=[(3, 2)])
    damped = replace(body, damping_ratio=(0.01, 0.02, 0.03))
    assert damped.damping_ratios[9:].tolist() == [0.03]
    assert damped.truncated(7, residual_vectors=True).damping_ratios.tolist() == [0] * 6 + [0.01, 0.02]


def held(body: FlexibleBody) -> Vehicle:
    """On a spring that turns and damps at each end."""
    springs = [
        Spring(
            f"s{i}", "springs", (body.name, GROUND), np.array([body.nodes[i]] * 2, float),
            stiffness=np.full(3, 2e4), rotational_stiffness=np.full(3, 500.0),
            rotational_damping=np.array([1.0, 2.0, 3.0]), loss_factor=0.1,
        )
        for i in (0, 6)
    ]  # fmt: skip
    return Vehicle("v", (body,), tuple(springs))


def test_receptances_of_lossy_bodies_and_turning_dampers_are_those_of_the_matrices():
    system = assemble(held(replace(BEAM, loss_factor=0.03, damping_ratio=(0.01, 0.04))))
    rows = np.vstack([system.motion("beam", BEAM.nodes[i]) for i in (0, 2, 5)])
    f = np.array([3.0, 11.0, 27.0, 39.0])
    forces = np.repeat(rows.T[None].astype(complex), len(f), axis=0)
    np.testing.assert_allclose(
        receptances(system, f, rows), direct_response(system, f, forces, rows), rtol=1e-7, atol=1e-16
    )


def test_a_turning_damper_damps_turning_as_c_omega_by_two_k():
    wheel = RigidBody("wheel", "other", "wheel", 10.0, np.zeros(3), np.diag([2.0, 3.0, 4.0]))
    joint = Spring(
        "joint", "springs", ("wheel", GROUND), np.zeros((2, 3)), stiffness=np.full(3, 1e5),
        rotational_stiffness=np.array([1e4, 0, 0]), rotational_damping=np.array([7.0, 0, 0]),
    )  # fmt: skip
    modes = solve_modes(assemble(Vehicle("v", (wheel,), (joint,))))
    omega = np.sqrt(1e4 / 2)
    turning = np.abs(2 * np.pi * modes.frequency_hz - omega).argmin()
    assert modes.damping_ratio[turning] == pytest.approx(7.0 * omega / (2 * 1e4), rel=1e-9)


def test_damping_comes_back_from_a_folder(tmp_path):
    body = replace(BEAM, loss_factor=0.03, damping_ratio=(0.01, 0.04), stated_mass=40.0)
    write_vehicle(held(body), tmp_path / "v")
    vehicle = read_vehicle(tmp_path / "v")
    found = vehicle.body("beam")
    assert (found.loss_factor, found.damping_ratio, found.stated_mass) == (0.03, (0.01, 0.04), 40.0)
    assert vehicle.connections[0].rotational_damping.tolist() == [1.0, 2.0, 3.0]


def test_mounts_have_turning_dampers_too(tmp_path):
    cabin = mounted_cabin()
    front, rear = cabin.mount_groups
    mounts = tuple(replace(m, rotational_damping=np.array([1.0, 0, 5.0])) for m in front.mounts)
    vehicle = replace(cabin, mount_groups=(replace(front, mounts=mounts), rear))
    write_vehicle(vehicle, tmp_path / "v")
    found = read_vehicle(tmp_path / "v")
    assert found.mounts[0].rotational_damping.tolist() == [1.0, 0, 5.0]
    assert (assemble(found).damping != assemble(cabin).damping).any()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"damping_ratio": (0.1, 1.0)}, r"damping_ratio: found \(0.1, 1.0\), expected a fraction"),
        ({"damping_ratio": ()}, r"damping_ratio: found \(\)"),
        ({"loss_factor": -0.1}, "loss_factor: found -0.1, expected zero or more"),
    ],
)
def test_damping_that_cannot_be_is_refused(changes, words):
    with pytest.raises(VehicleError, match=words):
        replace(BEAM, **changes)


def test_damping_of_rigid_modes_in_the_list_is_refused_with_their_number(tmp_path):
    write_vehicle(Vehicle("v", (replace(BEAM, damping_ratio=(0.02,) * 14),), ()), tmp_path / "v")
    with pytest.raises(VehicleError, match="found 14 for 8 elastic modes"):
        read_vehicle(tmp_path / "v")
