"""Tables as editors and spreadsheets leave them: text with commas, semicolons or tabs between cells.

A byte order mark, any line ends, decimal commas beside semicolons or tabs, spaces, quotes, empty lines
and empty columns at the end are all read; columns are found by their names, in any order, with their
unit in brackets if they have one: "left (mm²/Hz)".
"""

import csv
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from modeviz.errors import (
    LONGEST_NAME,
    Fault,
    FaultsError,
    ModevizError,
    VehicleError,
    cut,
    located,
    unknown,
)
from modeviz.files.limits import check_size
from modeviz.files.schema.decoding import LARGEST

L = TypeVar("L")
T = TypeVar("T")

MOST_LINES = 100_000
"""A spectrum every 0.001 Hz up to 100 Hz."""

LONGEST_LINE = 10_000
"""Letters."""

_THOUSANDS = re.compile(
    r"[-+]?[1-9]\d{0,2}(?P<mark>[.,'’ \u00a0\u202f])\d{3}((?P=mark)\d{3})*([.,]\d+)?"
)
_DECIMAL_COMMA = re.compile(r"[-+]?[\d.]*,\d+")

_NAME_AND_UNIT = re.compile(r"(.*?)\s*[\[(](.*)[\])]")


@dataclass(frozen=True)
class Row:
    """A line of a table."""

    line: int
    cells: dict[str, str]
    """By column, without spaces around them."""
    decimal_comma: bool

    def where(self, column: str) -> str:
        """The place of a cell, for errors."""
        return f"line {self.line}, column {cut(column, LONGEST_NAME)}"

    def number(self, column: str, at_least: float = -math.inf) -> float:
        """The number in a cell.

        Raises:
            VehicleError: it is none, not finite or too small; the text names line and column.
        """
        cell = self.cells[column]
        text = cell.replace(",", ".") if self.decimal_comma else cell
        try:
            value = float(text)
        except ValueError:
            raise VehicleError(
                f"{self.where(column)}: found {cell!r}, expected a number{_without_marks(cell)}"
            ) from None
        if self._is_ambiguous(cell):
            raise VehicleError(
                f"{self.where(column)}: found {cell!r} beside decimal commas, expected "
                f"{cell.replace('.', '')} or {text.replace('.', ',')}"
            )
        if not abs(value) < LARGEST:
            raise VehicleError(f"{self.where(column)}: found {cell!r}, expected a finite number")
        if value < at_least:
            least = "zero or more" if at_least == 0 else f"at least {at_least:g}"
            raise VehicleError(f"{self.where(column)}: found {cell}, expected {least}")
        return value

    def _is_ambiguous(self, cell: str) -> bool:
        """Whether a number has a point before three figures, and others of its line have commas."""
        if not (self.decimal_comma and "." in cell and _THOUSANDS.fullmatch(cell)):
            return False
        return any(map(_DECIMAL_COMMA.fullmatch, self.cells.values()))


def _without_marks(cell: str) -> str:
    """Words for a number that has marks between its thousands; nothing if it has none."""
    found = _THOUSANDS.fullmatch(cell)
    return f" without marks between its thousands, {cell.replace(found['mark'], '')}" if found else ""


@dataclass(frozen=True)
class Table:
    """The lines of a table that are not empty."""

    units: dict[str, str]
    """By column; empty where its header has none."""
    rows: tuple[Row, ...]


def read_table(
    text: str,
    columns: Sequence[str],
    optional: Sequence[str] = (),
    check: Callable[[dict[str, str]], object] | None = None,
) -> Table:
    """The table in a text.

    Args:
        text: header and lines.
        columns: those that must be there.
        optional: those that may be.
        check: given the unit of each column; raises VehicleError for a header that does not do.

    Raises:
        VehicleError: not such a table; the text names line and column.
    """
    found, decimal_comma = read_cells(text)
    header_line, header = next(found, (1, []))
    units = _header(header_line, header, columns, optional)
    if check:
        with located(f"line {header_line}"):
            check(units)
    rows = tuple(
        Row(line, _by_column(line, cells, list(units)), decimal_comma) for line, cells in found
    )
    return Table(units, rows)


