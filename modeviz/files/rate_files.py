"""Sets of mount rates as text, JSON or CSV, to keep and to exchange."""

import csv
import json
from collections.abc import Iterable, Mapping
from io import StringIO
from pathlib import Path
from typing import Literal, get_args

import msgspec

from modeviz.errors import VehicleError, at_key, check_unique, located
from modeviz.files.disk import LARGEST_TEXT, WESTERN, read_text, write_text
from modeviz.files.records.rates import RateSetRecord, rate_set
from modeviz.files.records.record import Record
from modeviz.files.schema.decoding import decode, unreadable
from modeviz.files.schema.quantities import quantity_of
from modeviz.files.schema.scaling import from_si, to_si
from modeviz.files.tables import Row, Table, read_table
from modeviz.units import WRITTEN_UNITS, factor
from modeviz.vehicle.mount_rates import OTHER_FIELDS, STIFFNESS_FIELDS, MountRates, Rates, spoken_unit
from modeviz.vehicle.vehicle import Vehicle

WRITTEN_UNIT = WRITTEN_UNITS["stiffness"]

CSV_COLUMNS = ("group", "units", *STIFFNESS_FIELDS)
OTHER_COLUMNS = {field: f"{field} ({spoken_unit(field)})" for field in OTHER_FIELDS}
"""The columns of a CSV file, with their units, of those of `OTHER_FIELDS` that some group has."""
LOSS_COLUMN = "loss_factor"
"""The last column of a CSV file, if there is a loss factor."""

RatesFormat = Literal["csv", "json"]


class RatesFile(Record):
    """The content of a JSON file of rates."""

    rates: dict[str, RateSetRecord]
    """By the name of the mount group."""
    units: str = ""
    """Of every rate along an axis; there is no default. Others are in N m/rad and N s/m."""


def parse_rates(text: str, file_format: RatesFormat, vehicle: Vehicle) -> Rates:
    """The rates in the text of a file; it need not name every group.

    JSON is {"units": "N/mm", "rates": {"C2": {"vertical": 724, "lateral": 294, "fore_aft": 294}}}, a
    table has the columns group, units, vertical, lateral and fore_aft; see `read_table`, which also
    reads units in the header, "vertical (N/mm)". A group may have those of `OTHER_FIELDS` and a
    loss_factor too; without them, it has the vehicle's.

    Raises:
        VehicleError: damaged, or a group or unit that does not exist.
    """
    records = {"csv": _from_csv, "json": _from_json}[file_format](text.removeprefix("\ufeff"))
    for group in records:
        vehicle.mount_group(group)
    with at_key("rates"):
        return rate_set(records, vehicle.mount_groups)


def rates_text(rates: Rates, file_format: RatesFormat, vehicle: Vehicle | None = None) -> str:
    """Rates in N/mm as text that `parse_rates` reads, to the last bit.

    Args:
        rates: by group.
        file_format: of the text.
        vehicle: whose they are; without it what is zero and not along an axis is left out.
    """
    tuned = {group.name: group.fields for group in vehicle.mount_groups} if vehicle else {}
    written = {group: _written(r, tuned.get(group, ())) for group, r in rates.items()}
    return {"csv": _to_csv, "json": _to_json}[file_format](written)


def read_rates(path: Path, vehicle: Vehicle) -> Rates:
    """The rates in a file, see `parse_rates`; its name says the format.

    Raises:
        VehicleError: no such file, a damaged one, or a group or unit that does not exist.
    """
    file_format = rates_format(path)
    text = read_text(path, LARGEST_TEXT, otherwise=WESTERN if file_format == "csv" else None)
    with located(path):
        return parse_rates(text, file_format, vehicle)


def write_rates(path: Path, rates: Rates, vehicle: Vehicle | None = None) -> None:
    """Writes a file that `read_rates` reads, in N/mm; its name says the format.

    Args:
        path: of the file.
        rates: by group.
        vehicle: as of `rates_text`.

    Raises:
        VehicleError: the name ends otherwise, or it cannot be written.
    """
    write_text(path, rates_text(rates, rates_format(path), vehicle))


def rates_format(path: Path) -> RatesFormat:
    """The format that a file's name says; raises VehicleError for any other ending."""
    for known in get_args(RatesFormat):
        if path.suffix.lower() == f".{known}":
            return known
    raise VehicleError(f"{path}: found {path.suffix!r}, expected a file of rates, .json or .csv")


def _from_json(text: str) -> dict[str, RateSetRecord]:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"not JSON: {unreadable(error)}") from None
    file = decode(data, RatesFile)
    if not file.rates:
        return {}
    with located("units"):
        factor(file.units, "stiffness")
    units = {**WRITTEN_UNITS, "stiffness": file.units}
    return msgspec.convert(to_si(data, RatesFile, units), RatesFile).rates


def _from_csv(text: str) -> dict[str, RateSetRecord]:
    table = read_table(text, ("group", *STIFFNESS_FIELDS), ("units", *OTHER_FIELDS, LOSS_COLUMN))
    rates = [(row.cells["group"], _from_row(row, table)) for row in table.rows]
    check_unique("mount group", (group for group, _ in rates))
    return dict(rates)


def _from_row(row: Row, table: Table) -> RateSetRecord:
    given = (field for field in (*OTHER_FIELDS, LOSS_COLUMN) if row.cells.get(field))
    return RateSetRecord(**{field: _in_si(field, row, table) for field in (*STIFFNESS_FIELDS, *given)})


def _in_si(field: str, row: Row, table: Table) -> float:
    """The number in a column that is a field of rates."""
    quantity, unit = quantity_of(RateSetRecord, field), 1.0
    if quantity:
        own = table.units[field]
        with located(row.where(field if own else "units")):
            said = own or (spoken_unit(field) if field in OTHER_FIELDS else row.cells.get("units", ""))
            unit = factor(said, quantity)
    return row.number(field, at_least=0) * unit


def _written(rates: MountRates, tuned: Iterable[str]) -> dict[str, float]:
    """The rates, in the units we write, and the loss factor if there is one, by field."""
    return from_si(msgspec.to_builtins(RateSetRecord.of(rates, tuned)), RateSetRecord)


def _to_json(rates: Mapping[str, Mapping[str, float]]) -> str:
    content = {"units": WRITTEN_UNIT, "rates": rates}
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _to_csv(rates: Mapping[str, Mapping[str, float]]) -> str:
    rows = [{"group": group, "units": WRITTEN_UNIT, **r} for group, r in rates.items()]
    others = [field for field in (*OTHER_FIELDS, LOSS_COLUMN) if any(field in row for row in rows)]
    columns = [*CSV_COLUMNS, *others]
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(OTHER_COLUMNS.get(column, column) for column in columns)
    writer.writerows([row.get(column) for column in columns] for row in rows)
    return text.getvalue()
