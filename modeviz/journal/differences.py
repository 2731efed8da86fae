"""What two sets of rates differ in, in engineers' words and units: "C2.lateral 131 → 140 N/mm"."""

import re
from collections.abc import Iterator

import numpy as np

from modeviz.journal.changes import Difference
from modeviz.journal.tuning import Pinned
from modeviz.units import factor
from modeviz.vehicle.mount_rates import (
    RATE_FIELDS,
    RATE_NAMES,
    RATE_QUANTITIES,
    MountRates,
    spoken_unit,
)
from modeviz.vehicle.placement import Placement

NUMBERS = re.compile(r"([-+\d.,e ]*\d) (\D.*)")
"""A number or several, and their unit."""

FEWEST_DIGITS, MOST_DIGITS = 4, 10
"""Of a number: as many as tell two apart."""


def pinned_differences(before: Pinned, after: Pinned) -> tuple[Difference, ...]:
    """Return in which rates and places two variants differ; a group that one lacks is told as such."""
    return tuple(_differences(before, after))


def told(difference: Difference) -> str:
    """Return a difference in a line: "C2.lateral 131 → 140 N/mm"."""
    before, after = difference.before, difference.after
    quantity = NUMBERS.fullmatch(before)
    if quantity and after.endswith(f" {quantity[2]}"):
        before = quantity[1]
    return f"{difference.what} {before or '–'} → {after or '–'}"


def _differences(before: Pinned, after: Pinned) -> Iterator[Difference]:
    for group in dict.fromkeys((*before.rates, *after.rates)):
        old, new = before.rates.get(group), after.rates.get(group)
        if old is None or new is None:
            yield Difference(f"mounts {group}", *("" if r is None else "there" for r in (old, new)))
        else:
            yield from _rate_differences(group, old, new)
    for group in dict.fromkeys((*before.placements, *after.placements)):
        places = (p.placements.get(group, Placement()) for p in (before, after))
        yield from _place_differences(group, *places)


def _rate_differences(group: str, old: MountRates, new: MountRates) -> Iterator[Difference]:
    for field in RATE_FIELDS:
        unit = spoken_unit(field)
        one = factor(unit, RATE_QUANTITIES[field])
        before, after = _apart(getattr(old, field) / one, getattr(new, field) / one)
        if before != after:
            yield Difference(f"{group}.{RATE_NAMES[field]}", f"{before} {unit}", f"{after} {unit}")
    if old.loss_factor != new.loss_factor:
        losses = (old.loss_factor, new.loss_factor)
        words = ("the group's" if loss is None else f"{loss:.6g}" for loss in losses)
        yield Difference(f"{group}.loss-factor", *words)


def _place_differences(group: str, old: Placement, new: Placement) -> Iterator[Difference]:
    if old.offset != new.offset:
        offsets = (_three(1e3 * np.array(place.offset), "mm") for place in (old, new))
        yield Difference(f"{group} moved", *offsets)
    if old.angles != new.angles:
        angles = (_three(np.degrees(place.angles), "deg") for place in (old, new))
        yield Difference(f"{group} turned", *angles)


def _apart(old: float, new: float) -> tuple[str, str]:
    """Two numbers as they are written, with as many digits as tell them apart."""
    for digits in range(FEWEST_DIGITS, MOST_DIGITS):
        if f"{old:.{digits}g}" != f"{new:.{digits}g}":
            return f"{old:.{digits}g}", f"{new:.{digits}g}"
    return f"{old:.{FEWEST_DIGITS}g}", f"{old:.{FEWEST_DIGITS}g}"


def _three(values: np.ndarray, unit: str) -> str:
    return f"{', '.join(f'{value:.4g}' for value in values)} {unit}"
