"""Masses, springs, blocks and beams that several tests build from."""

import numpy as np
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Damper, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle


def mass_on_a_string(name, mass):
    """A body that for these tests only moves along z; its other motions are free."""
    return RigidBody(name, "linkage", name, mass, np.zeros(3), np.eye(3))


def spring(bodies, k, loss_factor=0.0):
    return Spring(
        f"{bodies}", "springs", bodies, np.zeros((2, 3)), np.array([0, 0, k]), loss_factor=loss_factor
    )


def damper(bodies, c):
    return Damper(f"damper {bodies}", "dampers", bodies, np.zeros((2, 3)), damping=np.array([0, 0, c]))


def oscillator(mass=2.0, k=800.0, c=0.0, loss_factor=0.0):
    return assemble(
        Vehicle(
            "oscillator",
            (mass_on_a_string("m", mass),),
            (spring(("m", "ground"), k, loss_factor), damper(("m", "ground"), c)),
        )
    )


def block(name, mass=10.0, at=(0.0, 0.0, 0.0)):
    return RigidBody(name, "linkage", name, mass, np.array(at), np.diag([1.0, 2.0, 3.0]))


def joined_beams(n_modes=None, loads=((), ())):
    """Two beams end to end, joined by a spring in every direction and tied to the ground."""
    beams = {"front": Beam(8, 2.0), "rear": Beam(6, 1.5, start=(2.0, 0, 0))}
    bodies = tuple(
        beam.body(name, n_modes=n_modes, loads=load)
        for (name, beam), load in zip(beams.items(), loads, strict=True)
    )
    joint = Spring(
        "joint", "joint", ("front", "rear"), np.array([[2.0, 0, 0], [2.0, 0, 0]]),
        stiffness=np.array([3e6, 2e6, 1e6]), rotational_stiffness=np.array([4e3, 5e3, 6e3]),
    )  # fmt: skip
    feet = [
        Spring(
            f"foot {body}", "feet", (body, "ground"), np.array([[x, 0, 0], [x, 0, 0]]),
            stiffness=np.array([2e4, 3e4, 4e4]), rotational_stiffness=np.full(3, 1e3),
        )
        for body, x in (("front", 0.5), ("rear", 3.25))
    ]  # fmt: skip
    return beams, Vehicle("two beams", bodies, (joint, *feet))


def two_masses(rate, damping=0.0):
    """One mass on a fixed spring and above it another on a mount, of which only z is read."""
    mount = Mount("m", "m", ("low", "high"), np.zeros((2, 3)))
    bounds = MountRates(1.0, 0.0, 0.0), MountRates(1e6, 1.0, 1.0)
    group = MountGroup("m", "m", MountRates(rate, 0.0, 0.0), 0.0, bounds, (mount,))
    bodies = mass_on_a_string("low", 2.0), mass_on_a_string("high", 3.0)
    joints = spring(("low", GROUND), 800.0), damper(("low", GROUND), damping)
    return assemble(Vehicle("two masses", bodies, joints, (group,)))


def resonant_rate(frequency_hz):
    """The mount's rate that puts a resonance there: low high + k (low + high) = 0."""
    square = (2 * np.pi * frequency_hz) ** 2
    low, high = 800.0 - 2.0 * square, -3.0 * square
    return -low * high / (low + high)
