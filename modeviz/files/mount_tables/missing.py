"""Rates of which a mount table has no column, though it likely means to have one."""

import re
from collections.abc import Callable, Mapping, Sequence

from modeviz.errors import VehicleError, listed, quoted
from modeviz.files.columns import UNIT, Column, is_unit
from modeviz.files.mount_tables.columns import KINDS
from modeviz.files.sheets import Sheet
from modeviz.vehicle.local_axes import AXES

RATES = {"k": "stiffness", "c": "damping"}
"""What columns begin with that have numbers along the local axes."""

NUMBER = re.compile(r"[-+]?[\d.,]*\d[\d.,]*(e[-+]?\d+)?", re.IGNORECASE)


def check_directions(
    columns: Mapping[int, Column],
    sheet: Sheet,
    header: int,
    named: Mapping[str, str],
    note: Callable[[str], None],
) -> None:
    """Checks that what is left out of a table is not the rate along an axis that it does not have.

    Args:
        columns: those that are read, by where they stand.
        sheet: the table.
        header: which of its lines is the header.
        named: as of `read_mount_table`.
        note: told of one axis that has no rate beside two that have.

    Raises:
        VehicleError: it has rates along one or two axes, and numbers that may be those of another.
    """
    names = {column.name for column in columns.values()}
    for letter, what in RATES.items():
        have = {axis for axis in AXES if f"{letter}_{axis}" in names}
        have |= {axis for name, axis in named.items() if f"{letter}_{name}" in names}
        missing = [axis for axis in AXES if axis not in have]
        if not 0 < len(missing) < len(AXES):
            continue
        absent = ", ".join(f"{letter}_{axis}" for axis in missing)
        if likely := _likely(columns, sheet, header, letter, missing):
            raise VehicleError(
                f"line {sheet.lines[header][0]}: found no column {absent}, and numbers in "
                f"{listed(likely)}, which is none that is read; call it so if it is that {what}, or "
                "else take it out"
            )
        if len(missing) == 1:
            note(f"there is no column {absent}: this {what} is taken as zero")


def _likely(
    columns: Mapping[int, Column], sheet: Sheet, header: int, letter: str, missing: Sequence[str]
) -> list[str]:
    """The headers of columns of numbers that are not read and may be missing rates."""
    return [
        quoted(text)
        for place, text in enumerate(sheet.lines[header][1])
        if text
        and place not in columns
        and _may_be(text, letter, missing)
        and _has_numbers(sheet, header, place)
    ]


def _may_be(header: str, letter: str, missing: Sequence[str]) -> bool:
    """Whether a header has the unit of a rate; or none, and names its axis or is left over for it."""
    found = UNIT.fullmatch(header)
    unit = next((text for text in found.groups()[1:] if text), "") if found else ""
    if unit:
        return is_unit(unit, Column(header, f"{letter}_x", "", KINDS[f"{letter}_x"]))
    return len(missing) == 1 or bool({*missing} & {*re.split(r"[\W_]+", header.lower())})


def _has_numbers(sheet: Sheet, header: int, place: int) -> bool:
    return any(
        place < len(cells) and NUMBER.fullmatch(cells[place]) for _, cells in sheet.lines[header + 1 :]
    )
