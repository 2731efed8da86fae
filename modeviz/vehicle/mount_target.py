"""Mounts through which little is to get, and under which loads."""

from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.mount_rates import DIRECTIONS, check_directions


@dataclass(frozen=True)
class MountTarget:
    """Mounts whose forces or transmissibility are to be small; every load is a case of its own."""

    mounts: tuple[str, ...] = ()
    """Names; none is all."""
    directions: tuple[str, ...] = DIRECTIONS
    """Forces along the mounts' own axes, accelerations along the vehicle's."""
    loads: tuple[str, ...] = ()
    """Names of random or harmonic loads; none is what usually shakes the vehicle."""
    weight: float = 1.0

    def __post_init__(self) -> None:
        check_directions("target of mounts", self.directions)
        for kind in ("mounts", "loads"):
            names = getattr(self, kind)
            if len(set(names)) < len(names):
                raise VehicleError(
                    f"target of mounts: {kind}: found {', '.join(names)}, expected each of them once"
                )
        if not (np.isfinite(self.weight) and self.weight > 0):
            raise VehicleError(f"target of mounts: weight: found {self.weight}, expected more than 0")
