"""Mount rates as people write them."""

import json
from pathlib import Path

import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.tuning.rates import parse_setting, read_rates, resolve_rates, write_rates
from modeviz.vehicle.connections import MountRates

VEHICLE = one_of_everything()
RATES = VEHICLE.rates["C1"]


def saved(tmp_path: Path, name: str, text: str) -> Path:
    (tmp_path / name).write_text(text)
    return tmp_path / name


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("C1.lateral=131 N/mm", MountRates(RATES.vertical, 131e3, RATES.fore_aft)),
        ("C1.vertical = 1310 N/cm", MountRates(131e3, RATES.lateral, RATES.fore_aft)),
        ("C1.fore-aft=0.5kN/mm", MountRates(RATES.vertical, RATES.lateral, 5e5)),
        (" C1.fore_aft=5e5 N/m", MountRates(RATES.vertical, RATES.lateral, 5e5)),
    ],
)
def test_setting_changes_one_direction_of_one_group(text, expected):
    assert parse_setting(text, VEHICLE) == {"C1": expected}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("C2.lateral=131 N/mm", "unknown mount group 'C2': there are C1"),
        ("C1.sideways=131 N/mm", "there are vertical, lateral, fore-aft"),
        ("C1.lateral=131", "without a unit, expected one of N/m, N/mm"),
        ("C1.lateral=131 kg", "unknown unit of stiffness 'kg'"),
        ("C1.lateral=-131 N/mm", "found -131000.0 N/m, expected zero or more"),
        ("C1.lateral=nan N/mm", "expected a number and a unit"),
        ("C1.lateral=1e308 N/mm", "expected a finite number"),
        ("C1.lateral=soft", "expected a number and a unit"),
        ("C1=131 N/mm", "expected GROUP.DIRECTION=RATE UNIT"),
        ("C1.lateral", "expected GROUP.DIRECTION=RATE UNIT"),
        ("", "expected GROUP.DIRECTION=RATE UNIT"),
    ],
)
def test_wrong_setting_is_explained(text, words):
    with pytest.raises(VehicleError) as caught:
        parse_setting(text, VEHICLE)
    assert str(caught.value).startswith(f"setting {text!r}: ")
    assert words in str(caught.value)


def test_original_rates_are_the_vehicles_own():
    assert resolve_rates(VEHICLE, "original").rates == VEHICLE.rates


def test_settings_change_the_chosen_set_one_after_the_other():
    settings = ("C1.lateral=10 N/mm", "C1.vertical=20 N/mm", "C1.lateral=30 N/mm")
    rates = resolve_rates(VEHICLE, "optimised", settings).rates
    assert rates == {"C1": MountRates(2e4, 3e4, VEHICLE.rate_sets["optimised"]["C1"].fore_aft)}


@pytest.mark.parametrize("name", ["mine.json", "mine.csv"])
def test_written_rates_come_back_to_the_last_bit(tmp_path, name):
    rates = {"C1": MountRates(1e6 / 3, 131000.0, 0.1 + 0.2)}
    write_rates(tmp_path / name, rates)
    assert read_rates(tmp_path / name, VEHICLE) == rates
    assert resolve_rates(VEHICLE, str(tmp_path / name)).rates == rates


def test_file_of_rates_is_in_the_units_it_names(tmp_path):
    rates = {"vertical": 1094, "lateral": 6700.5, "fore_aft": 0}
    text = json.dumps({"units": "N/cm", "rates": {"C1": rates}})
    found = read_rates(saved(tmp_path, "a.json", text), VEHICLE)
    assert found == {"C1": MountRates(109400.0, 670050.0, 0.0)}
    text = "group,units,vertical,lateral,fore_aft\nC1,N/cm,1094,6700.5,0\n"
    assert read_rates(saved(tmp_path, "a.csv", text), VEHICLE) == found


def test_unknown_choice_lists_the_sets_there_are():
    with pytest.raises(VehicleError, match=r"there are original, optimised, or give a \.json or \.csv"):
        resolve_rates(VEHICLE, "optimized set")
    with pytest.raises(VehicleError, match="did you mean 'optimised'"):
        resolve_rates(VEHICLE, "optimized")


ROW = '{"vertical": 1, "lateral": 2, "fore_aft": 3}'
HEADER = "group,units,vertical,lateral,fore_aft\n"


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.json", f'{{"rates": {{"C1": {ROW}}}}}', "units: unknown unit of stiffness ''"),
        ("a.json", f'{{"units": "kg", "rates": {{"C1": {ROW}}}}}', "units: unknown unit of stiffness"),
        ("a.json", f'{{"units": "N/m", "rates": {{"X": {ROW}}}}}', "unknown mount group 'X'"),
        ("a.json", '{"units": "N/m", "rates": {"C1": {"vertical": 1}}}', "rates.C1.lateral: missing"),
        (
            "a.json",
            f'{{"units": "N/m", "rates": {{"C1": {ROW.replace("2", "-2")}}}}}',
            "rates.C1.lateral: found -2, expected a number of zero or more",
        ),
        (
            "a.json",
            f'{{"units": "N/m", "rates": {{"C1": {ROW.replace("2", "NaN")}}}}}',
            "rates.C1.lateral: found nan, expected a finite number",
        ),
        ("a.json", '{"units": "N/m", "rates": [1]}', "rates: found [1], expected a table"),
        ("a.json", '{"units": "N/m", "ra', "not JSON"),
        ("a.json", "[" * 100_000, "not JSON"),
        ("a.json", "[]", "found [], expected a table"),
        ("a.csv", "", "line 1: found ''"),
        ("a.csv", "group,vertical\nC1,1\n", "line 1: found 'group,vertical', expected group,units"),
        ("a.csv", HEADER + "C1,N/m,1,2\n", "line 2: found 4 cells, expected 5"),
        ("a.csv", HEADER + "C1,N/m,1,2,soft\n", "line 2: fore_aft: found 'soft', expected a number"),
        ("a.csv", HEADER + "C1,,1,2,3\n", "line 2: units: unknown unit of stiffness ''"),
        ("a.csv", HEADER + "C1,N/m,1,2,3\nC1,N/m,1,2,3\n", "mount group 'C1' is there twice"),
        ("a.csv", HEADER + '"C1,N/m,1,2,3\n', "not CSV"),
        ("a.txt", "", "expected a file of rates, .json or .csv"),
    ],
)
def test_wrong_file_of_rates_is_explained(tmp_path, name, text, words):
    path = saved(tmp_path, name, text)
    with pytest.raises(VehicleError) as caught:
        resolve_rates(VEHICLE, str(path))
    assert str(caught.value).startswith(f"{path}: ")
    assert words in str(caught.value)


def test_missing_file_of_rates_is_named():
    with pytest.raises(VehicleError, match=r"^nowhere\.json: there is no such file$"):
        resolve_rates(VEHICLE, "nowhere.json")


def test_rates_cannot_be_written_into_no_folder(tmp_path):
    with pytest.raises(VehicleError, match="cannot be written"):
        write_rates(tmp_path / "nowhere" / "a.json", VEHICLE.rates)
