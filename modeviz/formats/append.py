"""Tables put behind what stands in a vehicle folder's vehicle.toml, which stays to the letter."""

import re
import shutil
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import msgspec

from modeviz.errors import VehicleError
from modeviz.files.disk import read_text, replace_folder, write_text
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.files.records.record import Record
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.hints import each_annotated
from modeviz.files.schema.quantities import Quantity
from modeviz.files.schema.scaling import from_si
from modeviz.files.toml_reader import read_toml
from modeviz.files.toml_writer import toml_lines, toml_value
from modeviz.units import WRITTEN_UNITS, QuantityName
from modeviz.vehicle.vehicle import Vehicle

UNITS_HEADER = re.compile(r"^[ \t]*\[[ \t]*units[ \t]*\][ \t]*(?:#.*)?\r?$", re.MULTILINE)


def append_tables(
    folder: Path,
    tables: Mapping[str, Sequence[Record]],
    heading: str,
    write: Callable[[Path], None] = lambda folder: None,
) -> Vehicle:
    """Return the vehicle of a folder with more tables.

    Numbers are written in the units of the file; a quantity for which it has none gets one, in a line
    behind `[units]`.

    Args:
        folder: of a vehicle.
        tables: by their key; their records in SI and in the file's axes.
        heading: a comment before them.
        write: writes the files that the tables name into the folder it is given.

    Raises:
        VehicleError: the result would be no vehicle, or cannot be written; nothing has changed then.
    """
    path = folder / VEHICLE_FILE
    text, units = read_text(path), read_toml(path, VehicleRecord).units
    data = {
        key: [msgspec.to_builtins(r) for r in records] for key, records in tables.items() if records
    }
    missing: list[QuantityName] = [q for q in _quantities(data) if not units.get(q)]
    text = _with_units(text, missing, path, has_some=bool(units))
    known = {**WRITTEN_UNITS, **units}
    lines = toml_lines(from_si(data, VehicleRecord, known), "")
    gap = "\n" if text.endswith("\n") else "\n\n"
    text = f"{text}{gap}{heading}\n" + "\n".join(lines).strip() + "\n"
    vehicles = []

    def fill(new: Path) -> None:
        shutil.copytree(folder, new, symlinks=True, dirs_exist_ok=True)
        write(new)
        write_text(new / VEHICLE_FILE, text)
        try:
            vehicles.append(read_vehicle(new))
        except VehicleError as error:
            raise VehicleError(str(error).replace(str(new), str(folder))) from None

    replace_folder(folder, fill)
    return vehicles[0]


def _quantities(data: Mapping[str, object]) -> list[QuantityName]:
    """Those of which there are numbers in the tables."""
    found: dict[QuantityName, None] = {}

    def see(value: object, quantity: Quantity, table: Mapping[str, object], _where: str) -> object:
        if value is not None and not isinstance(value, str):
            found[quantity.named(table)] = None
        return value

    each_annotated(data, VehicleRecord, Quantity, see)
    return list(found)


def _with_units(text: str, missing: Sequence[QuantityName], path: Path, has_some: bool) -> str:
    """The text with units of quantities that had none."""
    lines = "".join(f"\n{quantity} = {toml_value(WRITTEN_UNITS[quantity])}" for quantity in missing)
    if not lines:
        return text
    if header := UNITS_HEADER.search(text):
        return text[: header.end()] + lines + text[header.end() :]
    if has_some:
        raise VehicleError(
            f"{path}: units: has no {missing[0]}, in which numbers are to be added; write "
            f'{missing[0]} = "{WRITTEN_UNITS[missing[0]]}" into it'
        )
    return f"{text}\n\n[units]{lines}\n"
