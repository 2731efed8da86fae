"""How one page looks at what is shown, of which nothing is solved: its camera, and how shapes move."""

from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import Fault, FaultsError
from modeviz.vehicle.placement import ThreeFloats

FARTHEST = 1e6
"""m from the origin: no camera is beyond."""

LARGEST_AMPLITUDE, FASTEST_HZ, WHOLE_TURN = 3.0, 2.0, 360.0
"""The ends of the sliders: a factor, cycles a second on screen, degrees."""


@dataclass(frozen=True)
class CameraPose:
    """Where a camera is and what it looks at."""

    position: ThreeFloats
    look_at: ThreeFloats
    """m each."""

    def __post_init__(self) -> None:
        for key in ("position", "look_at"):
            if not (np.abs(getattr(self, key)) <= FARTHEST).all():
                found = f"found {getattr(self, key)} m, expected at most {FARTHEST:g} m"
                raise FaultsError(Fault(key, found))
        if self.position == self.look_at:
            words = f"found {self.look_at} m, which is where the camera is"
            raise FaultsError(Fault("look_at", words))


@dataclass(frozen=True)
class Animation:
    """How what moves is drawn."""

    amplitude: float = 1.0
    """How far, by what is usual."""
    speed_hz: float = 0.5
    """Cycles a second on screen."""
    phase: float = 90.0
    """Degrees, at which it stands, or stood last."""
    is_running: bool = True

    def __post_init__(self) -> None:
        ends = {"amplitude": LARGEST_AMPLITUDE, "speed_hz": FASTEST_HZ, "phase": WHOLE_TURN}
        for key, most in ends.items():
            value = getattr(self, key)
            if not 0 <= value <= most:
                raise FaultsError(Fault(key, f"found {value:g}, expected 0 to {most:g}"))


@dataclass(frozen=True)
class PageView:
    """How pages show a session."""

    animation: Animation = field(default_factory=Animation)
    camera: CameraPose | None = None
    """Where somebody left one; None: as pages open with."""
