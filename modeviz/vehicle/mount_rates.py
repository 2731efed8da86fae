"""The rates of a group of mounts: what is tuned, and between which bounds."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.units import factor

DIRECTIONS = ("vertical", "lateral", "fore-aft")
"""The directions of a mount's rates: local z, y and x."""

RIDE_DIRECTIONS = ("lateral", "vertical")
"""Those in which the paper judges the ride, in the order of its figures."""

RATE_FIELDS = ("vertical", "lateral", "fore_aft")
"""The fields of `MountRates` that are rates, in the order of `DIRECTIONS`."""

USUAL_RANGE = 4.0
"""How many times its rate a mount can be softer or stiffer, where nothing is said."""

UNKNOWN_RATE = 1e6
"""N/m: of a mount that has no rates."""


@dataclass(frozen=True)
class MountRates:
    """The rates with which a mount vibrates, N/m, and how much of its stiffness is damping."""

    vertical: float
    lateral: float
    fore_aft: float
    loss_factor: float | None = None
    """g of k (1 + jg); None is that of the mount's group."""

    def __post_init__(self) -> None:
        for direction, rate in zip(DIRECTIONS, self.as_tuple(), strict=True):
            if not (np.isfinite(rate) and rate >= 0):
                raise VehicleError(f"{direction} rate: found {rate} N/m, expected zero or more")
        loss = self.loss_factor
        if loss is not None and not (np.isfinite(loss) and loss >= 0):
            raise VehicleError(f"loss_factor: found {loss}, expected zero or more")

    def as_tuple(self) -> tuple[float, float, float]:
        """The rates, in the order of `DIRECTIONS`."""
        return self.vertical, self.lateral, self.fore_aft

    def local(self) -> tuple[float, float, float]:
        """The rates, in the order x, y, z."""
        return self.fore_aft, self.lateral, self.vertical


Rates = Mapping[str, MountRates]
"""The rates of mount groups, by the group's name."""


def check_bounds(where: str, bounds: tuple[MountRates, MountRates], may_be_same: bool = False) -> None:
    """Raises VehicleError unless the softest rates are below the stiffest, or the same if they may."""
    softest, stiffest = (rates.as_tuple() for rates in bounds)
    per_mm = factor("N/mm", "stiffness")
    for direction, low, high in zip(DIRECTIONS, softest, stiffest, strict=True):
        if not (low < high or (may_be_same and low == high)):
            raise VehicleError(
                f"{where}: bounds: {direction}: found {low / per_mm:g} to {high / per_mm:g} N/mm, "
                "expected the lower one first"
            )


def check_directions(where: str, directions: tuple[str, ...]) -> None:
    """Raises VehicleError unless these are some of `DIRECTIONS`, each once."""
    for direction in directions:
        if direction not in DIRECTIONS:
            raise VehicleError(f"{where}: " + unknown("direction", direction, DIRECTIONS))
    if not directions or len(set(directions)) < len(directions):
        raise VehicleError(
            f"{where}: directions: found {list(directions)}, expected some of "
            f"{', '.join(DIRECTIONS)}, each once"
        )


def usual_bounds(rates: MountRates) -> tuple[MountRates, MountRates]:
    """The softest and the stiffest of a mount of which only the rates are known.

    A quarter of each rate and four times it; a rate of zero may rise to four times the largest.
    """
    k = rates.as_tuple()
    highest = max(k) or UNKNOWN_RATE
    softest, stiffest = (rate / USUAL_RANGE for rate in k), (USUAL_RANGE * (r or highest) for r in k)
    return MountRates(*softest), MountRates(*stiffest)
