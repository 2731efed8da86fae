"""Tables of spectra, one line for each frequency: roads, random forces and base motions."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import LARGEST_TABLE, WESTERN, read_text, write_text
from modeviz.files.schema.conventions import Conventions
from modeviz.files.tables import Row, read_table
from modeviz.units import QuantityName, psd_factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import Spectrum

FREQUENCY = "frequency_hz"
"""The first column of each."""

COLUMNS = (FREQUENCY, "psd")
"""Of a load's table: the PSD in the square of the quantity's unit per Hz."""


@dataclass(frozen=True, eq=False)
class SpectrumTable:
    """The columns of such a table, without a line at 0 Hz."""

    rows: tuple[Row, ...]
    frequency_hz: Floats
    """(n_rows,), rising."""
    values: Floats
    """(n_rows, n_columns) of the other columns, SI."""


def read_spectrum(
    path: Path, quantity: QuantityName, conventions: Conventions, note: Callable[[str], None]
) -> Spectrum:
    """The spectrum in a file, SI.

    Args:
        path: of the file.
        quantity: of what.
        conventions: with the unit of that quantity, for a header that says none.
        note: told what was left out or is likely wrong.

    Raises:
        VehicleError: no such file, or no spectrum; the text names line and column.
    """
    table = read_spectrum_table(path, COLUMNS, ("psd",), quantity, conventions, note)
    with located(path):
        return Spectrum(table.frequency_hz, table.values[:, 0])


def write_spectrum(path: Path, spectrum: Spectrum) -> None:
    """Writes a spectrum, SI; every number reads back to the same bits."""
    write_spectrum_table(path, COLUMNS, (spectrum.frequency_hz, spectrum.power))


def read_spectrum_table(
    path: Path,
    columns: Sequence[str],
    powers: Sequence[str],
    quantity: QuantityName,
    conventions: Conventions,
    note: Callable[[str], None],
) -> SpectrumTable:
    """The spectra in a file.

    Args:
        path: of the file.
        columns: `FREQUENCY` and others.
        powers: which of those are never below zero.
        quantity: in the square of whose unit per Hz they are, unless their header says one.
        conventions: with that unit.
        note: told what was left out or is likely wrong.

    Raises:
        VehicleError: no such file or table; the text names line and column.
    """
    text = read_text(path, LARGEST_TABLE, otherwise=WESTERN)
    with located(path):
        table = read_table(text, columns)
        if not text.endswith(("\n", "\r")):
            note(f"{path.name}: the last line does not end; the file may be cut")
        rows = _above_zero(table.rows, path.name, note)
        if len(rows) < 2:
            lines = "1 line" if rows else "0 lines"
            raise VehicleError(f"found {lines} above 0 Hz, expected two or more")
        units = [_unit(c, table.units[c], quantity, conventions) for c in columns[1:]]
        found = [[row.number(c, 0 if c in powers else -np.inf) for c in columns[1:]] for row in rows]
        values = np.array(found).reshape(-1, len(units)) * units
        return SpectrumTable(rows, _rising(rows), values)


def write_spectrum_table(path: Path, columns: Sequence[str], values: Sequence[np.ndarray]) -> None:
    """Writes a table that `read_spectrum_table` reads; every number reads back to the same bits."""
    rows = np.column_stack(values).tolist()
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")


def _above_zero(rows: tuple[Row, ...], where: str, note: Callable[[str], None]) -> tuple[Row, ...]:
    """The rows without a first one at 0 Hz, which spectra from transforms have."""
    if not rows or rows[0].number(FREQUENCY, at_least=0) > 0:
        return rows
    note(f"{where}: line {rows[0].line}: 0 Hz is left out, since spectra are known above zero only")
    return rows[1:]


def _unit(column: str, unit: str, quantity: QuantityName, conventions: Conventions) -> float:
    """One unit of a column in SI."""
    if not unit:
        return conventions.unit(quantity) ** 2
    with located(f"column {column}"):
        return psd_factor(unit, quantity)


def _rising(rows: tuple[Row, ...]) -> Floats:
    """The frequencies; raises VehicleError unless each is above the one before."""
    frequency_hz = np.array([row.number(FREQUENCY, at_least=0) for row in rows])
    wrong = np.flatnonzero(np.diff(frequency_hz) <= 0)
    if wrong.size:
        row, before = rows[wrong[0] + 1], frequency_hz[wrong[0]]
        raise VehicleError(
            f"{row.where(FREQUENCY)}: found {row.cells[FREQUENCY]} after {before:g}, expected rising "
            "values"
        )
    return frequency_hz
