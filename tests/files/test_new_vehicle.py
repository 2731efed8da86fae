"""Folders to begin with: what they hold opens and makes sense at once, and nothing is overwritten."""

from typing import get_args

import numpy as np
import pytest

import modeviz as mv
from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files.new_vehicle import Kind, new_vehicle

EXPECTED = {
    "powertrain": ("engine", 6, (4, 15)),
    "cab": ("cab", 6, (0.7, 8)),
    "cab-on-frame": ("cab", 12, (0.7, 8)),
    "machine": ("machine", 6, (2, 15)),
}
"""By kind the body that is mounted, how many rigid modes there are, and the band of them all, Hz."""


@pytest.mark.parametrize("kind", get_args(Kind))
def test_what_is_new_has_rigid_modes_that_are_called_after_their_bodies(tmp_path, kind):
    body, count, (low, high) = EXPECTED[kind]
    study = mv.Study(new_vehicle(kind, tmp_path / "mine"))
    assert not study.vehicle.notes
    modes = [*study.modes()]
    assert len(modes) == count
    assert all(low < mode.frequency_hz < high for mode in modes)
    assert any(mode.name.startswith(f"{body} ") for mode in modes)
    if count == 6:
        motions = ("fore-aft", "lateral", "bounce", "roll", "pitch", "yaw")
        assert {mode.name for mode in modes} == {f"{body} {motion}" for motion in motions}


@pytest.mark.parametrize("kind", get_args(Kind))
def test_the_command_writes_it_and_a_check_finds_nothing_wrong(tmp_path, kind, capsys):
    assert main(["new", kind, str(tmp_path / "mine")]) == 0
    assert "modeviz view" in capsys.readouterr().out
    assert main(["check", str(tmp_path / "mine")]) == 0
    assert "no problems, no doubts" in capsys.readouterr().out


def test_a_cab_is_felt_at_its_seat(tmp_path):
    for kind in ("cab", "cab-on-frame"):
        study = mv.Study(new_vehicle(kind, tmp_path / kind))
        assert np.isfinite(study.ride().rms(study.points[0], "vertical"))


def test_a_machine_neither_brakes_nor_corners(tmp_path, printed_json):
    """It is set down by a crane, pushed as by an earthquake, and turned by its own motor."""
    cases = printed_json("static", str(new_vehicle("machine", tmp_path / "mine")))["cases"]
    assert [case["name"] for case in cases] == [
        "standing",
        "set down 2 g",
        "pushed along 0.3 g",
        "pushed across 0.3 g",
        "start",
    ]
    standing, down = (case["bodies"]["machine"][2] for case in cases[:2])
    assert down == pytest.approx(2 * standing)


def test_only_what_has_a_crank_is_told_of_one(tmp_path, capsys):
    said = {}
    for kind in get_args(Kind):
        assert main(["rigid", str(new_vehicle(kind, tmp_path / kind)), "--axes", "crank"]) == 0
        said[kind] = capsys.readouterr().out
    assert "crank axes" in said["powertrain"]
    assert "bounce to crank gap" in said["powertrain"]
    for kind in ("cab", "cab-on-frame", "machine"):
        assert "crank" not in said[kind]
        assert "axes along the torque" in said[kind]
        assert "bounce to roll gap" in said[kind] or "bounce to pitch gap" in said[kind]


def test_nothing_is_overwritten(tmp_path, capsys):
    (tmp_path / "mounts.csv").write_text("mine")
    assert main(["new", "cab", str(tmp_path)]) == 2
    assert "there is 'mounts.csv' in it already, and nothing is overwritten" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["mounts.csv"]
    assert (tmp_path / "mounts.csv").read_text() == "mine"
    with pytest.raises(VehicleError, match="is a file, and nothing is overwritten"):
        new_vehicle("cab", tmp_path / "mounts.csv")


def test_a_kind_that_is_not_there_is_told_with_those_that_are():
    with pytest.raises(VehicleError, match=r"unknown kind of vehicle .engine.: .*powertrain, cab"):
        new_vehicle("engine", "nowhere")  # type: ignore[arg-type]