def read_cells(text: str) -> tuple[Iterator[tuple[int, list[str]]], bool]:
    """Return the lines of a text that are not empty, and whether their decimals may be commas.

    A line is its number and its cells, without spaces around them.

    Raises:
        VehicleError: too many lines, too long ones or, as they are read, no CSV.
    """
    check_size("lines", text.count("\n"), MOST_LINES)
    lines = text.removeprefix("\ufeff").splitlines()
    first = next((i for i, line in enumerate(lines) if line.strip(" ,;\t")), 0)
    declared = re.fullmatch(r'"?sep=(.)"?', lines[first].strip(" ")) if lines else None
    if declared:  # as Excel writes it
        first += 1
    _check_lengths(lines)
    separator = declared[1] if declared else _separator(lines[first:])
    return _cells(lines, first, separator), separator != ","


def of_each_line(file: str, lines: Iterable[L], read: Callable[[L], T]) -> list[T]:
    """Return what is read of each line of a table.

    Raises:
        FaultsError: some lines are wrong; all of them are named, after the file.
    """
    found: list[T] = []
    faults: list[Fault] = []
    for line in lines:
        try:
            found.append(read(line))
        except ModevizError as error:
            faults.append(Fault("", f"{file}: {error}"))
    if faults:
        raise FaultsError(*faults)
    return found


def _check_lengths(lines: list[str]) -> None:
    """Raises VehicleError for a line that has no line end where one is due."""
    for number, line in enumerate(lines, start=1):
        if len(line) > LONGEST_LINE:
            raise VehicleError(
                f"line {number}: found {len(line):,} letters, expected at most {LONGEST_LINE:,}"
            )


def _separator(lines: list[str]) -> str:
    """The character that separates the cells of a header: names have neither semicolons nor tabs.

    A line with no such character is a title above it.
    """
    header = next((line for line in lines if any(mark in line for mark in ";\t,")), "")
    return next((mark for mark in ";\t" if mark in header), ",")


def _cells(lines: list[str], first: int, separator: str) -> Iterator[tuple[int, list[str]]]:
    """The lines that are not empty, from the first on, with their numbers and cells."""
    after_quotes = re.compile(f'" +(?={re.escape(separator)}|$)')
    tight = [after_quotes.sub('"', line) for line in lines[first:]]
    reader = csv.reader(tight, delimiter=separator, strict=True, skipinitialspace=True)
    while True:
        line = first + reader.line_num + 1
        try:
            cells = [cell.strip() for cell in next(reader)]
        except StopIteration:
            return
        except csv.Error:
            raise VehicleError(
                f"line {line}: not CSV: a quote does not end, or something stands behind it"
            ) from None
        if any(cells):
            yield line, cells


def _header(
    line: int, cells: list[str], columns: Sequence[str], optional: Sequence[str]
) -> dict[str, str]:
    """The unit of every column that has a name, in the table's order."""
    while cells and not cells[-1]:
        cells = cells[:-1]
    known = (*columns, *optional)
    units: dict[str, str] = {}
    with located(f"line {line}"):
        for cell in cells:
            name, unit = _name_and_unit(cell, known)
            if name in units:
                raise VehicleError(f"column {name} is there twice")
            units[name] = unit
        missing = [name for name in columns if name not in units]
        if missing:
            more = f" and, if wanted, {', '.join(optional)}" if optional else ""
            raise VehicleError(
                f"found {','.join(cells)!r}, without {', '.join(missing)}; expected the columns "
                f"{', '.join(columns)}{more}"
            )
    return units


def _name_and_unit(cell: str, known: Sequence[str]) -> tuple[str, str]:
    """The known column that a header means, and its unit: "Frequency (Hz)" is frequency_hz."""
    match = _NAME_AND_UNIT.fullmatch(cell)
    name, unit = match.groups() if match else (cell, "")
    name, unit = re.sub(r"[\s-]+", "_", name.strip().lower()), unit.strip()
    with_unit = f"{name}_{unit.lower()}"
    if with_unit in known:
        return with_unit, ""
    if name not in known:
        raise VehicleError(unknown("column", cell, known))
    return name, unit


def _by_column(line: int, cells: list[str], names: list[str]) -> dict[str, str]:
    """The cells of a line by column; empty ones beyond the last column do not count."""
    while len(cells) > len(names) and not cells[-1]:
        cells = cells[:-1]
    if len(cells) != len(names):
        raise VehicleError(f"line {line}: found {len(cells)} cells, expected {len(names)}")
    return dict(zip(names, cells, strict=True))
