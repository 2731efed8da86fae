"""Bounds and ratio limits of a mount group that no rates meet, told with both that stand in the way."""

from collections.abc import Set
from dataclasses import dataclass

from modeviz.errors import VehicleError
from modeviz.units import factor
from modeviz.vehicle.mount_rates import DIRECTIONS, STIFFNESS_FIELDS, MountRates

SAME = 1e-12
"""Limits that leave one rate only may cross by such a part, which is rounding."""

SIDES = "at least", "at most"


@dataclass(frozen=True)
class _Demand:
    """What keeps the vertical rate above or below some other."""

    rate: float
    """N/m."""
    words: str


def check_ratios(
    group: str,
    ratios: tuple[float, float],
    bounds: tuple[MountRates, MountRates],
    base: MountRates,
    free: Set[str],
) -> None:
    """Checks that there are rates within their bounds whose ratios are within their limits.

    Args:
        group: its name.
        ratios: the least and the most that a rate may be of the vertical one.
        bounds: the softest and the stiffest rates.
        base: the rates that others keep.
        free: of `STIFFNESS_FIELDS`: what may change.

    Raises:
        VehicleError: there are none.
    """
    reach = _reach(bounds, base, free)
    if base.vertical == 0 or not reach:
        return
    vertical = reach.pop("vertical")
    least, most = [_own(vertical, 0)], [_own(vertical, 1)]
    for direction, ends in reach.items():
        least.append(_through(direction, ends, 0, ratios[1]))
        if ratios[0]:
            most.append(_through(direction, ends, 1, ratios[0]))
    stiffest, softest = max(least, key=lambda d: d.rate), min(most, key=lambda d: d.rate)
    if stiffest.rate > softest.rate * (1 + SAME):
        raise VehicleError(
            f"{group}: {stiffest.words}, but {softest.words}; widen the bounds or the ratio limits"
        )


def _reach(
    bounds: tuple[MountRates, MountRates], base: MountRates, free: Set[str]
) -> dict[str, tuple[float, float]]:
    """Return the ends of the vertical rate and of those whose ratio can change; zero has none."""
    ends = {}
    for field, direction in zip(STIFFNESS_FIELDS, DIRECTIONS, strict=True):
        softest, kept, stiffest = (getattr(rates, field) for rates in (bounds[0], base, bounds[1]))
        if kept and ("vertical" in (field, *free) or field in free):
            ends[direction] = (softest, stiffest) if field in free else (kept, kept)
    return ends


def _own(ends: tuple[float, float], end: int) -> _Demand:
    return _Demand(ends[end], f"vertical is {_size(ends, end)}")


def _through(direction: str, ends: tuple[float, float], end: int, ratio: float) -> _Demand:
    """Return what the end of another rate and its ratio ask of the vertical one."""
    vertical = ends[end] / ratio
    return _Demand(
        vertical,
        f"{direction} is {_size(ends, end)} and {SIDES[1 - end]} {ratio:g} of vertical, "
        f"which asks for vertical {SIDES[end]} {_per_mm(vertical)}",
    )


def _size(ends: tuple[float, float], end: int) -> str:
    side = "kept at" if ends[0] == ends[1] else SIDES[end]
    return f"{side} {_per_mm(ends[end])}"


def _per_mm(rate: float) -> str:
    return f"{rate / factor('N/mm', 'stiffness'):.4g} N/mm"
