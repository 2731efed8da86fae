"""Springs and dampers that a vehicle has, as the group that tunes them."""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import Any

import numpy as np

from modeviz.errors import VehicleError, listed, quoted
from modeviz.vehicle.connections import Connection, Damper, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import (
    DAMPING_FIELDS,
    OTHER_FIELDS,
    RATE_FIELDS,
    ROTATIONAL_FIELDS,
    STIFFNESS_FIELDS,
    USUAL_RANGE,
    Bounds,
    MountRates,
    check_bounds,
    tuned_fields,
)

AXES_OF = {
    "stiffness": tuple(reversed(STIFFNESS_FIELDS)),
    "rotational_stiffness": ROTATIONAL_FIELDS,
    "damping": tuple(reversed(DAMPING_FIELDS)),
}
"""The fields of `MountRates` that are a connection's rates along or about its x, y and z."""


def tuned_group(
    parts: Sequence[Connection], bounds: Bounds | None = None, label: str = ""
) -> MountGroup:
    """Return the group that tunes springs or dampers, in place of them among a vehicle's connections.

    They are of steel: under a load that stays as stiff as where they vibrate.

    Args:
        parts: `Spring`s or `Damper`s of one group, whose name it has; they are the same part where it
            is tuned.
        bounds: the softest and the stiffest; None: a quarter of every rate that they have, and four
            times it.
        label: what a person calls it; the name, if not given.

    Raises:
        VehicleError: there are none, they are not the same part, or one is rigid where it is tuned.
    """
    kinds = {(type(part), part.group) for part in parts}
    if len(kinds) != 1 or not isinstance(parts[0], Spring | Damper):
        found = listed(f"{kind.__name__} of {group!r}" for kind, group in kinds) if parts else "none"
        raise VehicleError(f"found {found}, expected springs or dampers of one group, to be tuned")
    first = parts[0]
    rates = rates_of(first)
    low, high = bounds or usual_bounds_of(rates)
    check_bounds(f"group {quoted(first.group)}", (low, high))
    tuned = tuned_fields((low, high))
    rest = dict.fromkeys(set(OTHER_FIELDS) - set(tuned), 0.0)
    of_group = {a: _shared(first, a, tuned) for a in ("rotational_stiffness", "damping")}
    for part in parts:
        _check_same(part, first, tuned)
    group = MountGroup(
        first.group,
        label or first.group,
        replace(rates, **rest),
        first.loss_factor,
        (replace(low, **rest), replace(high, **rest)),
        tuple(_mount(part, tuned) for part in parts),
        static_ratio=1.0,
        kind="spring" if isinstance(first, Spring) else "damper",
        **of_group,
    )
    group.with_rates(group.bounds[1])  # as stiff as it can be, nothing that is rigid has a rate
    return group


def rates_of(part: Connection) -> MountRates:
    """Return the rates of a connection along and about its axes, and its damping."""
    values = {a: getattr(part, a).tolist() for a in AXES_OF}
    return MountRates(
        **{
            field: rate
            for attribute, names in AXES_OF.items()
            for field, rate in zip(names, values[attribute], strict=True)
        }
    )


def usual_bounds_of(rates: MountRates) -> Bounds:
    """Return a quarter of every rate and four times it; what is not there is not tuned."""
    factors = (1 / USUAL_RANGE, USUAL_RANGE)
    softest, stiffest = (rates.scaled(dict.fromkeys(RATE_FIELDS, f)) for f in factors)
    return softest, stiffest


def _shared(part: Connection, attribute: str, tuned: Sequence[str]) -> Any:
    """What the group says of three rates of which one is tuned: those that are not; else nothing."""
    is_tuned = np.isin(AXES_OF[attribute], tuned)
    return np.where(is_tuned | ~is_tuned.any(), 0.0, getattr(part, attribute))


def _mount(part: Connection, tuned: Sequence[str]) -> Mount:
    """A spring or damper that has no rates of its own where its group tunes any."""
    values = {field.name: getattr(part, field.name) for field in fields(part)}
    given = [a for a, names in AXES_OF.items() if a == "stiffness" or set(names) & set(tuned)]
    return Mount(**{**values, **dict.fromkeys(given, np.zeros(3))})


def _check_same(part: Connection, first: Connection, tuned: Sequence[str]) -> None:
    """Raises VehicleError unless two of a group are the same part in what they have from it."""
    shared = [a for a, names in AXES_OF.items() if a == "stiffness" or set(names) & set(tuned)]
    for attribute in (*shared, "loss_factor"):
        found, expected = (np.asarray(getattr(p, attribute)).tolist() for p in (part, first))
        if found != expected:
            raise VehicleError(
                f"{attribute} of {quoted(part.name)} is {found} and that of {quoted(first.name)} "
                f"{expected}, in SI; those of a group, here {quoted(first.group)}, are tuned as the "
                "same part: give others another group"
            )
