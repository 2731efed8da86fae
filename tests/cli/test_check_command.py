"""`modeviz check` tells all that is wrong with a folder, and what an engineer can hold it against."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from folders import one_of_everything
from mounted_cabin import mounted_cabin
from small_vehicles import on_tyres, wheel

from modeviz.cli import main
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.connections import Tyre


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "truck")
    return tmp_path / "truck"


def edit(folder: Path, old: str, new: str) -> None:
    path = folder / "vehicle.toml"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def test_a_folder_with_mistakes_is_told_all_of_them_with_their_lines_and_ends_with_status_2(
    folder, capsys
):
    edit(folder, "meshes/cab.glb", "meshes/cob.glb")
    edit(folder, "[12.6, 29.6", "[-12.6, 29.6")
    edit(folder, "at = [0.01, -0.02, 0.03]", "at = [0.01, -0.02, 3]")
    assert main(["check", str(folder)]) == 2
    out, err = capsys.readouterr()
    lines = (folder / "vehicle.toml").read_text().splitlines()
    number = next(i for i, line in enumerate(lines, 1) if "cob.glb" in line)
    assert f"1. vehicle.toml, line {number}, flexible_body[0].mesh: meshes/cob.glb: there is no" in out
    assert "2. vehicle.toml" in out
    assert "3. vehicle.toml" in out
    assert "(the rest is read without rigid_body[0])" in out
    assert "What can be read so far:" in out
    assert "cab" in out.split("centre of gravity")[1]
    assert err == f"modeviz: {folder}: 3 problems to put right\n"


def test_a_sound_vehicle_is_summed_up_with_status_0(tmp_path, capsys):
    write_vehicle(mounted_cabin(), tmp_path / "a")
    assert main(["check", str(tmp_path / "a")]) == 0
    out, err = capsys.readouterr()
    assert "no problems, no doubts" in out
    rows = {line.split()[0]: line.split()[1:] for line in out.splitlines() if line}
    center = (300 * np.array([1.2, 0.1, 1.0]) + 900 * np.array([1.25, 0, 0.5])) / 1200
    assert rows["all"] == ["1200", *(f"{x:.3f}," for x in center[:2]), f"{center[2]:.3f}"]
    assert "All 2 bodies hang together; they hold on to the ground." in out
    assert "no mechanisms" in out
    assert not err


def test_doubts_are_told_and_are_no_error(tmp_path, capsys):
    write_vehicle(one_of_everything(), tmp_path / "a")
    edit(tmp_path / "a", "damping_ratio = 0.03", "damping_ratio = 0.03\nmass = 400.0")
    assert main(["check", str(tmp_path / "a")]) == 0
    out, _ = capsys.readouterr()
    assert "no problems" in out
    assert (
        "doubt: body 'cab': its rigid modes say that it weighs 300 kg, its mass is stated as 400" in out
    )


def test_a_road_that_no_tyre_lets_in_is_doubted(tmp_path, capsys):
    driven = mounted_cabin()
    no_tyre = [connection for connection in driven.connections if not isinstance(connection, Tyre)]
    held = replace(driven, connections=tuple(no_tyre), wheel_loads=())
    write_vehicle(held, tmp_path / "held")
    assert main(["check", str(tmp_path / "held")]) == 0
    words = f"doubt: road {driven.roads[0].name!r}: does nothing, as the vehicle has no [[tyre]]"
    assert words in capsys.readouterr().out


def test_json_has_problems_doubts_and_the_summary(folder, capsys):
    edit(folder, "bodies/cab.npz", "bodies/cob.npz")
    assert main(["check", "--json", str(folder)]) == 2
    record = json.loads(capsys.readouterr().out)
    (problem,) = record["problems"]
    assert problem["key"] == "flexible_body[0].modes"
    assert problem["left_out"] == "flexible_body[0]"
    assert problem["line"] > 0
    assert [body["name"] for body in record["summary"]["bodies"]] == ["Engine & box"]
    assert record["summary"]["total"]["mass"] == pytest.approx(240.5)


def test_flexible_bodies_have_their_first_modes_and_how_orthogonal_the_rigid_ones_are(folder, capsys):
    assert main(["check", "--json", str(folder)]) == 0
    summary = json.loads(capsys.readouterr().out)["summary"]
    cab, engine = summary["bodies"]
    known = read_vehicle(folder).body("cab")
    assert cab["first_hz"] == pytest.approx(known.natural_frequency_hz[6:9])
    assert cab["mass"] == pytest.approx(300 + 75)  # with the driver
    assert 0 <= cab["orthogonality_error"] < 1e-9
    assert summary["largest_orthogonality_error"] == cab["orthogonality_error"]
    assert engine["first_hz"] == []
    farthest = summary["connections"][0]
    assert farthest["connection"] == "arm" or farthest["distance"] == 0


def test_a_mechanism_and_what_is_isolated_are_named(tmp_path, capsys):
    write_vehicle(mounted_cabin(), tmp_path / "a")
    path = tmp_path / "a" / "vehicle.toml"
    loose = '[[rigid_body]]\nname = "spare"\nmass = 20\ncenter_of_gravity = [4, 0, 1]\n'
    loose += "inertia = [1, 1, 1]\n"
    arm = loose.replace("spare", "arm").replace("[4, 0, 1]", "[2, 0, 0.5]")
    ball = (
        '[[spring]]\nname = "ball"\nbodies = ["arm", "chassis"]\nat = [2, 0, 0.5]\n'
        "rigid = ['x', 'y', 'z']\n"
    )
    path.write_text(path.read_text() + loose + arm + ball)
    assert main(["check", str(tmp_path / "a")]) == 0
    out, _ = capsys.readouterr()
    assert "'spare' is isolated: no other body is connected to it, nor is the ground." in out
    assert "'spare' is free as a whole: it moves along x, y, z and turns about x, y, z." in out
    for axis in "xyz":
        assert f"Mechanism: 'arm' turns about {axis}, and nothing holds it." in out


@pytest.mark.parametrize(
    ("connections", "words"), [(True, "and connected"), (False, "and not connected")]
)
def test_a_single_body_is_not_called_isolated(tmp_path, capsys, connections, words):
    vehicle = on_tyres(wheel("w")).vehicle
    write_vehicle(vehicle if connections else replace(vehicle, connections=()), tmp_path / "a")
    assert main(["check", str(tmp_path / "a")]) == 0
    out, _ = capsys.readouterr()
    assert f"'w' is the only body, {words} to the ground." in out
    assert "isolated" not in out


def test_the_front_is_told_with_the_reason(capsys):
    assert main(["check"]) == 0
    out, _ = capsys.readouterr()
    assert "The front is where x is least: 'front left' is before 'rear left'" in out


def test_a_folder_without_a_vehicle_file_is_one_problem(tmp_path, capsys):
    assert main(["check", str(tmp_path)]) == 2
    out, err = capsys.readouterr()
    assert "found no vehicle.toml" in out
    assert "Traceback" not in err
