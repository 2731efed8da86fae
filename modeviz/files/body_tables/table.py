"""Tables of rigid bodies of text or Excel."""

from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, located, quoted, unknown
from modeviz.files.body_tables.columns import CENTER, KINDS, MOMENTS, read_headers, spoken
from modeviz.files.body_tables.line import BodyLine
from modeviz.files.headed_table import HeadedTable
from modeviz.files.records.bodies import RigidBodyRecord
from modeviz.files.sheets import read_sheet
from modeviz.files.tables import of_each_line

SHEET = "bodies"
"""Of a workbook with several sheets."""


@dataclass(frozen=True, eq=False)
class TableBody:
    """A body of a table."""

    where: str
    """In the file, to say so: "line 3"."""
    record: RigidBodyRecord
    """In SI and the axes of the vehicle's file."""


def read_body_table(path: Path) -> tuple[TableBody, ...]:
    """Return the bodies of a table, in the order of its lines.

    Args:
        path: of the file; of a workbook the sheet "bodies", or else the first.

    Raises:
        FaultsError: some lines are wrong; the text names file, line and column of each.
        VehicleError: no such table.
    """
    bodies: dict[str, TableBody] = {}

    def read(line: BodyLine) -> None:
        record = line.record()
        if record.name in bodies:
            raise VehicleError(
                f"{line.where('name')}: {quoted(record.name)} is there twice, in "
                f"{bodies[record.name].where} too; each body needs its own name"
            )
        bodies[record.name] = TableBody(f"line {line.row.line}", record)

    of_each_line(path.name, _lines(path), read)
    return tuple(bodies.values())


def names_in(path: Path) -> tuple[str, ...]:
    """Return the names of the bodies of a table, of which some may be wrong otherwise."""
    try:
        return tuple(name for line in _lines(path) if (name := line.text("name")))
    except VehicleError:
        return ()


def _lines(path: Path) -> list[BodyLine]:
    sheet = read_sheet(path, SHEET)
    with located(path.name):
        table = HeadedTable.of(sheet, read_headers)
        with located(f"line {table.number}"):
            _check_columns(table)
        table.check_units({})
        rows = table.rows(sheet)
        if not rows:
            raise VehicleError("found a header and no bodies")
        return [BodyLine(row, table.by_name, {}) for row in rows]


def _check_columns(table: HeadedTable) -> None:
    """Raises VehicleError for a column that is not known, or one that has to be there and is not."""
    if table.others:
        raise VehicleError(unknown("column", table.others[0], map(spoken, KINDS)))
    missing = [name for name in ("name", "mass", *CENTER, *MOMENTS) if name not in table.by_name]
    if missing:
        raise VehicleError(
            f"found no column {', '.join(map(spoken, missing))}; a table of bodies has name, mass "
            "[kg], cg_x [m], cg_y, cg_z, Ixx [kg m^2], Iyy, Izz and others, see docs/vehicle-folder.md"
        )
