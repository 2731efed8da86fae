"""Which body is looked at on its mounts, along which axes, and what of it is drawn."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from modeviz.analysis.rigid import usual_body
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.decoupling import Axes
from modeviz.vehicle.vehicle import Vehicle

Crank = Literal["own", "x", "y", "z"]
"""The direction of a torque: that of the body's crank, or one of the vehicle's axes."""

Support = Literal["held", "mounted"]
"""Whether the other ends of its mounts are still, or all is elastic down to the ground."""


@dataclass(frozen=True)
class RigidLook:
    """The choices of how a body on its mounts is looked at."""

    body: str = ""
    """Its name."""
    axes: Axes = "vehicle"
    crank: Crank = "own"
    support: Support = "held"
    """Of which axes are drawn."""
    drawn: bool = False
    """Whether axes and centres are lines in the scene."""

    @property
    def direction(self) -> Floats | None:
        """The direction that was chosen for the crank, (3,); None for the body's own."""
        if self.crank == "own":
            return None
        return np.eye(3)[get_args(Crank).index(self.crank) - 1]


def first_look(vehicle: Vehicle) -> RigidLook:
    """Return what a session opens with."""
    return RigidLook(usual_body(vehicle))
