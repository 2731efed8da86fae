"""Mount tables of text or Excel: a line for each mount."""

from collections.abc import Sequence
from pathlib import Path

from modeviz.errors import ModevizError, VehicleError, listed, located, quoted, unknown
from modeviz.files.columns import takes_given
from modeviz.files.headed_table import HeadedTable, header_at
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.columns import KINDS, REMARKS, read_headers
from modeviz.files.mount_tables.line import MountLine
from modeviz.files.mount_tables.missing import check_directions
from modeviz.files.mount_tables.reading import Reading
from modeviz.files.sheets import read_sheet
from modeviz.files.tables import of_each_line

OF_RATES = {"stiffness", "rotational_stiffness", "damping", "rotational_damping"}
"""The kinds of columns that only mounts have."""

SHEET = "mounts"
"""Of a workbook with several sheets."""


def read_mount_table(path: Path, reading: Reading) -> tuple[Bushing, ...]:
    """Return the mounts of a table, in the order of its lines.

    Args:
        path: of the file; of a workbook the sheet "mounts", or else the first.
        reading: what else is known.

    Raises:
        FaultsError: some lines are wrong; the text names file, line and column of each.
        VehicleError: no such table.
    """
    sheet = read_sheet(path, SHEET)
    with located(path.name):
        table = HeadedTable.of(sheet, read_headers)
        _check_columns(table, sheet.lines[table.at][1] if sheet.lines else (), reading)
        check_directions(table.columns, sheet, table.at, reading.named, reading.note)
        rows = table.rows(sheet)
    if not rows:
        raise VehicleError(f"{path.name}: found a header and no mounts")
    lines = [MountLine(row, table.by_name, reading.units, reading) for row in rows]
    bushings: dict[str, Bushing] = {}
    refused: set[str] = set()

    def read(line: MountLine) -> None:
        try:
            bushing = line.bushing(path, bushings, refused)
        except ModevizError:
            refused.update(filter(None, [line.text("group")]))
            raise
        if bushing.name in bushings:
            raise VehicleError(
                f"{line.where('name')}: {quoted(bushing.name)} is there twice, in "
                f"{bushings[bushing.name].where} too; each mount needs its own name"
            )
        bushings[bushing.name] = bushing

    of_each_line(path.name, lines, read)
    return tuple(bushings.values())


def mount_names_in(path: Path) -> tuple[str, ...]:
    """Return the names of the mounts of a table and of their groups, some of which may be wrong.

    Raises:
        VehicleError: no such table.
    """
    sheet = read_sheet(path, SHEET)
    table = HeadedTable.of(sheet, read_headers)
    headers = [table.by_name[name].header for name in ("name", "group") if name in table.by_name]
    return tuple(row.cells[header] for row in table.rows(sheet) for header in headers)


def is_mount_table(path: Path) -> bool:
    """Return whether a file is a table whose header has mounts and their rates."""
    try:
        sheet = read_sheet(path, SHEET)
        at = header_at(sheet, read_headers)
        columns, _ = read_headers(sheet.lines[at][1]) if sheet.lines else ({}, [])
    except VehicleError:
        return False
    kinds = {column.kind for column in columns.values()}
    names = {column.name for column in columns.values()}
    return "name" in names and bool(kinds & OF_RATES or names & {"property"})


def _check_columns(table: HeadedTable, header: Sequence[str], reading: Reading) -> None:
    """Raises VehicleError for a header that is none of mounts; notes what is left out of one."""
    with located(f"line {table.number}"):
        _check_are_mounts(table, header)
    table.check_units(reading.units)
    if reading.units and not any(takes_given(c, reading.units) for c in table.columns.values()):
        raise VehicleError("--units: every column says its own unit; leave it out")
    if reading.is_own:
        with located(f"line {table.number}"):
            _check_own(table)
    if table.at:
        reading.note(f"what stands above the header in line {table.number} is left out")
    if table.others and not reading.is_own:
        reading.note(f"columns {listed(table.others)} are left out")


def _check_are_mounts(table: HeadedTable, header: Sequence[str]) -> None:
    if {"group", "k_vertical"} <= set(table.by_name) and "name" not in table.by_name:
        raise VehicleError(
            "found rates of groups without places; commands take such a file with --rates"
        )
    if any("freq" in text.lower() for text in header):
        raise VehicleError(
            "found frequencies and no mounts; the table of a road or a load is named in vehicle.toml, "
            "see docs/vehicle-folder.md"
        )
    if "name" not in table.by_name:
        raise VehicleError(
            f"found the columns {listed(filter(None, header))}, expected those of mounts: name, body "
            "1, body 2, x, y, z, k_x, k_y, k_z and others; see docs/mount-tables.md"
        )


def _check_own(table: HeadedTable) -> None:
    """Raises VehicleError for columns that a vehicle's own table does not have."""
    unread = [header for header in table.others if header.lower() not in REMARKS]
    if unread:
        raise VehicleError(unknown("column", unread[0], [*KINDS, "note"]))
    for column in table.columns.values():
        if column.name.startswith(("attachment", "property")):
            raise VehicleError(
                f"column {quoted(column.header)}: is read by modeviz import, expected places and rates "
                "in the table of a vehicle"
            )
