"""A vehicle of two free networks, the lower hung on mounts in the upper one, and that on springs."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from two_networks import ATTACHED, place, two_networks

from modeviz.files import read_vehicle
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.loads import Force, ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

SOFT, STIFF = MountRates(1e3, 1e3, 1e3), MountRates(1e6, 1e6, 1e6)
RATES = MountRates(9e4, 6e4, 5e4)
"""N/m."""

GROUNDED = np.diag([4e4, 3e4, 8e4])
"""N/m along x, y, z: of each spring to the ground."""

FELT, PUSHED = 23, 14
"""The nodes at which it is felt, on the lower network, and pushed, on the upper one."""


def joined_networks(scratch: Path) -> Vehicle:
    """Mounts at all attachments without structural damping; pushed along y, felt along x, y and z."""
    parts = read_vehicle(two_networks(scratch / "networks", scratch))
    at = {node: np.tile(place(node) / 1000, (2, 1)) for node in ATTACHED}
    mounts = tuple(
        Mount(f"M {node}", "M", ("upper", "lower"), at[node], damping=np.full(3, 20.0))
        for node in ATTACHED
    )
    springs = tuple(
        Spring(f"S {node}", "S", ("upper", GROUND), at[node], stiffness=np.diag(GROUNDED))
        for node in ATTACHED
    )
    return replace(
        parts,
        name="networks",
        connections=springs,
        mount_groups=(MountGroup("M", "all", RATES, 0.0, (SOFT, STIFF), mounts),),
        response_points=(ResponsePoint("corner", "lower", at[FELT][0]),),
        forces=(Force("push", "upper", at[PUSHED][0], np.array([0.0, 1.0, 0.0]), 3.0),),
    )
