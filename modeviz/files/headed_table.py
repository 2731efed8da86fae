"""Tables with a header as people keep them: titles above it, and units in it or in the line below."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.columns import Column, column_factor, is_unit, with_shared_units
from modeviz.files.schema.scaling import BEYOND_ANY_VEHICLE
from modeviz.files.sheets import Sheet
from modeviz.files.tables import Row
from modeviz.units import WRITTEN_UNITS, QuantityName
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.checks import FARTHEST

Headers = Callable[[Sequence[str]], tuple[dict[int, Column], list[str]]]
"""Gives the columns that are read, by where they stand, and the headers of others."""

MOST_TITLES = 20
"""Lines above a header."""

FEWEST_COLUMNS = 3
"""Of a line that is a header, where others stand above it."""


@dataclass(frozen=True)
class TableLine:
    """A line of a table below its header."""

    row: Row
    columns: Mapping[str, Column]
    """By what they mean."""
    units: Mapping[QuantityName, float]
    """One of a quantity, in SI, of numbers whose headers say no unit."""

    def where(self, name: str) -> str:
        """The place of a cell, for errors."""
        header = self.columns[name].header if name in self.columns else name
        return self.row.where(header)

    def text(self, name: str) -> str:
        """What stands in a column; nothing if there is none."""
        return self.row.cells[self.columns[name].header] if name in self.columns else ""

    def required(self, name: str, what: str) -> str:
        """What stands in a column that has to have something, which is `what` in words."""
        if not self.text(name):
            raise VehicleError(f"{self.where(name)}: empty, expected {what}")
        return self.text(name)

    def number(self, name: str, at_least: float = -np.inf) -> float | None:
        """The number in a column, SI; None if it is empty.

        Raises:
            VehicleError: it is no number, too small, or without a unit.
        """
        if not self.text(name):
            return None
        column = self.columns[name]
        if column.kind == "ratio" and self.text(name).endswith("%"):
            cells = {column.header: self.text(name).removesuffix("%").strip()}
            return replace(self.row, cells=cells).number(column.header, at_least) / 100
        value = self.row.number(column.header, at_least)
        factor = self.factor(column)
        if factor is None:
            usual = next(u for kind, u in WRITTEN_UNITS.items() if kind == column.kind)
            raise VehicleError(
                f"{self.where(name)}: found {self.text(name)} without a unit; write it in the header, "
                f"'{column.header} [{usual}]'{self.otherwise}"
            )
        if abs(value * factor) > BEYOND_ANY_VEHICLE:
            raise VehicleError(
                f"{self.where(name)}: found {self.text(name)}, which is beyond any vehicle"
            )
        return value * factor

    @property
    def otherwise(self) -> str:
        """What else may be done where a header has no unit."""
        return ""

    def factor(self, column: Column) -> float | None:
        """One of a column's numbers in SI; None if nothing says it."""
        return column_factor(column, self.units)

    def numbers(
        self, names: tuple[str, ...], at_least: float = -np.inf, empty: float = 0.0
    ) -> Floats | None:
        """Those in columns, `empty` where one is; None if all are."""
        found = [self.number(name, at_least) for name in names]
        if all(value is None for value in found):
            return None
        return np.array([empty if value is None else value for value in found])

    def place(self, names: tuple[str, ...]) -> Floats | None:
        """A place of which all coordinates are there, or none.

        Raises:
            VehicleError: some are missing.
        """
        missing = [name for name in names if not self.text(name)]
        if len(missing) == len(names):
            return None
        if missing:
            raise VehicleError(f"{self.where(missing[0])}: empty, expected all of {', '.join(names)}")
        return self.numbers(names)

    def near_place(self, names: tuple[str, ...]) -> Floats | None:
        """Such a place, of a vehicle's own table.

        Raises:
            VehicleError: it is farther away than anything of a vehicle.
        """
        place = self.place(names)
        for name, value in zip(names, () if place is None else place, strict=False):
            if abs(value) > FARTHEST:
                found = f"found {self.text(name)}, which is {abs(value):.4g} m from the origin"
                raise VehicleError(
                    f"{self.where(name)}: {found}, expected at most {FARTHEST:g} m; if it is in mm, "
                    f"say so: '{name} [mm]'"
                )
        return place


@dataclass(frozen=True)
class HeadedTable:
    """What the header of a table says, and where it stands."""

    columns: Mapping[int, Column]
    """Those that are read, by where they stand."""
    others: Sequence[str]
    """The headers of those that are not."""
    at: int
    """Which of the sheet's lines the header is."""
    number: int
    """That line's number in the file."""
    first: int
    """Which of the sheet's lines is the first below."""

    @classmethod
    def of(cls, sheet: Sheet, read_headers: Headers) -> "HeadedTable":
        """Raises VehicleError for headers that cannot be read."""
        at = header_at(sheet, read_headers)
        number, header = sheet.lines[at] if sheet.lines else (1, [])
        with located(f"line {number}"):
            columns, others = read_headers(header)
        first = at + 1
        if len(sheet.lines) > first and (said := _units_below(sheet.lines[first][1], columns)):
            columns, first = said, first + 1
        return cls(with_shared_units(columns), others, at, number, first)

    def check_units(self, units: Mapping[QuantityName, float]) -> None:
        """Raises VehicleError for a column whose unit is that of something else."""
        for column in self.columns.values():
            with located(f"line {self.number}"):
                column_factor(column, units)

    def rows(self, sheet: Sheet) -> list[Row]:
        """The lines below the header, with the cells of columns that are read.

        Raises:
            VehicleError: one has more cells than the header, or a formula without a value.
        """
        return [self._row(number, cells, sheet) for number, cells in sheet.lines[self.first :]]

    @property
    def by_name(self) -> dict[str, Column]:
        """The columns that are read, by what they mean."""
        return {column.name: column for column in self.columns.values()}

    def _row(self, number: int, cells: list[str], sheet: Sheet) -> Row:
        width = len(sheet.lines[self.at][1])
        if any(cells[width:]):
            raise VehicleError(
                f"line {number}: found {len(cells)} cells, expected {width} as in the header"
            )
        by_header = {
            column.header: cells[place] if place < len(cells) else ""
            for place, column in self.columns.items()
        }
        for header, text in by_header.items():
            if text[:1] == "=":
                raise VehicleError(
                    f"line {number}, column {header}: found {quoted(text)}, a formula whose value "
                    "isn't stored; open the workbook in Excel and save it"
                )
        return Row(number, by_header, sheet.decimal_comma)


def header_at(sheet: Sheet, read_headers: Headers) -> int:
    """Return which of a sheet's lines is the header: there may be titles above it."""
    for at, (_, cells) in enumerate(sheet.lines[:MOST_TITLES]):
        try:
            columns, _ = read_headers(cells)
        except VehicleError:
            continue
        names = {column.name for column in columns.values()}
        if "name" in names and len(names) >= FEWEST_COLUMNS:
            return at
    return 0


def _units_below(cells: list[str], columns: Mapping[int, Column]) -> dict[int, Column] | None:
    """The columns with the units in the line below the header; None if there are none in it."""
    texts = {place: cells[place] if place < len(cells) else "" for place in columns}
    said = {place: text for place, text in texts.items() if text not in ("", "-")}
    are_units = all(is_unit(texts[place], column) for place, column in columns.items())
    if not (are_units and any(texts.values())):
        return None
    return {
        place: replace(column, unit=column.unit or said.get(place, ""))
        for place, column in columns.items()
    }
