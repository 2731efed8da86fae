"""Force-deflection curves of mounts as tables, a line for each point."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import open_table
from modeviz.files.tables import Row
from modeviz.files.untold_units import note_untold_units
from modeviz.units import QuantityName, factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.progressive import ForceCurve, not_rising

COLUMNS: dict[str, QuantityName] = {"deflection": "length", "force": "force"}
"""Of such a table, and what they are of."""


def read_force_curve(
    path: Path, conventions: Conventions, note: Callable[[str], None]
) -> tuple[Floats, Floats]:
    """Return the deflections, m, and the forces, N, of the points in a file, (n_points,) each.

    Args:
        path: of the file, with the columns deflection and force, each with its unit in brackets.
        conventions: with the units for a header that says none.
        note: told if the file may be cut, and what units were not said.

    Raises:
        VehicleError: no such file, or no curve; the text names line and column.
    """
    table = open_table(path, note, tuple(COLUMNS))
    with located(path):
        columns = [
            _column(table.rows, name, table.units[name], quantity, conventions)
            for name, quantity in COLUMNS.items()
        ]
        note_untold_units(path.name, table.units, COLUMNS, conventions, note)
        ForceCurve(*columns)  # what else is wrong is said with the file
        return columns[0], columns[1]


def _column(
    rows: tuple[Row, ...], name: str, unit: str, quantity: QuantityName, conventions: Conventions
) -> Floats:
    """The values of a column in SI; raises VehicleError unless they rise."""
    with located(f"column {name}"):
        one = factor(unit, quantity) if unit else conventions.unit(quantity)
    values = np.array([row.number(name) for row in rows])
    if (fault := not_rising(values)) is not None:
        raise VehicleError(
            f"{rows[fault].where(name)}: found {rows[fault].cells[name]} after "
            f"{rows[fault - 1].cells[name]}, expected more: deflections and forces rise together"
        )
    return one * values
