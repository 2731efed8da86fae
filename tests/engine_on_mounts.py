"""A four-cylinder's engine on three mounts, of a public study (Jayashree1131/nvh-calculation)."""

from dataclasses import replace

import numpy as np

from modeviz.units import factor
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

INERTIA = np.array([[4.583, 0.610, -0.019], [0.610, 1.955, 0.066], [-0.019, 0.066, 5.507]])
ENGINE = RigidBody(
    "engine", "powertrain", "engine", 117.2, np.array([2.37109, -0.02866, 0.13161]), INERTIA
)
MOUNTS = {
    "M1": ((2.250, 0.2827, 0.200), (180.0, 73.0, 320.0)),
    "M2": ((2.120, -0.1725, 0.050), (240.0, 120.0, 480.0)),
    "M3": ((2.583, -0.200, 0.045), (73.0, 180.0, 320.0)),
}
"""Places, m, and static rates along x, y, z, N/mm."""


def engine_group(name: str, **properties) -> MountGroup:
    """One of its mounts, a group of its own, its dynamic rates 1.3 times the static ones."""
    place, static = MOUNTS[name]
    x, y, z = (1.3 * factor("N/mm", "stiffness") * rate for rate in static)
    rates = MountRates(z, y, x)
    mount = Mount(name, name, ("engine", GROUND), np.array([place, place]))
    return MountGroup(name, name, rates, 0.1, usual_bounds(rates), (mount,), **properties)


def engine_on_mounts(**properties) -> Vehicle:
    """The engine; `properties` are those of the vehicle."""
    groups = tuple(map(engine_group, MOUNTS))
    return Vehicle("engine on mounts", (ENGINE,), (), **{"mount_groups": groups, **properties})


def limited_engine() -> Vehicle:
    """The engine with a stop, with travel of two mounts, and with a load that nothing holds."""
    travel = {
        "M1": {"vertical": (-0.004, 0.002), "lateral": (-0.001, 0.001)},
        "M2": {},
        "M3": {"vertical": (-0.001, 0.001)},
    }
    stop = Spring("stop", "stops", ("engine", GROUND), np.tile(ENGINE.center_of_gravity, (2, 1)))
    loose = replace(ENGINE, name="loose", label="loose")
    push = LoadCase("push", np.zeros(3), (StaticLoad("loose", np.array([0.0, 0.0, 1.0])),))
    return replace(
        engine_on_mounts(),
        bodies=(ENGINE, loose),
        connections=(replace(stop, stiffness=np.array([100.0, 0.0, 0.0])),),
        mount_groups=tuple(engine_group(name, travel=limits) for name, limits in travel.items()),
        load_cases=(LoadCase("standing"), LoadCase("bump 3 g", np.array([0.0, 0.0, -3.0])), push),
    )
