"""The bodies that do not deform: powertrain, axle, wheels, links."""

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Mesh, RigidBody, Role
from pickup.connections import HALF_TRACK, WHEEL_RADIUS
from pickup.parameters import WHEELBASE, Parameters
from pickup.sides import SIDES, Place, on_side

PROPSHAFT_MASS = 14.0
PROPSHAFT_LENGTH = 1.5


def rigid_bodies(p: Parameters, meshes: dict[str, Mesh]) -> tuple[RigidBody, ...]:
    """The rigid bodies, each with its display mesh."""
    slender = PROPSHAFT_MASS * PROPSHAFT_LENGTH**2 / 12
    engine_inertia = np.diag([p.engine_ixx, p.engine_iyy, p.engine_izz])
    engine_inertia[0, 2] = engine_inertia[2, 0] = -p.engine_ixz

    def body(name: str, role: Role, mass: float, center: Place, inertia: Floats) -> RigidBody:
        return RigidBody(name, role, name, mass, np.array(center), inertia, meshes[name])

    central = [
        body(
            "engine", "powertrain", p.engine_mass, (p.engine_cg_x, 0.0, p.engine_cg_z), engine_inertia
        ),
        body(
            "rear axle",
            "unsprung",
            p.axle_mass,
            (WHEELBASE, 0.0, WHEEL_RADIUS),
            np.diag([p.axle_ixx, p.axle_iyy, p.axle_ixx]),
        ),
        body(
            "propshaft", "linkage", PROPSHAFT_MASS, (1.95, 0.0, 0.42), np.diag([0.06, slender, slender])
        ),
        body("steering linkage", "linkage", 8.0, (-0.16, 0.0, 0.42), np.diag([0.30, 0.05, 0.30])),
    ]
    corners = [
        made
        for side in SIDES
        for made in (
            body(
                f"knuckle {side}",
                "unsprung",
                p.knuckle_mass,
                on_side((0.0, HALF_TRACK, WHEEL_RADIUS), side),
                np.diag([1.5, 1.8, 1.5]),
            ),
            body(
                f"lower arm {side}",
                "linkage",
                7.0,
                on_side((0.0, 0.55, 0.34), side),
                np.diag([0.09, 0.10, 0.15]),
            ),
            body(
                f"upper arm {side}",
                "linkage",
                3.5,
                on_side((0.0, 0.58, 0.60), side),
                np.diag([0.03, 0.05, 0.06]),
            ),
        )
    ]
    return (*central, *corners)
