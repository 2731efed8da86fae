"""A group of mounts to be marked."""

import numpy as np

from modeviz.vehicle.connections import Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates

BOUNDS = (MountRates(1.0, 1.0, 1.0), MountRates(1e6, 1e6, 1e6))


def group(*names):
    mounts = tuple(Mount(name, "", ("cab", "frame"), np.zeros((2, 3))) for name in names)
    return MountGroup("C1", "cab front", MountRates(1e5, 1e5, 1e5), 0.1, BOUNDS, mounts)
