"""The rates of a group of mounts: what is tuned, and between which bounds."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.units import WRITTEN_UNITS, QuantityName, factor, si_unit

DIRECTIONS = ("vertical", "lateral", "fore-aft")
"""The directions of a mount's rates: local z, y and x."""

RIDE_DIRECTIONS = ("lateral", "vertical")
"""Those in which the paper judges the ride, in the order of its figures."""

STIFFNESS_FIELDS = ("vertical", "lateral", "fore_aft")
"""The fields of `MountRates` that are stiffness, in the order of `DIRECTIONS`."""

ROTATIONAL_FIELDS = ("rx", "ry", "rz")
"""Those that are rotational stiffness, about the local x, y and z."""

DAMPING_FIELDS = ("damping_vertical", "damping_lateral", "damping_fore_aft")
"""Those that are viscous damping, in the order of `DIRECTIONS`."""

OTHER_FIELDS = (*ROTATIONAL_FIELDS, *DAMPING_FIELDS)
"""Those that a mount may have otherwise than as rates that are tuned."""

RATE_FIELDS = (*STIFFNESS_FIELDS, *OTHER_FIELDS)
"""Every field of `MountRates` that is a rate."""

RATE_QUANTITIES: dict[str, QuantityName] = {
    **dict.fromkeys(STIFFNESS_FIELDS, "stiffness"),
    **dict.fromkeys(ROTATIONAL_FIELDS, "rotational_stiffness"),
    **dict.fromkeys(DAMPING_FIELDS, "damping"),
}
"""What each of `RATE_FIELDS` is."""

RATE_NAMES: dict[str, str] = {field: field.replace("_", "-") for field in RATE_FIELDS}
"""What a person writes for each of `RATE_FIELDS`: "fore-aft", "rx", "damping-vertical"."""

USUAL_RANGE = 4.0
"""How many times its rate a mount can be softer or stiffer, where nothing is said."""

UNKNOWN_RATE = 1e6
"""N/m: of a mount that has no rates."""


@dataclass(frozen=True)
class MountRates:
    """The rates with which a mount vibrates, and how much of its stiffness is damping."""

    vertical: float
    lateral: float
    fore_aft: float
    """N/m each."""
    loss_factor: float | None = None
    """g of k (1 + jg); None is that of the mount's group."""
    rx: float = 0.0
    ry: float = 0.0
    rz: float = 0.0
    """About the local axes, N m/rad each."""
    damping_vertical: float = 0.0
    damping_lateral: float = 0.0
    damping_fore_aft: float = 0.0
    """Viscous, N s/m each."""

    def __post_init__(self) -> None:
        for field, rate in self.of(RATE_FIELDS).items():
            if not (np.isfinite(rate) and rate >= 0):
                unit = si_unit(RATE_QUANTITIES[field])
                raise VehicleError(
                    f"{RATE_NAMES[field]} rate: found {rate} {unit}, expected zero or more"
                )
        loss = self.loss_factor
        if loss is not None and not (np.isfinite(loss) and loss >= 0):
            raise VehicleError(f"loss_factor: found {loss}, expected zero or more")

    def as_tuple(self) -> tuple[float, float, float]:
        """The rates along its axes, in the order of `DIRECTIONS`."""
        return self.vertical, self.lateral, self.fore_aft

    def local(self) -> tuple[float, float, float]:
        """The rates along its axes, in the order x, y, z."""
        return self.fore_aft, self.lateral, self.vertical

    def rotational(self) -> tuple[float, float, float]:
        """The rates about its axes, in the order x, y, z."""
        return self.rx, self.ry, self.rz

    def damping(self) -> tuple[float, float, float]:
        """Its damping, in the order x, y, z."""
        return self.damping_fore_aft, self.damping_lateral, self.damping_vertical

    def of(self, fields: Iterable[str]) -> dict[str, float]:
        """Some of its `RATE_FIELDS`."""
        return {field: getattr(self, field) for field in fields}

    def scaled(self, factors: Mapping[str, float]) -> "MountRates":
        """Return it with some of its `RATE_FIELDS` multiplied."""
        return replace(self, **{f: factor * getattr(self, f) for f, factor in factors.items()})


Bounds = tuple[MountRates, MountRates]
"""The softest and the stiffest; a rate of which they are the same is not tuned."""


def tuned_fields(bounds: Bounds) -> tuple[str, ...]:
    """Those of `RATE_FIELDS` that are tuned: whose bounds differ."""
    softest, stiffest = bounds
    return tuple(f for f in RATE_FIELDS if getattr(softest, f) < getattr(stiffest, f))


def check_bounds(where: str, bounds: Bounds) -> None:
    """Raises VehicleError for softest rates above the stiffest; the same ones are not tuned."""
    for field in RATE_FIELDS:
        if getattr(bounds[0], field) > getattr(bounds[1], field):
            low, high = (spoken_value(rates, field) for rates in bounds)
            raise VehicleError(
                f"{where}: bounds: {RATE_NAMES[field]}: found {low:g} to {high:g} "
                f"{spoken_unit(field)}, expected the lower one first"
            )


def spoken_unit(field: str) -> str:
    """The unit in which people, files and tables give one of `RATE_FIELDS`."""
    return WRITTEN_UNITS[RATE_QUANTITIES[field]]


def spoken_value(rates: MountRates, field: str) -> float:
    """One of `RATE_FIELDS` in that unit."""
    return getattr(rates, field) / factor(spoken_unit(field), RATE_QUANTITIES[field])


def spoken_rate(rates: MountRates, field: str) -> str:
    """One of `RATE_FIELDS` with it: "141 N/mm"."""
    return f"{spoken_value(rates, field):.4g} {spoken_unit(field)}"


def check_directions(
    where: str, directions: tuple[str, ...], known: tuple[str, ...] = DIRECTIONS
) -> None:
    """Raises VehicleError unless these are some of those that are known, each once."""
    for direction in directions:
        if direction not in known:
            raise VehicleError(f"{where}: " + unknown("direction", direction, known))
    if not directions or len(set(directions)) < len(directions):
        raise VehicleError(
            f"{where}: directions: found {list(directions)}, expected some of "
            f"{', '.join(known)}, each once"
        )


def usual_bounds(rates: MountRates) -> Bounds:
    """The softest and the stiffest of a mount of which only the rates are known.

    A quarter of each rate and four times it; one of zero along its axes may rise to four times the
    largest of these, any other stays. Without any rate along its axes, these stay too where it has
    others.
    """
    k = rates.as_tuple()
    has_others = any(rates.of(OTHER_FIELDS).values())
    highest = max(k) or (0.0 if has_others else UNKNOWN_RATE)
    stiffest = rates.scaled(dict.fromkeys(RATE_FIELDS, USUAL_RANGE))
    risen = {f: USUAL_RANGE * highest for f in STIFFNESS_FIELDS if not getattr(rates, f)}
    return rates.scaled(dict.fromkeys(RATE_FIELDS, 1 / USUAL_RANGE)), replace(stiffest, **risen)


Rates = Mapping[str, MountRates]
"""The rates of mount groups, by the group's name."""
