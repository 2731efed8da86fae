"""Mount rates as people name them: "C2.lateral=131 N/mm", a set's name, or a file."""

import csv
import json
from collections.abc import Iterable
from dataclasses import asdict, replace
from io import StringIO
from pathlib import Path

import msgspec

from modeviz.errors import VehicleError, check_unique, located, unknown
from modeviz.units import factor, parse
from modeviz.vehicle.connections import DIRECTIONS, MountRates, Rates
from modeviz.vehicle.files.decoding import decode
from modeviz.vehicle.files.disk import read_text, write_text
from modeviz.vehicle.files.records import RatesRecord
from modeviz.vehicle.files.scaling import written
from modeviz.vehicle.vehicle import Vehicle

ORIGINAL = "original"
"""The choice of the rates that the vehicle has."""

WRITTEN_UNIT = "N/mm"

CSV_COLUMNS = ("group", "units", "vertical", "lateral", "fore_aft")


class RatesFile(msgspec.Struct, forbid_unknown_fields=True):
    """The content of a JSON file of rates."""

    rates: dict[str, RatesRecord]
    """By the name of the mount group."""
    units: str = ""
    """Of every rate; there is no default."""


def parse_setting(text: str, vehicle: Vehicle) -> Rates:
    """The rates of the group that a setting such as "C2.lateral=131 N/mm" changes.

    Raises:
        VehicleError: not of that form, or a group, direction or unit that does not exist.
    """
    name, _, value = text.partition("=")
    group, _, direction = name.strip().rpartition(".")
    with located(f"setting {text!r}"):
        if not group or not value:
            raise VehicleError("expected GROUP.DIRECTION=RATE UNIT, as in C2.lateral=131 N/mm")
        rates = vehicle.mount_group(group).rates
        spoken = direction.replace("_", "-")
        if spoken not in DIRECTIONS:
            raise VehicleError(unknown("direction", direction, DIRECTIONS))
        changed = {spoken.replace("-", "_"): parse(value, "stiffness")}
        return {group: replace(rates, **changed)}


def resolve_rates(vehicle: Vehicle, choice: str, settings: Iterable[str] = ()) -> Vehicle:
    """The vehicle with the rates chosen, and then one setting after the other.

    Args:
        vehicle: whose groups and named sets there are to choose from.
        choice: "original", the name of one of the vehicle's sets, or a file's.
        settings: as for `parse_setting`.

    Raises:
        VehicleError: no such choice, or a setting or file that is wrong.
    """
    vehicle = vehicle.with_rates(_chosen(vehicle, choice))
    for setting in settings:
        vehicle = vehicle.with_rates(parse_setting(setting, vehicle))
    return vehicle


def read_rates(path: Path, vehicle: Vehicle) -> Rates:
    """The rates in a file, JSON or CSV; a file need not name every group.

    JSON is {"units": "N/mm", "rates": {"C2": {"vertical": 724, "lateral": 294, "fore_aft": 294}}},
    CSV has the columns group, units, vertical, lateral and fore_aft.

    Raises:
        VehicleError: no such file, a damaged one, or a group or unit that does not exist.
    """
    readers = {".json": _from_json, ".csv": _from_csv}
    read = readers.get(path.suffix.lower())
    if read is None:
        raise VehicleError(f"{path}: found {path.suffix!r}, expected a file of rates, .json or .csv")
    text = read_text(path)
    with located(path):
        rates = read(text)
        for group in rates:
            vehicle.mount_group(group)
        return rates


def write_rates(path: Path, rates: Rates) -> None:
    """Writes a file that `read_rates` reads, in N/mm; CSV if the name ends so, else JSON.

    Raises:
        VehicleError: it cannot be written.
    """
    text = _to_csv(rates) if path.suffix.lower() == ".csv" else _to_json(rates)
    write_text(path, text)


def _chosen(vehicle: Vehicle, choice: str) -> Rates:
    if choice == ORIGINAL:
        return vehicle.rates
    if choice in vehicle.rate_sets:
        return vehicle.rate_sets[choice]
    if Path(choice).suffix:
        return read_rates(Path(choice), vehicle)
    known = unknown("rates", choice, dict.fromkeys((ORIGINAL, *vehicle.rate_sets)))
    raise VehicleError(f"{known}, or give a .json or .csv file")


def _from_json(text: str) -> Rates:
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"not JSON: {error}") from None
    file = decode(data, RatesFile)
    return {group: _in_si(record, file.units) for group, record in file.rates.items()}


def _from_csv(text: str) -> Rates:
    try:
        header, *rows = list(csv.reader(StringIO(text), strict=True)) or [[]]
    except (ValueError, csv.Error) as error:
        raise VehicleError(f"not CSV: {error}") from None
    if tuple(header) != CSV_COLUMNS:
        raise VehicleError(f"line 1: found {','.join(header)!r}, expected {','.join(CSV_COLUMNS)}")
    rates = []
    for number, row in enumerate(rows, 2):
        with located(f"line {number}"):
            rates.append(_from_row(row))
    check_unique("mount group", (group for group, _ in rates))
    return dict(rates)


def _from_row(row: list[str]) -> tuple[str, MountRates]:
    if len(row) != len(CSV_COLUMNS):
        raise VehicleError(f"found {len(row)} cells, expected {len(CSV_COLUMNS)}")
    group, unit, *values = row
    record = dict(zip(CSV_COLUMNS[2:], map(_number, values), strict=True))
    return group, _in_si(decode(record, RatesRecord), unit)


def _number(cell: str) -> float | str:
    """The cell as a number; what is none stays text, which `decode` complains about."""
    try:
        return float(cell)
    except ValueError:
        return cell


def _in_si(record: RatesRecord, unit: str) -> MountRates:
    with located("units"):
        newton_per_metre = factor(unit, "stiffness")
    return MountRates(*(rate * newton_per_metre for rate in record.build().as_tuple()))


def _in_written_unit(rates: MountRates) -> dict[str, float]:
    unit = factor(WRITTEN_UNIT, "stiffness")
    return {key: written(rate, unit) for key, rate in asdict(rates).items()}


def _to_json(rates: Rates) -> str:
    content = {
        "units": WRITTEN_UNIT,
        "rates": {group: _in_written_unit(r) for group, r in rates.items()},
    }
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _to_csv(rates: Rates) -> str:
    text = StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(CSV_COLUMNS)
    writer.writerows((group, WRITTEN_UNIT, *_in_written_unit(r).values()) for group, r in rates.items())
    return text.getvalue()
