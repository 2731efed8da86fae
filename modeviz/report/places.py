"""Where mounts are that are not where they were given, as plain values for JSON and as text."""

import numpy as np

from modeviz.optimise.design_space import DesignSpace
from modeviz.optimise.place_variables import UNITS
from modeviz.report.records import Record
from modeviz.vehicle.placement import Placements


def placements_record(placements: Placements) -> Record:
    """`{group: {"offset_mm": [x, y, z], "angles_deg": [about x, y, z]}}`, along the vehicle's axes."""
    return {
        group: {
            "offset_mm": [1e3 * offset for offset in placed.offset],
            "angles_deg": np.degrees(placed.angles).tolist(),
        }
        for group, placed in placements.items()
    }


def place_rows(space: DesignSpace, *placements: Placements) -> list[list[str]]:
    """A row for each place that a search may choose: its name and unit, then where mounts are."""
    return [
        [f"{v.spoken}, {UNITS[v.kind][0]}", *(f"{v.of(p) / UNITS[v.kind][1]:.4g}" for p in placements)]
        for v in space.places.variables
    ]
