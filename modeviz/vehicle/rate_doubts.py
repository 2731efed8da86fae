"""Doubts about rates of mount groups that their own bounds leave out."""

from collections.abc import Iterator

from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import (
    OTHER_FIELDS,
    RATE_FIELDS,
    RATE_NAMES,
    spoken_rate,
    spoken_unit,
    spoken_value,
)
from modeviz.vehicle.vehicle import Vehicle

SAME = 1e-9
"""Relative: a rate beyond a bound by less is on it."""


def rate_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on rates that are outside of their bounds, and on bounds of what is not there."""
    for group in vehicle.mount_groups:
        yield from _outside(group)
        yield from _zeros(group)


def _outside(group: MountGroup) -> Iterator[str]:
    softest, stiffest = group.bounds
    for field in RATE_FIELDS:
        low, high = getattr(softest, field), getattr(stiffest, field)
        if not low * (1 - SAME) <= getattr(group.rates, field) <= high * (1 + SAME):
            yield (
                f"{group.kind} group {group.name!r}: {RATE_NAMES[field]} is "
                f"{spoken_rate(group.rates, field)}, outside of its bounds, {_range(group, field)}"
            )


def _zeros(group: MountGroup) -> Iterator[str]:
    others = (field for field in group.fields if field in OTHER_FIELDS)
    for field in others:
        if not getattr(group.rates, field) and not getattr(group.bounds[0], field):
            yield (
                f"{group.kind} group {group.name!r}: {RATE_NAMES[field]} is zero and has bounds, "
                f"{_range(group, field)}: a search, which goes by factors, leaves it there; begin with "
                "some, or leave the bounds out"
            )


def _range(group: MountGroup, field: str) -> str:
    low, high = (spoken_value(rates, field) for rates in group.bounds)
    return f"{low:.4g} to {high:.4g} {spoken_unit(field)}"
