"""A block on mounts of every kind: turned axes, ends apart, the ground, own rotational rates."""

from dataclasses import replace

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

ANGLE = np.radians(35.0)
TURNED = np.array([[np.cos(ANGLE), 0, -np.sin(ANGLE)], [0, 1, 0], [np.sin(ANGLE), 0, np.cos(ANGLE)]])

MOUNTS = (
    Mount("front left", "", ("cab", "chassis"), np.array([[0.6, -0.5, 0.7], [0.6, -0.5, 0.66]]),
          axes=TURNED, elastic_center=0.25, rotational_stiffness=np.array([100.0, 0, 1 / 3])),
    Mount("front right", "", ("cab", "chassis"), np.array([[0.6, 0.5, 0.7], [0.6, 0.5, 0.66]])),
    Mount("stop", "", ("chassis", GROUND), np.tile([1.0 / 3, 0.2, 0.1], (2, 1)),
          damping=np.array([0, 0, 250.0])),
)  # fmt: skip


BOUNDS = MountRates(1e4, 2e4, 3e3), MountRates(7e6, 5e6, 6e6)


def many_mounts() -> Vehicle:
    """The cabin with these as a group of irrational rates."""
    rates = MountRates(np.pi * 1e5, np.e * 1e4, 1e5 / 7)
    group = MountGroup("Z", "all kinds", rates, 0.1 + 0.2, BOUNDS, MOUNTS)
    cabin = mounted_cabin()
    return replace(cabin, mount_groups=(*cabin.mount_groups, group))
