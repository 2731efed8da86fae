"""What the rigid modes of a body on its mounts are held against."""

from dataclasses import dataclass

import numpy as np

from modeviz.errors import Fault, FaultsError


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
