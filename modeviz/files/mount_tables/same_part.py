"""That mounts of a group are the same part, told value by value."""

from collections.abc import Iterator

import numpy as np

from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.limits import OTHERS, RATIOS, STATIC_RATIO, TRAVEL
from modeviz.vehicle.local_axes import AXES

SAME = 1e-9
"""Relative: values of mounts of a group that differ by less are the same."""


def difference(bushing: Bushing, first: Bushing) -> tuple[str, float, float] | None:
    """Return what differs between a mount and the first of its group, by the name of its column.

    With its value in both, SI; None if they are the same part.
    """
    for (name, found), (_, expected) in zip(_values(bushing), _values(first), strict=True):
        if not np.isclose(found, expected, rtol=SAME, atol=0, equal_nan=True):
            return name, found, expected
    return None


def _values(bushing: Bushing) -> Iterator[tuple[str, float]]:
    """What all mounts of a group have alike, by the names of columns."""
    limits = bushing.limits
    of_axes = {
        "k": bushing.stiffness,
        "softest": bushing.softest,
        "stiffest": bushing.stiffest,
        **dict(zip(TRAVEL, limits.travel, strict=True)),
    }
    for what, values in of_axes.items():
        yield from ((f"{what}_{axis}", float(v)) for axis, v in zip(AXES, values, strict=False))
    for what, bounds, rate in zip(OTHERS, limits.others.T.tolist(), bushing.others, strict=True):
        yield from zip((f"softest_{what}", f"stiffest_{what}"), bounds, strict=True)
        if not np.isnan(bounds).all():
            yield what if what.startswith("c_") else f"k_{what}", float(rate)
    yield "loss_factor", bushing.loss_factor
    yield STATIC_RATIO, limits.static_ratio
    yield from zip(RATIOS, limits.ratios, strict=True)
