"""A four-cylinder on three mounts to the ground: a public study's, solved by others."""

import numpy as np

from modeviz.vehicle.bodies import AddedMass, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

MASS = 117.2
CENTER = (2.37109, -0.02866, 0.13161)
INERTIA = np.array([[4.583, 0.610, -0.019], [0.610, 1.955, 0.066], [-0.019, 0.066, 5.507]])
STATIC = {
    "M1": ((2.250, 0.2827, 0.200), (180, 73, 320)),
    "M2": ((2.120, -0.1725, 0.050), (240, 120, 480)),
    "M3": ((2.583, -0.200, 0.045), (73, 180, 320)),
}
"""Place, m, and static rates x, y, z, N/mm."""
DYNAMIC = 1.3

FREQUENCIES = [10.0739, 11.5762, 14.6973, 16.3353, 19.7130, 31.4272]
ENERGY = [
    [0.1, 98.5, 0.1, 1.2, 0.0, 0.1],
    [95.5, 0.1, 1.0, 0.0, 0.7, 2.7],
    [4.3, 0.4, 37.0, 3.1, 6.4, 48.9],
    [0.1, 0.1, 49.5, 2.2, 1.3, 46.8],
    [0.0, 0.9, 3.5, 92.8, 2.8, 0.0],
    [0.1, 0.0, 8.9, 0.7, 88.9, 1.4],
]
TORQUE_ROLL = [-0.131977, 0.991176, -0.012334]
ELASTIC_TORQUE = [-0.162989, 0.967415, 0.193759]


def engine(**fields) -> RigidBody:
    return RigidBody("engine", "powertrain", "engine", MASS, np.array(CENTER), INERTIA, **fields)


def four_cylinder(body: RigidBody | None = None, carrier: str = GROUND, others=(), held=()) -> Vehicle:
    """It on three mounts, a group each, whose other ends are on a carrier."""
    groups = tuple(_group(name, carrier, *mount) for name, mount in STATIC.items())
    return Vehicle("four-cylinder", (body or engine(), *others), tuple(held), groups)


def _group(name, carrier, place, rates) -> MountGroup:
    x, y, z = (1e3 * DYNAMIC * k for k in rates)
    mount = Mount(name, name, ("engine", carrier), np.array([place, place]))
    own = MountRates(vertical=z, lateral=y, fore_aft=x)
    return MountGroup(name, name, own, 0.1, usual_bounds(own), (mount,))


SUBFRAME = RigidBody(
    "subframe",
    "frame",
    "subframe",
    40.0,
    np.array([2.3, 0.05, 0.0]),
    np.array([[4.0, 1.6, -0.3], [1.6, 3.0, 0.2], [-0.3, 0.2, 6.0]]),
)


def _bushings() -> list[Spring]:
    places = [(2.0, 0.4, -0.1), (2.0, -0.4, -0.1), (2.7, 0.35, -0.1), (2.7, -0.35, -0.05)]
    rates = np.array([9e5, 7e5, 12e5])
    return [
        Spring(f"bushing {i}", "bushings", ("subframe", GROUND), np.array([p, p]), rates)
        for i, p in enumerate(places)
    ]


def on_subframe(added: tuple[AddedMass, ...] = ()) -> Vehicle:
    """It on a rigid subframe, which is on bushings to the ground."""
    vehicle = four_cylinder(carrier="subframe", others=(SUBFRAME,), held=_bushings())
    return Vehicle("on a subframe", vehicle.bodies, vehicle.connections, vehicle.mount_groups, added)
