"""Sets of mount rates as text, JSON or CSV, to keep and to exchange."""

import csv
import json
from io import StringIO
from pathlib import Path
from typing import Literal, get_args

import msgspec

from modeviz.errors import VehicleError, check_unique, located
from modeviz.files.disk import LARGEST_TEXT, WESTERN, read_text, write_text
from modeviz.files.records.rates import RateSetRecord
from modeviz.files.records.record import Record
from modeviz.files.schema.decoding import decode, unreadable
from modeviz.files.schema.quantities import quantity_of
from modeviz.files.schema.scaling import WRITTEN_UNITS, from_si, to_si
from modeviz.files.tables import Row, Table, read_table
from modeviz.units import factor
from modeviz.vehicle.mount_rates import RATE_FIELDS, MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle

WRITTEN_UNIT = WRITTEN_UNITS["stiffness"]

CSV_COLUMNS = ("group", "units", *RATE_FIELDS)
LOSS_COLUMN = "loss_factor"
"""The last column of a CSV file, if there is a loss factor."""

RatesFormat = Literal["csv", "json"]


class RatesFile(Record):
    """The content of a JSON file of rates."""

    rates: dict[str, RateSetRecord]
    """By the name of the mount group."""
    units: str = ""
    """Of every rate; there is no default."""


def parse_rates(text: str, file_format: RatesFormat, vehicle: Vehicle) -> Rates:
    """The rates in the text of a file; it need not name every group.

    JSON is {"units": "N/mm", "rates": {"C2": {"vertical": 724, "lateral": 294, "fore_aft": 294}}}, a
    table has the columns group, units, vertical, lateral and fore_aft; see `read_table`, which also
    reads units in the header, "vertical (N/mm)". A group may have a loss_factor too; without it, it has
    the vehicle's.

    Raises:
        VehicleError: damaged, or a group or unit that does not exist.
    """
    rates = {"csv": _from_csv, "json": _from_json}[file_format](text.removeprefix("\ufeff"))
    for group in rates:
        vehicle.mount_group(group)
    return rates


def rates_text(rates: Rates, file_format: RatesFormat) -> str:
    """Rates in N/mm as text that `parse_rates` reads, to the last bit."""
    return {"csv": _to_csv, "json": _to_json}[file_format](rates)


def read_rates(path: Path, vehicle: Vehicle) -> Rates:
    """The rates in a file, see `parse_rates`; its name says the format.

    Raises:
        VehicleError: no such file, a damaged one, or a group or unit that does not exist.
    """
    file_format = rates_format(path)
    text = read_text(path, LARGEST_TEXT, otherwise=WESTERN if file_format == "csv" else None)
    with located(path):
        return parse_rates(text, file_format, vehicle)


def write_rates(path: Path, rates: Rates) -> None:
    """Writes a file that `read_rates` reads, in N/mm; its name says the format.

    Raises:
        VehicleError: the name ends otherwise, or it cannot be written.
    """
    write_text(path, rates_text(rates, rates_format(path)))


def rates_format(path: Path) -> RatesFormat:
    """The format that a file's name says; raises VehicleError for any other ending."""
    for known in get_args(RatesFormat):
        if path.suffix.lower() == f".{known}":
            return known
    raise VehicleError(f"{path}: found {path.suffix!r}, expected a file of rates, .json or .csv")


def _from_json(text: str) -> Rates:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"not JSON: {unreadable(error)}") from None
    file = decode(data, RatesFile)
    if not file.rates:
        return {}
    with located("units"):
        factor(file.units, "stiffness")
    in_si = msgspec.convert(to_si(data, RatesFile, {"stiffness": file.units}), RatesFile)
    return {group: record.build() for group, record in in_si.rates.items()}


def _from_csv(text: str) -> Rates:
    table = read_table(text, ("group", *RATE_FIELDS), ("units", LOSS_COLUMN))
    rates = [(row.cells["group"], _from_row(row, table)) for row in table.rows]
    check_unique("mount group", (group for group, _ in rates))
    return dict(rates)


def _from_row(row: Row, table: Table) -> MountRates:
    fields = [*RATE_FIELDS, *([LOSS_COLUMN] if row.cells.get(LOSS_COLUMN) else [])]
    return MountRates(**{field: _in_si(field, row, table) for field in fields})


def _in_si(field: str, row: Row, table: Table) -> float:
    """The number in a column that is a field of rates."""
    quantity, unit = quantity_of(RateSetRecord, field), 1.0
    if quantity:
        own = table.units[field]
        with located(row.where(field if own else "units")):
            unit = factor(own or row.cells.get("units", ""), quantity)
    return row.number(field, at_least=0) * unit


def _written(rates: MountRates) -> dict[str, float]:
    """The rates, in the unit we write, and the loss factor if there is one, by field."""
    return from_si(msgspec.to_builtins(RateSetRecord.of(rates)), RateSetRecord)


def _to_json(rates: Rates) -> str:
    content = {
        "units": WRITTEN_UNIT,
        "rates": {group: _written(r) for group, r in rates.items()},
    }
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _to_csv(rates: Rates) -> str:
    rows = [{"group": group, "units": WRITTEN_UNIT, **_written(r)} for group, r in rates.items()]
    has_loss = any(LOSS_COLUMN in row for row in rows)
    columns = [*CSV_COLUMNS, LOSS_COLUMN] if has_loss else [*CSV_COLUMNS]
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([row.get(column) for column in columns] for row in rows)
    return text.getvalue()
