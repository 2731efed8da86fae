"""Rates of the mounts of a table that are not along the axes of their springs, where they are tuned."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.limits import OTHERS
from modeviz.files.records.record import tuples
from modeviz.vehicle.local_axes import AXES

OtherRate = tuple[float, float, float]
"""A rate, and the softest and the stiffest that it can be made."""


def tuned_others(bushing: Bushing, named: Mapping[str, str]) -> dict[str, OtherRate]:
    """Return what is tuned beside the springs along its axes, by what a vehicle file calls it.

    Args:
        bushing: in the axes of the vehicle's file.
        named: along which of these vertical, lateral and fore_aft are.
    """
    about = dict(zip(AXES, (named[way] for way in ("fore_aft", "lateral", "vertical")), strict=True))
    called = {f"r{ours}": f"r{its}" for ours, its in about.items()}
    called |= {f"damping_{way}": f"c_{axis}" for way, axis in named.items()}
    low, high = bushing.limits.others
    found = {}
    for field, column in called.items():
        i = OTHERS.index(column)
        if not np.isnan(low[i]):
            found[field] = (float(bushing.others[i]), float(low[i]), float(high[i]))
    return found


def untuned_others(bushing: Bushing) -> dict[str, Any]:
    """Return what the group of a bushing has beside what is tuned, by its key, where something is."""
    tuned = ~np.isnan(bushing.limits.others[0])
    rest = np.where(tuned, 0.0, bushing.others)
    kinds = {"rotational_stiffness": slice(0, 3), "damping": slice(3, 6)}
    return {key: tuples(rest[part]) for key, part in kinds.items() if tuned[part].any()}
