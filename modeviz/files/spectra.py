"""Tables of spectra, one line for each frequency: roads, random forces and base motions."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import LARGEST_TABLE, WESTERN, read_text, write_text
from modeviz.files.schema.conventions import Conventions
from modeviz.files.tables import Row, Table, read_table
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
    """(n_rows,), rising; of a road perhaps cycles/m."""
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
    table = open_table(path, note, COLUMNS)
    with located(path):
        factors = {FREQUENCY: 1.0, "psd": _unit("psd", table.units["psd"], quantity, conventions)}
        found = spectrum_table(table, path.name, factors, (), note)
        return Spectrum(found.frequency_hz, found.values[:, 0])


def write_spectrum(path: Path, spectrum: Spectrum) -> None:
    """Writes a spectrum, SI; every number reads back to the same bits."""
    write_spectrum_table(path, COLUMNS, (spectrum.frequency_hz, spectrum.power))


def open_table(
    path: Path,
    note: Callable[[str], None],
    columns: Sequence[str],
    optional: Sequence[str] = (),
    check: Callable[[dict[str, str]], object] | None = None,
) -> Table:
    """The table in a file; `note` is told if it may be cut; the rest is as of `read_table`."""
    text = read_text(path, LARGEST_TABLE, otherwise=WESTERN)
    with located(path):
        table = read_table(text, columns, optional, check)
        if not text.endswith(("\n", "\r")):
            note(f"{path.name}: the last line does not end; the file may be cut")
        return table


def spectrum_table(
    table: Table,
    where: str,
    factors: Mapping[str, float],
    signed: Sequence[str],
    note: Callable[[str], None],
) -> SpectrumTable:
    """The spectra in a table.

    Args:
        table: has at least the columns of `factors`.
        where: to begin notes with.
        factors: one of each column in SI; the first is that of the frequencies.
        signed: which of the others may be below zero.
        note: told what was left out.

    Raises:
        VehicleError: no spectra; the text names line and column.
    """
    frequency, *others = factors
    rows = _above_zero(table.rows, frequency, where, note)
    if len(rows) < 2:
        lines = "1 line" if rows else "0 lines"
        raise VehicleError(f"found {lines} above {_zero(frequency)}, expected two or more")
    found = [[row.number(c, -np.inf if c in signed else 0) for c in others] for row in rows]
    values = np.array(found).reshape(-1, len(others)) * [factors[c] for c in others]
    return SpectrumTable(rows, _rising(rows, frequency) * factors[frequency], values)


def write_spectrum_table(path: Path, columns: Sequence[str], values: Sequence[np.ndarray]) -> None:
    """Writes a table that `spectrum_table` reads; every number reads back to the same bits."""
    rows = np.column_stack(values).tolist()
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")


def _above_zero(
    rows: tuple[Row, ...], frequency: str, where: str, note: Callable[[str], None]
) -> tuple[Row, ...]:
    """The rows without a first one at zero, which spectra from transforms have."""
    if not rows or rows[0].number(frequency, at_least=0) > 0:
        return rows
    zero = _zero(frequency)
    note(f"{where}: line {rows[0].line}: {zero} is left out, since spectra are known above zero only")
    return rows[1:]


def _zero(frequency: str) -> str:
    """The lowest of some frequencies, in words."""
    return "0 Hz" if frequency == FREQUENCY else f"{frequency} = 0"


def _unit(column: str, unit: str, quantity: QuantityName, conventions: Conventions) -> float:
    """One unit of a column in SI."""
    if not unit:
        return conventions.unit(quantity) ** 2
    with located(f"column {column}"):
        return psd_factor(unit, quantity)


def _rising(rows: tuple[Row, ...], column: str) -> Floats:
    """The frequencies; raises VehicleError unless they rise, from above zero."""
    frequency = np.array([row.number(column, at_least=0) for row in rows])
    wrong = np.flatnonzero(np.diff(frequency, prepend=0.0) <= 0)
    if wrong.size:
        row, before = rows[wrong[0]], np.concatenate([[0.0], frequency])[wrong[0]]
        raise VehicleError(
            f"{row.where(column)}: found {row.cells[column]} after {before:g}, expected rising values"
        )
    return frequency
