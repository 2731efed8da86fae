"""`modeviz rigid` and the study's answer."""

import json
from dataclasses import replace

import numpy as np
import pytest
from four_cylinder import ELASTIC_TORQUE, ENERGY, TORQUE_ROLL, four_cylinder, on_subframe

import modeviz as mv
from modeviz.cli import main
from modeviz.errors import ModevizError, VehicleError


@pytest.fixture(scope="module")
def engine_folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("engine")
    mv.write_vehicle(four_cylinder(), folder)
    return str(folder)


def printed(capsys, *arguments):
    assert main(["rigid", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_json_has_the_study_s_numbers(capsys, engine_folder):
    body = printed(capsys, engine_folder)["bodies"]["engine"]
    assert 100 * np.array(body["energy"]) == pytest.approx(np.array(ENERGY), abs=0.1)
    assert body["torque_roll_axis"] == pytest.approx(TORQUE_ROLL, abs=5e-5)
    assert body["elastic_torque_axis"] == pytest.approx(ELASTIC_TORQUE, abs=5e-5)
    assert body["angle_deg"] == pytest.approx(12.041, abs=5e-4)
    assert body["elastic_center"] == body["held"]["elastic_center"]
    assert body["own_modes"] == {"x": 2, "y": 1, "z": 4, "rx": 5, "ry": 6, "rz": 3}
    assert body["passes"] is False
    assert body["focus"] is None


def test_rates_are_those_asked_for(capsys, engine_folder):
    changed = printed(capsys, engine_folder, "--set", "M1.vertical=900 N/mm")
    assert changed["rates"]["M1"]["vertical"] == pytest.approx(900)
    plain = printed(capsys, engine_folder)
    assert changed["frequency_hz"] != plain["frequency_hz"]
    assert changed["bodies"]["engine"]["elastic_center"] != plain["bodies"]["engine"]["elastic_center"]


def test_along_other_axes_energies_have_the_same_sums(capsys, tmp_path):
    mv.write_vehicle(on_subframe(), tmp_path)
    sums = [
        np.sum(printed(capsys, str(tmp_path), "--axes", axes)["bodies"]["subframe"]["energy"], axis=1)
        for axes in ("vehicle", "principal", "crank")
    ]
    assert sums[0] == pytest.approx(sums[1])
    assert sums[0] == pytest.approx(sums[2])


def test_the_table_says_what_fails_and_where_the_axes_are(capsys, engine_folder):
    assert main(["rigid", engine_folder]) == 0
    out = capsys.readouterr().out
    assert "purity 85.0 %: fail (z 49.5 %, rz 48.9 %)" in out
    assert "5 to 30 Hz: fail (ry at 31.43 Hz)" in out
    assert "gap 1.5 Hz: pass" in out
    assert "-0.1320 0.9912 -0.0123" in out
    assert "12.041" in out


def test_only_the_bodies_asked_for_are_told(capsys, tmp_path):
    mv.write_vehicle(on_subframe(), tmp_path)
    assert set(printed(capsys, str(tmp_path))["bodies"]) == {"engine", "subframe"}
    assert set(printed(capsys, str(tmp_path), "--body", "engine")["bodies"]) == {"engine"}


def test_modes_above_the_band_are_looked_for_if_asked(capsys, tmp_path):
    mv.write_vehicle(replace(four_cylinder(), highest_frequency=25.0), tmp_path)
    assert printed(capsys, str(tmp_path))["bodies"]["engine"]["own_modes"]["ry"] is None
    assert main(["rigid", str(tmp_path)]) == 0
    assert "no mode of its own in the band: ry" in capsys.readouterr().out
    higher = printed(capsys, str(tmp_path), "--up-to", "40")
    assert higher["bodies"]["engine"]["own_modes"]["ry"] == 6


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--body", "engin"), "engine"),
        (("--up-to", "-3"), "--up-to: found -3 Hz, expected more than zero"),
    ],
)
def test_what_cannot_be_told_is_one_sentence(capsys, engine_folder, arguments, words):
    assert main(["rigid", engine_folder, *arguments]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert len(error.strip().splitlines()) == 1


def test_a_study_gives_what_the_command_prints(capsys, engine_folder):
    study = mv.Study(engine_folder)
    rigid = study.rigid()
    assert json.loads(json.dumps(rigid.to_dict())) == printed(capsys, engine_folder)
    engine = rigid["engine"]
    assert engine.purity["y"] == pytest.approx(0.985, abs=5e-4)
    assert engine.frequency_hz["ry"] == pytest.approx(31.4272, abs=5e-5)
    assert not engine.passes
    assert engine.held.center == pytest.approx(engine.mounted.center)
    assert engine.torque_roll_axis == pytest.approx(TORQUE_ROLL, abs=5e-5)
    assert engine.focus is None
    assert engine.energy.sum(axis=1) == pytest.approx(engine.share)
    assert rigid.names == ("engine",)
    assert [body.name for body in rigid] == ["engine"]
    assert "purity 85.0 %" in repr(rigid)
    assert "98.5" in rigid._repr_html_()


def test_a_study_refuses_what_there_is_not(engine_folder):
    study = mv.Study(engine_folder)
    with pytest.raises(ModevizError, match="crank"):
        study.rigid("cranc")
    with pytest.raises(ModevizError, match="up_to_hz"):
        study.rigid(up_to_hz=0.0)
    with pytest.raises(VehicleError, match="engine"):
        study.rigid()["motor"]


def test_a_body_without_modes_of_its_own_passes_nothing():
    study = mv.Study(replace(four_cylinder(), mount_groups=()))
    text = study.rigid().table()
    assert "no mode of its own in the band: x, y, z, rx, ry, rz" in text
    assert "pass" not in text
    assert not study.rigid()["engine"].passes
