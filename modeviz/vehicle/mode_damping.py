"""Damping of a vehicle mode by mode, as tests of vehicles have it."""

from dataclasses import dataclass

from modeviz.errors import VehicleError


@dataclass(frozen=True)
class ModeDamping:
    """The damping ratio of a mode of the vehicle with its own rates.

    Viscous dampers that act in this mode alone make up what bodies, connections and mounts leave to it.
    They stay as they are when mount rates change.
    """

    damping_ratio: float
    """Fraction of critical."""
    mode: str | int | None = None
    """What the mode is called or its number, from one; None for all modes that no other names."""

    def __post_init__(self) -> None:
        if not 0 <= self.damping_ratio < 1:
            raise VehicleError(
                f"mode damping of {self.name!r}: damping_ratio: found {self.damping_ratio}, expected a "
                "fraction of critical from 0 to below 1"
            )

    @property
    def name(self) -> str:
        """Words for whose damping it is."""
        if self.mode is None:
            return "all other modes"
        return self.mode if isinstance(self.mode, str) else f"mode {self.mode}"
