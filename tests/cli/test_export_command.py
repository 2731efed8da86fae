"""`modeviz export`: what it writes, and what it refuses."""

import json
from dataclasses import replace

import numpy as np
import pytest
import pyuff
from bulk_data import bulk_data
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.errors import SolveError
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


def test_a_file_that_is_there_is_replaced_whole_and_a_folder_is_not(folder, here, capsys):
    (here / "rates.csv").write_text("of last week")
    (here / "mounts.csv").mkdir()
    assert main(["export", folder, "rates.csv", "mounts.csv"]) == 2
    assert "found a folder or device" in capsys.readouterr().err
    assert (here / "rates.csv").read_text() == "of last week"
    assert main(["export", folder, "rates.csv"]) == 0
    assert (here / "rates.csv").read_text().startswith("group,units")


def test_one_file_is_not_written_twice(folder, here, capsys):
    assert main(["export", str(folder), "rates.csv", "rates.json", "./rates.csv"]) == 2
    assert "rates.csv: found twice, expected each file once" in capsys.readouterr().err
    assert not [*here.glob("rates.*")]


def test_a_vehicle_after_its_files_is_said_to_come_first(folder, here, capsys):
    (here / "pick up").mkdir()
    assert main(["export", "rates.csv", "pick up"]) == 2
    words = "pick up: is a folder; that of the vehicle comes first: modeviz export 'pick up' rates.csv"
    assert words in capsys.readouterr().err


def test_a_file_that_fails_leaves_the_one_that_is_there(folder, here, monkeypatch, capsys):
    (here / "modes.unv").write_text("of last week")

    def fail(*_):
        raise SolveError("an undamped resonance lies on 10 Hz")

    monkeypatch.setattr("modeviz.study.exporting.solve_modal", fail)
    assert main(["export", folder, "modes.unv"]) == 2
    assert capsys.readouterr().err == "modeviz: an undamped resonance lies on 10 Hz\n"
    assert [path.name for path in here.iterdir()] == ["modes.unv"]
    assert (here / "modes.unv").read_text() == "of last week"


def test_interrupting_leaves_nothing_behind(folder, here, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("modeviz.export.universal.modes.nodes", interrupt)
    assert main(["export", folder, "rates.csv", "modes.unv"]) == 130
    assert [path.name for path in here.iterdir()] == ["rates.csv"]


def test_modes_that_do_not_vibrate_are_left_out_of_complex_ones_and_told(here, capsys):
    cabin = mounted_cabin()
    damped = tuple(replace(c, damping=np.full(3, 1e6)) for c in cabin.connections)
    groups = tuple(replace(group, loss_factor=0.0) for group in cabin.mount_groups)
    write_vehicle(replace(cabin, connections=damped, mount_groups=groups), here / "stiff")
    assert main(["export", "stiff", "complex-modes.uff"]) == 0
    assert "does not vibrate: it is left out" in capsys.readouterr().err
    kept = [s for s in pyuff.UFF(str(here / "complex-modes.uff")).get_set_types() if s == 55]
    assert 0 < len(kept) < 12


@pytest.mark.parametrize("name", ["psd.csv", "frf.uff", "cab.vtu", "complex-modes.npz", "Bodies.VTU"])
def test_whatever_can_be_written_is(folder, here, name):
    assert main(["export", folder, name, "--road", "rough", "--speed", "90 km/h"]) == 0
    assert (here / name).stat().st_size > 100


def test_a_vehicle_without_mounts_has_no_rates_to_write(here, capsys):
    write_vehicle(replace(mounted_cabin(), mount_groups=(), rate_sets={}), here / "bare")
    assert main(["export", "bare", "rates.bdf"]) == 2
    assert "has no mount group: give its vehicle.toml a [[mount_group]]" in capsys.readouterr().err
    assert not (here / "rates.bdf").exists()
