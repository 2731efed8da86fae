"""Naming on vehicles that are not the pickup, where what each mode is can be told from theory."""

import numpy as np
import pytest
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.motions import center_of_gravity, energy_share, rigid_coordinates, rigid_share
from modeviz.dynamics.naming import name_modes
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import Spring, Tyre
from modeviz.vehicle.vehicle import Vehicle


def rigid(name, role, mass, at, inertia):
    return RigidBody(name, role, name, mass, np.array(at, float), np.diag(np.array(inertia, float)))


def link(name, bodies, at, k):
    return Spring(name, name, bodies, np.tile(np.array(at, float), (2, 1)), np.array(k, float))


def tyre(name, body, at):
    x, y, _ = at
    return Tyre(
        f"{name} tyre", "tyres", (body, "ground"), np.array([[x, y, 0], [x, y, 0.0]]),
        stiffness=np.array([1e5, 1e5, 2e5]), wheel_center=np.array(at, float),
    )  # fmt: skip


def car():
    """A rigid car body with an engine on it, four wheels on springs; x aft, y right, z up.

    Masses and springs uncouple: each wheel 40 kg on 200 + 20 N/mm hops at √(220e3/40)/2π = 11.8 Hz;
    the engine of 150 kg turns on four mounts placed about its centre, so its roll, pitch and yaw are
    √(Σ k r²/I)/2π, a different frequency each.
    """
    wheels, springs, tyres = [], [], []
    for name, x, y in (("fl", 0, -0.75), ("fr", 0, 0.75), ("rl", 2.6, -0.75), ("rr", 2.6, 0.75)):
        wheels.append(rigid(name, "unsprung", 40, (x, y, 0.3), (1, 1, 1)))
        springs.append(link(f"spring {name}", (name, "shell"), (x, y, 0.3), (4e6, 4e6, 2e4)))
        tyres.append(tyre(name, name, (x, y, 0.3)))
    shell = rigid("shell", "cabin", 1100, (1.3, 0, 0.55), (400, 1700, 1900))
    engine = rigid("motor", "powertrain", 150, (0, 0, 0.5), (7, 10, 9))
    mounts = [
        link(f"mount {x} {y}", ("motor", "shell"), (x, y, 0.5), (2e5, 3e5, 4e5))
        for x in (-0.25, 0.25)
        for y in (-0.2, 0.2)
    ]
    return Vehicle("car", (shell, engine, *wheels), (*springs, *tyres, *mounts))


def names_and_frequencies(vehicle, n_modes=None):
    system = assemble(vehicle)
    modes = solve_modes(system, n_modes)
    names = name_modes(system, modes)
    return {n.name: f for n, f in zip(names, modes.frequency_hz, strict=True)}


def test_a_car_is_named_by_the_same_rule():
    found = names_and_frequencies(car())
    for name, expected in (
        ("front hop", 11.8),
        ("rear hop", 11.8),
        ("front tramp", 11.8),
        ("rear tramp", 11.8),
        ("motor pitch", np.sqrt(4 * 4e5 * 0.25**2 / 10) / (2 * np.pi)),
        ("motor roll", np.sqrt(4 * 4e5 * 0.2**2 / 7) / (2 * np.pi)),
        ("motor yaw", np.sqrt(4 * (2e5 * 0.2**2 + 3e5 * 0.25**2) / 9) / (2 * np.pi)),
    ):
        assert found[name] == pytest.approx(expected, rel=0.04), name
    # On its springs: 4 x 20 N/mm in series with the tyres under 1250 kg.
    heave = np.sqrt(4 / (1 / 2e4 + 1 / 2e5) / 1250) / (2 * np.pi)
    assert found["front bounce"] == pytest.approx(heave, rel=0.15)
    assert found["rear bounce"] == pytest.approx(heave, rel=0.15)
    assert found["roll"] < 3.0


def test_the_lowest_bending_of_a_frame_is_its_first_beaming():
    beam = Beam(20, length=4.0)
    found = names_and_frequencies(Vehicle("frame", (beam.body("rail"),), ()), 16)
    bending = 4.7300407**2 / (2 * np.pi * 4.0**2) * np.sqrt(6e4 / 20.0)
    assert found["first beaming"] == pytest.approx(bending, rel=1e-3)


def test_every_mode_has_a_name_of_its_own():
    system = assemble(car())
    modes = solve_modes(system)
    names = [n.name for n in name_modes(system, modes)]
    assert len(set(names)) == len(names) == len(modes.frequency_hz)


def test_names_follow_the_motion_when_modes_change_places():
    def order(k):
        vehicle = car()
        connections = tuple(
            link(c.name, c.bodies, c.points[0], (2e5, 3e5, k)) if c.name.startswith("mount") else c
            for c in vehicle.connections
        )
        found = names_and_frequencies(Vehicle("car", vehicle.bodies, connections))
        return found["motor pitch"] > found["front hop"]

    assert order(4e5)
    assert not order(1e5)


def test_a_vehicle_of_two_masses_still_gets_names():
    pair = (
        rigid("a", "linkage", 1, (0, 0, 0), (1, 1, 1)),
        rigid("b", "linkage", 2, (1, 0, 0), (1, 1, 1)),
    )
    found = names_and_frequencies(
        Vehicle("pair", pair, (link("s", ("a", "b"), (0, 0, 0), (0, 0, 50)),))
    )
    assert all(name for name in found)


def test_shares_of_a_rigid_bodys_six_motions_sum_to_one():
    body = rigid("a", "cabin", 7, (1, 2, 3), (1, 2, 3))
    system = assemble(Vehicle("one", (body,), ()))
    shapes = np.random.default_rng(1).normal(size=(6, 4))
    shapes /= np.sqrt(np.einsum("ij,ij->j", shapes, system.mass @ shapes))
    assert rigid_share(system, [body], shapes).sum(axis=0) == pytest.approx(np.ones(4))


def test_flexible_and_rigid_bodies_move_as_one():
    beam = Beam(6)
    rail, block = beam.body("rail"), rigid("block", "cabin", 30, (0.5, 1.0, 0.4), (1, 1, 1))
    system = assemble(Vehicle("two", (rail, block), ()))
    center = center_of_gravity(system, (rail, block))
    # The beam weighs 40 kg about x = 1 m.
    np.testing.assert_allclose(center, [(40 * 1.0 + 30 * 0.5) / 70, 30 / 70, 12 / 70], atol=1e-6)
    X = rigid_coordinates(system, (rail, block), center)
    np.testing.assert_allclose(
        system.motion("rail", beam.nodes[6]) @ X[:, 5],
        [0 + center[1], 2.0 - center[0], 0, 0, 0, 1.0],
        atol=1e-6,
    )
    yaw = X[:, 5:] / np.sqrt(X[:, 5] @ system.mass @ X[:, 5])
    assert energy_share(system, X, yaw)[5, 0] == pytest.approx(1.0)
