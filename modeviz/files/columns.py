"""The columns of tables that people keep: their headers and units, however they are spelt."""

import re
import unicodedata
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Literal

from modeviz.errors import VehicleError, located, quoted
from modeviz.units import UNITS, QuantityName, spoken

RATIOS = {"": 1.0, "%": 0.01, "-": 1.0, "1": 1.0}

Kind = QuantityName | Literal["text", "ratio", "number"]
"""Of what a column's numbers are, or that it has none."""

UNIT = re.compile(r"(.*?)\s*(?:[\[(](.*)[\])]|\s/\s*(.*)|,\s*(.*)|\sin\s+(\S+/\S+|mm|m))\s*")
"""A header and its unit: "kx [N/mm]", "kx (N/mm)", "kx / (N/mm)", "kx, N/mm", "kx in N/mm"."""


@dataclass(frozen=True)
class Column:
    """A column of a table."""

    header: str
    """As it stands there."""
    name: str
    """What it means."""
    unit: str
    """As its header or the row below it says it; empty for none."""
    kind: Kind


def bare(text: str) -> str:
    """Return a header without spaces and marks, in small letters."""
    return re.sub(r"[\W_]+", "", text.lower())


def split_header(header: str, meaning: Callable[[str], str | None]) -> tuple[str, str]:
    """Return the name in a header and its unit: all of it is the name where that alone means nothing.

    Args:
        header: such as "kx [N/mm]".
        meaning: tells what a name means, if anything.
    """
    found = UNIT.fullmatch(header)
    if not (found and meaning(found[1])):
        return header, ""
    return found[1], next((u for u in found.groups()[1:] if u), "").strip().strip("()")


def column_factor(column: Column, units: Mapping[QuantityName, float]) -> float | None:
    """Return one of a column's numbers in SI; None if neither it nor `units` say it.

    Args:
        column: of numbers.
        units: one of a quantity in SI, of columns that say none.

    Raises:
        VehicleError: it says a unit of something else.
    """
    kind = column.kind
    with located(f"column {quoted(column.header)}"):
        if kind == "text":
            return None
        if kind == "number":
            return 1.0
        if kind == "ratio":
            return _one_of(column.unit, RATIOS, "loss factor")
        if column.unit:
            return _one_of(column.unit, UNITS[kind], spoken(kind))
        return units.get(kind)


def takes_given(column: Column, units: Mapping[QuantityName, float]) -> bool:
    """Return whether a column's numbers are in one of some units, since it says none."""
    return not column.unit and column.kind in units


def with_shared_units(columns: Mapping[int, Column]) -> dict[int, Column]:
    """Return columns of which those without a unit have the one that others of their kind say.

    So "x [mm], y, z" is in mm, if no length is said to be in something else. Rates may have their unit
    in a column of its own.
    """
    said: dict[Kind, set[str]] = {}
    of_lines = {"stiffness"} if any(column.name == "units" for column in columns.values()) else set()
    for column in columns.values():
        if column.unit and column.kind not in of_lines:
            said.setdefault(column.kind, set()).add(column.unit)
    return {
        place: replace(column, unit=next(iter(said[column.kind])))
        if not column.unit and len(said.get(column.kind, ())) == 1
        else column
        for place, column in columns.items()
    }


def rate_unit(text: str) -> float:
    """Return one of a unit of stiffness in SI; raises VehicleError if it is none."""
    return _one_of(text, UNITS["stiffness"], "stiffness")


def is_unit(text: str, column: Column) -> bool:
    """Whether a cell under a header says its unit."""
    if text in ("", "-"):
        return True
    try:
        said = replace(column, header="", unit=text)
        return column.kind != "text" and column_factor(said, {}) is not None
    except VehicleError:
        return False


def _one_of(text: str, known: Mapping[str, float], what: str) -> float:
    """The value of a unit, however it is spelt."""
    by_spelling = {_spelling(unit): value for unit, value in known.items()}
    spelling = _spelling(text)
    if spelling in by_spelling:
        return by_spelling[spelling]
    folded = {unit.lower(): value for unit, value in by_spelling.items()}
    if spelling.lower() in folded:
        return folded[spelling.lower()]
    units = ", ".join(unit for unit in known if unit)
    raise VehicleError(f"unknown unit of {what} {quoted(text)}, expected one of {units}")


def _spelling(unit: str) -> str:
    """A unit without what people write differently: "N·s/m", "N s / m" and "N/(m/s)" are one."""
    text = unicodedata.normalize("NFKC", unit.replace("°", "deg")).replace("\u2212", "-")
    text = re.sub(r"degrees?|grad\b", "deg", text)
    text = re.sub(r"radians?", "rad", text)
    text = re.sub(r"/\s*\(\s*(\w+)\s*/\s*(\w+)\s*\)", r" \2/\1", text)
    return re.sub(r"[\s·⋅*.()^]", "", text)
