"""Vehicles of a few rigid bodies, small enough to be solved by hand."""

import numpy as np

from modeviz.dynamics.assembly import System, assemble
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Spring, Tyre
from modeviz.vehicle.vehicle import Vehicle

WHEEL_HEIGHT = 0.35


def wheel(name: str, x: float = 0.0, y: float = 0.0, mass: float = 40.0) -> RigidBody:
    return RigidBody(name, "unsprung", name, mass, np.array([x, y, WHEEL_HEIGHT]), np.eye(3))


def tyre(body: RigidBody, **properties) -> Tyre:
    """Under the body's centre of gravity; stiff in z alone unless told otherwise."""
    x, y, _ = body.center_of_gravity
    values = {
        "stiffness": np.array([0.0, 0.0, 2e5]),
        "wheel_center": np.array([x, y, WHEEL_HEIGHT]),
    } | properties
    ground = np.array([[x, y, 0.0], [x, y, 0.0]])
    return Tyre(f"{body.name} tyre", "tyres", (body.name, GROUND), ground, **values)


def on_tyres(*bodies: RigidBody, **properties) -> System:
    """Each body on a tyre of its own."""
    return assemble(Vehicle("test", bodies, tuple(tyre(b, **properties) for b in bodies)))


def quarter_car() -> System:
    """A wheel on its tyre and above it a body on a spring: heave modes near 1.1 and 11.9 Hz."""
    low, high = wheel("wheel"), wheel("body", mass=350.0)
    spring = Spring(
        "spring",
        "springs",
        ("body", "wheel"),
        np.zeros((2, 3)) + high.center_of_gravity,
        stiffness=np.array([0.0, 0.0, 2e4]),
        loss_factor=0.1,
    )
    vertical = {"stiffness": np.array([0.0, 0.0, 2e5]), "loss_factor": 0.1}
    return assemble(Vehicle("quarter car", (low, high), (tyre(low, **vertical), spring)))
