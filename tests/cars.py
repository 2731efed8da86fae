"""Rigid cars whose motions have names."""

import numpy as np

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
