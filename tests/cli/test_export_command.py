"""`modeviz export`: what it writes, and what it refuses."""

import json
from dataclasses import replace

import pytest
from bulk_data import bulk_data
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.rate_files import read_rates


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """The folder where files are written, and nothing else is."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_rates_are_those_asked_for_and_read_again(folder, here, capsys):
    arguments = ["--rates", "soft", "--set", "B.loss_factor=0.3"]
    assert main(["export", folder, "soft-rates.csv", "rates.json", *arguments]) == 0
    assert capsys.readouterr().out == "soft-rates.csv\nrates.json\n"
    vehicle = read_vehicle(folder)
    for name in ("soft-rates.csv", "rates.json"):
        rates = vehicle.all_rates(read_rates(here / name, vehicle))
        assert rates["A"] == vehicle.rate_sets["soft"]["A"]
        assert rates["B"].loss_factor == 0.3
        assert rates["B"].as_tuple() == vehicle.rates["B"].as_tuple()
    assert json.loads((here / "rates.json").read_text())["units"] == "N/mm"


@pytest.mark.parametrize("ending", ["bdf", "dat", "nas"])
def test_cards_have_the_rates_asked_for(folder, here, ending):
    arguments = ["--rates", "soft", "--units", "m-kg-s", "--first-id", "501"]
    assert main(["export", folder, f"rates.{ending}", *arguments]) == 0
    cards = bulk_data((here / f"rates.{ending}").read_text("ascii"))
    (front, _) = [card for card in cards if card[0] == "PBUSH"]
    assert front[:6] == ["PBUSH", 501, "K", 1e5, 1e5, 2e5]


def test_the_built_in_pickup_needs_no_name(here, capsys):
    assert main(["export", "rates.csv", "rates.bdf"]) == 0
    assert {path.name for path in here.iterdir()} == {"rates.csv", "rates.bdf"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["rates.vtu"], "found 'rates.vtu', expected rates as one of .csv, .json, .bdf"),
        (
            ["mode.unv"],
            "found 'mode.unv', expected a name that ends in what the file is to have: ",
        ),
        (["integrates.csv"], "expected a name that ends in what"),
        (["rates.bdf", "--units", "mm"], "--units: found 'mm', expected one of m-kg-s, mm-t-s"),
        (["rates.bdf", "--first-id", "0"], "--first-id: found 0, expected 1 to 99000000"),
        (["rates.bdf", "--below", "nan"], "--below: found nan Hz"),
        (["rates.csv", "no-folder/rates.csv"], "there is no folder"),
        (["rates.csv", "--rates", "hard"], "there are original, soft, or give"),
        (["rates.csv", "--road", "moon"], "unknown random load 'moon'"),
    ],
)
def test_what_cannot_be_written_is_one_message_and_leaves_nothing(
    folder, here, capsys, arguments, message
):
    assert main(["export", folder, *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("modeviz: ")
    assert captured.err.count("\n") == 1
    assert message in captured.err
    assert not list(here.iterdir())


def test_a_vehicle_without_mounts_has_no_rates_to_write(here, capsys):
    write_vehicle(replace(mounted_cabin(), mount_groups=(), rate_sets={}), here / "bare")
    assert main(["export", "bare", "rates.bdf"]) == 2
    assert "has no mount group: give its vehicle.toml a [[mount_group]]" in capsys.readouterr().err
    assert not (here / "rates.bdf").exists()
