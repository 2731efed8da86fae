"""What the rigid modes of a body on its mounts are held against."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from modeviz.errors import Fault, FaultsError, VehicleError, unknown
from modeviz.vehicle.connections import MOTIONS

Axes = Literal["vehicle", "principal", "crank"]
"""vehicle: x rearward, y right, z up. principal: those of the body's inertia. crank: the vehicle's,
turned by the least angle that lays the one nearest to the crank along it."""


@dataclass(frozen=True)
class Decoupling:
    """How pure the modes of a body should be, and how far apart their frequencies."""

    purity: float = 0.85
    """The least part that one direction should have in the body's energy in a mode."""
    lowest_frequency: float = 5.0
    """Hz: no mode of the body should be below."""
    highest_frequency: float = 30.0
    """Hz: and none above."""
    gap: float = 1.5
    """Hz: how far apart any two of its modes should be."""
    bounce_gap: float = 2.0
    """Hz: how far apart the modes should be in which it moves up and down, which the road excites, and
    in which it turns about its crank, which an engine excites."""

    def __post_init__(self) -> None:
        if not 0 < self.purity <= 1:
            raise FaultsError(Fault("purity", f"found {self.purity}, expected more than 0, at most 1"))
        for key in ("lowest_frequency", "gap", "bounce_gap"):
            value = getattr(self, key)
            if not (np.isfinite(value) and value >= 0):
                raise FaultsError(Fault(key, f"found {value} Hz, expected zero or more"))
        if not self.lowest_frequency < self.highest_frequency < np.inf:
            words = (
                f"found {self.highest_frequency} Hz, expected more than the lowest, "
                f"{self.lowest_frequency} Hz"
            )
            raise FaultsError(Fault("highest_frequency", words))


USUAL = Decoupling()
"""What holds where a vehicle says nothing."""


@dataclass(frozen=True)
class DecoupledBody:
    """A body whose modes are to be decoupled."""

    body: str
    motions: tuple[str, ...] = MOTIONS
    """Of `MOTIONS`: whose modes are to be pure."""
    axes: Axes = "vehicle"
    """Along which purity is told."""

    def __post_init__(self) -> None:
        where = f"decoupling of {self.body!r}"
        for motion in self.motions:
            if motion not in MOTIONS:
                raise VehicleError(f"{where}: motions: " + unknown("motion", motion, MOTIONS))
        if not self.motions or len(set(self.motions)) < len(self.motions):
            raise VehicleError(
                f"{where}: motions: found {list(self.motions)}, expected some of {', '.join(MOTIONS)}, "
                "each once"
            )
        if self.axes not in get_args(Axes):
            raise VehicleError(f"{where}: " + unknown("axes", self.axes, get_args(Axes)))
