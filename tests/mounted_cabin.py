"""A cabin on four tunable mounts over a chassis on four tyres: the smallest vehicle to tune."""

from dataclasses import replace

import numpy as np

from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Tyre
from modeviz.vehicle.loads import ResponsePoint, Road, WheelLoad
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

SOFT, STIFF = MountRates(1e4, 1e4, 1e4), MountRates(1e7, 1e7, 1e7)
CORNERS = [(x, y) for x in (0.0, 2.5) for y in (-0.7, 0.7)]


def mounted_cabin() -> Vehicle:
    cabin = RigidBody(
        "cab", "cabin", "cab", 300.0, np.array([1.2, 0.1, 1.0]), np.diag([150, 250, 260.0])
    )
    chassis = RigidBody(
        "chassis", "unsprung", "chassis", 900.0, np.array([1.25, 0, 0.5]), np.diag([300, 900, 1000.0])
    )
    groups = tuple(
        MountGroup(
            name, label, MountRates(8e5, 3e5, 4e5), 0.15, (SOFT, STIFF),
            tuple(
                Mount(f"{name} {y}", name, ("cab", "chassis"), np.tile([x, y, 0.7], (2, 1)))
                for y in (-0.5, 0.5)
            ),
        )
        for name, label, x in (("A", "front", 0.6), ("B", "rear", 1.9))
    )  # fmt: skip
    tyres = tuple(
        Tyre(
            f"tyre {x} {y}", "tyres", ("chassis", GROUND), np.array([[x, y, 0], [x, y, 0.0]]),
            stiffness=np.array([1e5, 1e5, 2e5]), damping=np.full(3, 500.0),
            wheel_center=np.array([x, y, 0.3]),
        )
        for x, y in CORNERS
    )  # fmt: skip
    f = np.linspace(0.05, 60, 400)
    spectrum = np.zeros((400, 2, 2))
    spectrum[:, 0, 0], spectrum[:, 1, 1] = 1e-5 / f**2, 2e-5 / f**2
    return Vehicle(
        "cabin", (cabin, chassis), tyres, groups,
        response_points=(ResponsePoint("seat", "cab", np.array([1.2, -0.4, 0.9])),),
        roads=(
            Road("flat", "Flat road", 20.0, f, spectrum), Road("rough", "Rough", 20.0, f, 4 * spectrum)
        ),
        wheel_loads=(WheelLoad("front left radial force", "radial force", tyres[0].name, 50.0),),
        rate_sets={"soft": {"A": MountRates(2e5, 1e5, 1e5)}},
    )  # fmt: skip


def twisted_cabin() -> Vehicle:
    """The same, but its front mounts resist rotation too, as much as their distance does."""
    cabin = mounted_cabin()
    front, rear = cabin.mount_groups
    mounts = tuple(replace(m, rotational_stiffness=np.array([2e5, 0.0, 1e5])) for m in front.mounts)
    return replace(cabin, mount_groups=(replace(front, mounts=mounts), rear))
