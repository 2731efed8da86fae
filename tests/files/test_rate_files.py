"""Sets of mount rates as files and as their text."""

import json
from pathlib import Path

import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.files.rate_files import parse_rates, rates_text, read_rates, write_rates
from modeviz.vehicle.mount_rates import MountRates

VEHICLE = one_of_everything()


def saved(tmp_path: Path, name: str, text: str) -> Path:
    (tmp_path / name).write_text(text)
    return tmp_path / name


@pytest.mark.parametrize("loss_factor", [None, 0.0, 0.1 + 0.2])
@pytest.mark.parametrize("file_format", ["json", "csv"])
def test_written_rates_come_back_to_the_last_bit(tmp_path, file_format, loss_factor):
    rates = {"C1": MountRates(1e6 / 3, 131000.0, 0.1 + 0.2, loss_factor)}
    write_rates(tmp_path / f"mine.{file_format}", rates)
    assert read_rates(tmp_path / f"mine.{file_format}", VEHICLE) == rates
    assert parse_rates(rates_text(rates, file_format), file_format, VEHICLE) == rates


@pytest.mark.parametrize("file_format", ["json", "csv"])
def test_a_loss_factor_is_written_only_where_there_is_one(file_format):
    plain, lossy = MountRates(1e3, 2e3, 3e3), MountRates(4e3, 5e3, 6e3, 0.25)
    assert "loss_factor" not in rates_text({"C1": plain}, file_format)
    text = rates_text({"C1": plain, "C2": lossy}, file_format)
    if file_format == "csv":
        rows = text.splitlines()
        assert rows[0] == "group,units,vertical,lateral,fore_aft,loss_factor"
        assert rows[1:] == ["C1,N/mm,1.0,2.0,3.0,", "C2,N/mm,4.0,5.0,6.0,0.25"]
    else:
        groups = json.loads(text)["rates"]
        assert groups["C1"] == {"vertical": 1.0, "lateral": 2.0, "fore_aft": 3.0}
        assert groups["C2"]["loss_factor"] == 0.25


def test_an_empty_cell_is_no_loss_factor():
    found = parse_rates(LOSS_HEADER + "C1,N/mm,1,2,3,\n", "csv", VEHICLE)
    assert found == {"C1": MountRates(1e3, 2e3, 3e3)}


def test_a_spreadsheets_byte_order_mark_and_line_ends_are_accepted():
    text = "\ufeff" + HEADER.replace("\n", "\r\n") + "C1,N/mm,1,2,3\r\n"
    assert parse_rates(text, "csv", VEHICLE) == {"C1": MountRates(1e3, 2e3, 3e3)}


def test_file_of_rates_is_in_the_units_it_names(tmp_path):
    rates = {"vertical": 1094, "lateral": 6700.5, "fore_aft": 0}
    text = json.dumps({"units": "N/cm", "rates": {"C1": rates}})
    found = read_rates(saved(tmp_path, "a.json", text), VEHICLE)
    assert found == {"C1": MountRates(109400.0, 670050.0, 0.0)}
    text = "group,units,vertical,lateral,fore_aft\nC1,N/cm,1094,6700.5,0\n"
    assert read_rates(saved(tmp_path, "a.csv", text), VEHICLE) == found


ROW = '{"vertical": 1, "lateral": 2, "fore_aft": 3}'
HEADER = "group,units,vertical,lateral,fore_aft\n"
LOSS_HEADER = HEADER.replace("\n", ",loss_factor\n")


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
            "rates.C1.lateral: found nan, expected a finite number below 1e+100",
        ),
        ("a.json", '{"units": "N/m", "rates": [1]}', "rates: found [1], expected a table"),
        ("a.json", '{"units": "N/m", "ra', "not JSON"),
        ("a.json", "[" * 100_000, "not JSON"),
        ("a.json", "[]", "found [], expected a table"),
        ("a.csv", "", "line 1: found ''"),
        (
            "a.csv",
            "group,vertical\nC1,1\n",
            "line 1: found 'group,vertical', without lateral",
        ),
        ("a.csv", HEADER + "C1,N/m,1,2\n", "line 2: found 4 cells, expected 5"),
        (
            "a.csv",
            HEADER + "C1,N/m,1,2,soft\n",
            "line 2, column fore_aft: found 'soft', expected",
        ),
        ("a.csv", LOSS_HEADER + "C1,N/m,1,2,3\n", "line 2: found 5 cells, expected 6"),
        (
            "a.csv",
            LOSS_HEADER + "C1,N/m,1,2,3,x\n",
            "line 2, column loss_factor: found 'x', expected a number",
        ),
        (
            "a.csv",
            LOSS_HEADER + "C1,N/m,1,2,3,-1\n",
            "line 2, column loss_factor: found -1, expected zero or more",
        ),
        (
            "a.json",
            f'{{"units": "N/m", "rates": {{"C1": {ROW[:-1]}, "loss_factor": -1}}}}}}',
            "rates.C1.loss_factor: found -1, expected a number of zero or more",
        ),
        ("a.csv", HEADER + "C1,,1,2,3\n", "line 2, column units: unknown unit of stiffness ''"),
        ("a.csv", HEADER + "C1,N/m,1,2,3\nC1,N/m,1,2,3\n", "mount group 'C1' is there twice"),
        ("a.csv", HEADER + '"C1,N/m,1,2,3\n', "not CSV"),
        ("a.txt", "", "expected a file of rates, .json or .csv"),
    ],
)
def test_wrong_file_of_rates_is_explained(tmp_path, name, text, words):
    path = saved(tmp_path, name, text)
    with pytest.raises(VehicleError) as caught:
        read_rates(path, VEHICLE)
    assert str(caught.value).startswith(f"{path}: ")
    assert words in str(caught.value)


def test_missing_file_of_rates_is_named():
    with pytest.raises(VehicleError, match=r"^nowhere\.json: there is no such file$"):
        read_rates(Path("nowhere.json"), VEHICLE)


def test_rates_cannot_be_written_into_no_folder(tmp_path):
    with pytest.raises(VehicleError, match="cannot be written"):
        write_rates(tmp_path / "nowhere" / "a.json", VEHICLE.rates)
    with pytest.raises(VehicleError, match=r"found '\.txt', expected a file of rates, \.json or \.csv"):
        write_rates(tmp_path / "a.txt", VEHICLE.rates)


def test_a_file_without_rates_needs_no_unit():
    assert parse_rates('{"rates": {}}', "json", VEHICLE) == {}
