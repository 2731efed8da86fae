"""What the rates of a mount are called, and the units in which they are told."""

from collections.abc import Iterable, Mapping, Sequence

from modeviz.units import WRITTEN_UNITS, QuantityName
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import (
    DAMPING_FIELDS,
    RATE_FIELDS,
    RATE_NAMES,
    RATE_QUANTITIES,
    ROTATIONAL_FIELDS,
    MountRates,
)

QUANTITIES: tuple[QuantityName, ...] = ("stiffness", "rotational_stiffness", "damping")
"""Those of rates, in the order of `RATE_FIELDS`."""

HEADINGS: dict[QuantityName, str] = {
    "stiffness": "",
    "rotational_stiffness": "Rotation",
    "damping": "Damping",
}
"""Of a list of rates of one quantity."""


def quantity(field: str) -> QuantityName:
    """Return the quantity of a field of `MountRates` that is a rate."""
    return RATE_QUANTITIES[field]


def is_damping(field: str) -> bool:
    """Return whether a rate is that of a damper."""
    return field in DAMPING_FIELDS


def spoken(field: str) -> str:
    """Return what a person calls a rate: "fore-aft", "rx", "damping-vertical"."""
    return RATE_NAMES[field]


def direction(field: str) -> str:
    """Return along or about what a rate is: "fore-aft", "about x"."""
    if field in ROTATIONAL_FIELDS:
        return f"about {field[1:]}"
    return spoken(field).removeprefix("damping-")


def sections(fields: Sequence[str]) -> list[tuple[str, tuple[str, ...]]]:
    """Return rates by what they are, with a heading: none of rates along axes."""
    by_quantity = ((HEADINGS[of], tuple(f for f in fields if quantity(f) == of)) for of in QUANTITIES)
    return [(heading, its) for heading, its in by_quantity if its]


def with_unit(field: str, units: Mapping[QuantityName, str] = WRITTEN_UNITS) -> str:
    """Return what a rate is called, with its unit unless it is along an axis: "rx, N m/rad"."""
    of = quantity(field)
    return spoken(field) if of == "stiffness" else f"{spoken(field)}, {units[of]}"


def plain(value: float) -> str:
    """Return a rate as one would write it, four digits or all before the point."""
    return f"{value:.0f}" if value >= 1000 else f"{value:.4g}"


def fields_of_groups(groups: Iterable[MountGroup]) -> tuple[str, ...]:
    """Return those of `RATE_FIELDS` that are tuned in one of some groups."""
    tuned = {field for group in groups for field in group.fields}
    return tuple(field for field in RATE_FIELDS if field in tuned)


def listed_fields(group: MountGroup, *rates: MountRates) -> tuple[str, ...]:
    """Return the rates of a group that are told: what is tuned, what differs, and what is along axes.

    Args:
        group: whose rates.
        rates: its own, and those told beside them.
    """

    def is_listed(field: str) -> bool:
        values = {getattr(each, field) for each in (group.rates, *rates)}
        is_there = quantity(field) == "stiffness" and any(values)
        return field in group.fields or is_there or len(values) > 1

    return tuple(filter(is_listed, RATE_FIELDS))
