"""Mount tables of text or Excel: a line for each mount."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, listed, located, quoted, unknown
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.column_units import (
    column_factor,
    is_unit,
    takes_given,
    with_shared_units,
)
from modeviz.files.mount_tables.columns import KINDS, REMARKS, Column, read_headers
from modeviz.files.mount_tables.line import MountLine
from modeviz.files.mount_tables.missing import check_directions
from modeviz.files.mount_tables.reading import Reading
from modeviz.files.sheets import Sheet, read_sheet
from modeviz.files.tables import Row, of_each_line

OF_RATES = {"stiffness", "rotational_stiffness", "damping", "rotational_damping"}
"""The kinds of columns that only mounts have."""

MOST_TITLES = 20
"""Lines above a header."""

FEWEST_COLUMNS = 3
"""Of a line that is a header, where others stand above it."""


def read_mount_table(path: Path, reading: Reading) -> tuple[Bushing, ...]:
    """Return the mounts of a table, in the order of its lines.

    Args:
        path: of the file; of a workbook the sheet "mounts", or else the first.
        reading: what else is known.

    Raises:
        FaultsError: some lines are wrong; the text names file, line and column of each.
        VehicleError: no such table.
    """
    sheet = read_sheet(path, "mounts")
    with located(path.name):
        table = _Table.of(sheet, reading)
        check_directions(table.columns, sheet, table.header, reading.named, reading.note)
        lines = table.lines(sheet)
    if not lines:
        raise VehicleError(f"{path.name}: found a header and no mounts")
    bushings: dict[str, Bushing] = {}

    def read(line: MountLine) -> None:
        bushing = line.bushing(path, bushings)
        if bushing.name in bushings:
            raise VehicleError(
                f"{line.where('name')}: {quoted(bushing.name)} is there twice, in "
                f"{bushings[bushing.name].where} too; each mount needs its own name"
            )
        bushings[bushing.name] = bushing

    of_each_line(path.name, lines, read)
    return tuple(bushings.values())


def is_mount_table(path: Path) -> bool:
    """Return whether a file is a table whose header has mounts and their rates."""
    try:
        sheet = read_sheet(path)
        columns, _ = read_headers(sheet.lines[_header_at(sheet)][1]) if sheet.lines else ({}, [])
    except VehicleError:
        return False
    kinds = {column.kind for column in columns.values()}
    names = {column.name for column in columns.values()}
    return "name" in names and bool(kinds & OF_RATES or names & {"property"})


@dataclass(frozen=True)
class _Table:
    """What the header of a table says."""

    columns: Mapping[int, Column]
    reading: Reading
    header: int
    """Which of the sheet's lines it is."""
    first: int
    """Which is the first mount's."""
    width: int

    @classmethod
    def of(cls, sheet: Sheet, reading: Reading) -> "_Table":
        """Raises VehicleError for a header that is none of mounts."""
        at = _header_at(sheet)
        number, header = sheet.lines[at] if sheet.lines else (1, [])
        with located(f"line {number}"):
            columns, others = read_headers(header)
            names = {column.name for column in columns.values()}
            if {"group", "k_vertical"} <= names and "name" not in names:
                raise VehicleError(
                    "found rates of groups without places; commands take such a file with --rates"
                )
            if any("freq" in header.lower() for header in header):
                raise VehicleError(
                    "found frequencies and no mounts; the table of a road or a load is named in "
                    "vehicle.toml, see docs/vehicle-folder.md"
                )
            if "name" not in names:
                raise VehicleError(
                    f"found the columns {listed(filter(None, header))}, expected those of mounts: "
                    "name, body 1, body 2, x, y, z, k_x, k_y, k_z and others; see docs/mount-tables.md"
                )
        first = at + 1
        if len(sheet.lines) > first and (said := _units_below(sheet.lines[first][1], columns)):
            columns, first = said, first + 1
        columns = with_shared_units(columns)
        for column in columns.values():
            with located(f"line {number}"):
                column_factor(column, reading.units)
        if reading.units and not any(takes_given(c, reading.units) for c in columns.values()):
            raise VehicleError("--units: every column says its own unit; leave it out")
        if reading.is_own:
            with located(f"line {number}"):
                _check_own(columns.values(), others)
        if at:
            reading.note(f"what stands above the header in line {number} is left out")
        if others and not reading.is_own:
            reading.note(f"columns {listed(others)} are left out")
        return cls(columns, reading, at, first, len(header))

    def lines(self, sheet: Sheet) -> list[MountLine]:
        """Those of the mounts."""
        return [self._line(number, cells, sheet) for number, cells in sheet.lines[self.first :]]

    def _line(self, number: int, cells: list[str], sheet: Sheet) -> MountLine:
        if any(cells[self.width :]):
            raise VehicleError(
                f"line {number}: found {len(cells)} cells, expected {self.width} as in the header"
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
        by_name = {column.name: column for column in self.columns.values()}
        return MountLine(Row(number, by_header, sheet.decimal_comma), by_name, self.reading)


def _check_own(columns: Iterable[Column], others: Sequence[str]) -> None:
    """Raises VehicleError for columns that a vehicle's own table does not have."""
    unread = [h for h in others if h.lower() not in REMARKS]
    if unread:
        raise VehicleError(unknown("column", unread[0], [*KINDS, "note"]))
    for column in columns:
        if column.name.startswith(("attachment", "property")):
            raise VehicleError(
                f"column {quoted(column.header)}: is read by modeviz import, expected places and rates "
                "in the table of a vehicle"
            )


def _header_at(sheet: Sheet) -> int:
    """Which of a sheet's lines is the header: there may be titles above it."""
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
        place: Column(column.header, column.name, column.unit or said.get(place, ""))
        for place, column in columns.items()
    }
