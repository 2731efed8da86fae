"""docs/vehicle-folder.md has every table, key, unit and array of a vehicle folder that readers have."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

import msgspec
import numpy as np
import pytest

from modeviz.cli import main
from modeviz.files import read_vehicle
from modeviz.files.modal import ARRAYS
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.road_columns import COLUMNS
from modeviz.files.schema.hints import annotation, fields_of
from modeviz.files.schema.quantities import FixedUnit, Quantity
from modeviz.units import UNITS

PAGE = Path(__file__).parents[2].joinpath("docs/vehicle-folder.md").read_text("utf-8")
ROW = re.compile(r"\| `(\w+)` \| (.+?) \| (.*?) ?\| (.+?) \|$")
PLACE = re.compile(r"`\[*([a-zA-Z_.]+)\]*`")
THE_FILE = "The file itself"


@dataclass(frozen=True)
class Row:
    """What the page says of a key."""

    meaning: str
    quantity: str
    default: str


def rows_of_page() -> dict[str, dict[str, Row]]:
    """By place, such as "mount_group.mount", the keys that the page describes; "" is the file."""
    rows: dict[str, dict[str, Row]] = {}
    places: list[str] = []
    for line in PAGE.splitlines():
        if line.startswith("#"):
            places = [""] if line.endswith(THE_FILE) else PLACE.findall(line)
        elif PLACE.match(line) and not line.strip("`[], abcdefghijklmnopqrstuvwxyzSETGROUP_."):
            places = PLACE.findall(line)
        elif row := ROW.match(line):
            for place in places:
                rows.setdefault(place, {})[row[1]] = Row(row[2], row[3], row[4])
    return rows


def records(kind: Any, place: str = "", level: int = 0) -> Iterator[tuple[str, type]]:
    """Every record that a file can hold, with its place: "rates.SET.GROUP" for the tables of tables."""
    if hasattr(kind, "__struct_fields__"):
        yield place, kind
        for key, hint in fields_of(kind).items():
            yield from records(hint, f"{place}.{key}".lstrip("."))
        return
    if getattr(kind, "__origin__", None) is dict:
        inner = get_args(kind)[1]
        yield from records(inner, f"{place}.{('SET', 'GROUP')[level]}", level + 1)
        return
    for inner in get_args(kind):
        yield from records(inner, place)


PAGE_ROWS = rows_of_page()
RECORDS = dict(records(VehicleRecord))


def test_the_page_has_every_table_and_no_other():
    assert set(PAGE_ROWS) == set(RECORDS)


@pytest.mark.parametrize("place", RECORDS)
def test_the_page_has_every_key_and_no_other(place):
    assert set(PAGE_ROWS[place]) == set(fields_of(RECORDS[place]))


@pytest.mark.parametrize("place", RECORDS)
def test_the_page_names_the_quantity_of_every_key(place):
    for key, hint in fields_of(RECORDS[place]).items():
        quantity = annotation(hint, Quantity)
        known = set(quantity.names) if quantity else set()
        assert set(re.findall(r"`(\w+)`", PAGE_ROWS[place][key].quantity)) == known, key


@pytest.mark.parametrize("place", RECORDS)
def test_the_page_names_every_unit_that_a_file_cannot_choose(place):
    for key, hint in fields_of(RECORDS[place]).items():
        fixed = annotation(hint, FixedUnit)
        if fixed and fixed.name:
            assert re.search(rf"\b{fixed.name}\b", PAGE_ROWS[place][key].meaning), key


def default_of(field: msgspec.structs.FieldInfo) -> Any:
    """What a key that is not given is, as TOML would have it; None where that takes words."""
    value = field.default
    if value is msgspec.NODEFAULT or value == "":
        return None
    return msgspec.to_builtins(value)


@pytest.mark.parametrize("place", RECORDS)
def test_the_page_says_what_a_key_is_that_is_not_given(place):
    for field in msgspec.structs.fields(RECORDS[place]):
        said = PAGE_ROWS[place][field.name].default
        assert (said == "required") == field.required, field.name
        if (default := default_of(field)) is not None:
            value = re.match(r"`(.*?)`", said)
            assert value, f"{field.name}: {said}"
            assert tomllib.loads(f"x = {value[1]}")["x"] == listed(default), field.name


def listed(value: Any) -> Any:
    return [listed(v) for v in value] if isinstance(value, list | tuple) else value


def table_after(heading: str) -> dict[str, list[str]]:
    """The cells of the table below a heading, by the first one."""
    text = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    cells = [[c.strip(" `") for c in line.strip("|").split("|")] for line in text.splitlines()]
    return {first: rest for first, *rest in cells[1:] if rest and not set(first) <= {"-"}}


def test_the_page_has_every_unit():
    table = table_after("Units")
    assert table.pop("quantity")
    assert {quantity: cells[0].split(", ") for quantity, cells in table.items()} == {
        quantity: list(UNITS[quantity]) for quantity in UNITS
    }


def test_the_page_has_every_array_with_its_dimensions():
    table = table_after("Modes")
    assert table.pop("array")
    shapes = {name: re.findall(r"\w+", cells[0]) for name, cells in table.items()}
    assert {name: len(shape) for name, shape in shapes.items()} == {
        name: array.n_dimensions for name, array in ARRAYS.items()
    }


def test_the_page_has_every_column_of_a_road():
    assert tuple(table_after("Road spectra"))[1:] == COLUMNS


def test_the_smallest_vehicle_of_the_page_runs(tmp_path, printed_json):
    """Its bounce is (1/2π) √(4 · 100 N/mm / 100 kg)."""
    text = PAGE.partition("```toml\n")[2].partition("```")[0]
    (tmp_path / "vehicle.toml").write_text(text, encoding="utf-8")
    modes = printed_json("modes", str(tmp_path))["modes"]
    assert len(modes) == 6
    bounce = min(abs(mode["frequency_hz"] - np.sqrt(4e5 / 100) / (2 * np.pi)) for mode in modes)
    assert bounce < 1e-9


def test_the_roads_of_the_page_are_roads(tmp_path):
    """That without data, and the table of a profilometer with its row at zero."""
    text = PAGE.partition("```toml\n")[2].partition("```")[0]
    gravel = '[[road]]\nname = "gravel"' + PAGE.partition('name = "gravel"')[2].partition("```")[0]
    measured = '[[road]]\nname = "measured"\nfile = "measured.csv"\ntrack_width = 1500.0\n'
    table = PAGE.partition('`file = "measured.csv"`:\n\n```\n')[2].partition("```")[0]
    (tmp_path / "vehicle.toml").write_text(f"{text}\n{gravel}\n{measured}", encoding="utf-8")
    (tmp_path / "measured.csv").write_text(table, encoding="utf-8")
    vehicle = read_vehicle(tmp_path)
    assert [road.name for road in vehicle.roads] == ["gravel", "measured"]
    assert vehicle.roads[1].frequency_hz.tolist() == [0.02, 0.5, 4.0]
    notes = "; ".join(vehicle.notes)
    assert "n = 0 is left out" in notes
    assert "without a cross spectrum" in notes


def test_the_smallest_vehicle_of_the_page_can_lose_no_key(tmp_path, capsys):
    text = PAGE.partition("```toml\n")[2].partition("```")[0]
    for line in text.splitlines():
        if " = " in line and "stiffness = [" not in line:
            (tmp_path / "vehicle.toml").write_text(text.replace(line + "\n", "", 1), encoding="utf-8")
            assert main(["modes", str(tmp_path)]) == 2, line
    capsys.readouterr()
