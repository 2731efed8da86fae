"""Residual compliance that is given in numbers: what the modes of a component leave out."""

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, check_unique, located, quoted, unknown
from modeviz.files.disk import read_text
from modeviz.formats.component import UnitSystem
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.residuals import with_residual_compliance

COLUMNS = ("attachment", "x", "y", "z")
"""Of a table."""

FORMS = "NAME=X,Y,Z, the compliance of an attachment along x, y and z, or a CSV file of such rows"


def with_given_compliance(body: FlexibleBody, given: Sequence[str], units: UnitSystem) -> FlexibleBody:
    """Return a body with the residual compliance that is given.

    Args:
        body: in SI, with the attachments that are named.
        given: in one of the `FORMS`, length over force in the units of its files.
        units: those; their time is in seconds, so that 1 of compliance is 1/mass.

    Raises:
        VehicleError: something else is given, or of an attachment that is not there.
    """
    rows = [row for text in given for row in _rows(text)]
    check_unique("residual compliance of", (name for name, _ in rows))
    names = [a.name for a in body.attachments]
    for name, _ in rows:
        if name not in names:
            raise VehicleError(unknown("attachment", name, names))
    return with_residual_compliance(body, {name: values / units.mass for name, values in rows})


def _rows(text: str) -> Iterator[tuple[str, Floats]]:
    name, is_one, values = text.rpartition("=")
    if is_one:
        yield name.strip(), _compliance(text, values.split(","))
        return
    path = Path(text)
    if path.suffix.lower() != ".csv":
        raise VehicleError(f"found {quoted(text)}, expected {FORMS}")
    with located(path):
        yield from _table(read_text(path))


def _table(text: str) -> Iterator[tuple[str, Floats]]:
    """The rows of a table; fields that are left empty are zero."""
    header, *rows = [*csv.reader(text.splitlines())] or [[]]
    if [field.strip().lower() for field in header] != list(COLUMNS):
        found = quoted(",".join(header))
        raise VehicleError(f"found the columns {found}, expected {','.join(COLUMNS)}")
    for row in filter(any, rows):
        yield row[0].strip(), _compliance(",".join(row), [value.strip() or "0" for value in row[1:]])


def _compliance(where: str, values: Sequence[str]) -> Floats:
    try:
        found = np.array([float(value) for value in values])
    except ValueError:
        found = np.full(3, np.nan)
    if len(found) != 3 or not (np.isfinite(found) & (found >= 0)).all():
        raise VehicleError(
            f"found {quoted(where)}, expected a name and three compliances, length over "
            "force, none below zero"
        )
    return found
