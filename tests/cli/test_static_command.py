"""`modeviz static`: load cases by name, limits of travel, and what has no answer."""

from dataclasses import replace

import pytest
from engine_on_mounts import engine_on_mounts, limited_engine
from progressive_block import progressive_block
from small_systems import block

from modeviz.cli import main
from modeviz.files import write_vehicle
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle


@pytest.fixture(scope="module")
def engine(tmp_path_factory):
    folder = tmp_path_factory.mktemp("vehicles") / "engine"
    write_vehicle(limited_engine(), folder)
    return str(folder)


def test_the_sag_of_an_engine_is_printed_in_millimetres(tmp_path, capsys):
    write_vehicle(engine_on_mounts(), tmp_path / "engine")
    assert main(["static", str(tmp_path / "engine"), "--case", "standing"]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["engine", "0.074", "0.049", "−1.238"] in [row[:4] for row in rows]
    assert ["M1", "−14.9", "−3.7", "392.8"] in [row[:4] for row in rows]


def test_travel_beyond_a_limit_has_failed_by_so_much(engine, printed_json, capsys):
    standing, bump = printed_json("static", engine)["cases"]
    by_mount = {(t["mount"], t["direction"]): t for t in standing["travel"]}
    assert list(by_mount) == [("M1", "vertical"), ("M1", "lateral"), ("M3", "vertical")]
    m3 = by_mount["M3", "vertical"]
    assert m3["deflection"] == standing["mounts"]["M3"]["deflection"][2]
    assert m3["margin"] == pytest.approx(m3["deflection"] + 0.001)
    assert not m3["passed"]
    m1 = by_mount["M1", "lateral"]
    assert m1["passed"]
    assert m1["margin"] == pytest.approx(0.001 - abs(m1["deflection"]))
    assert bump["mounts"]["M3"]["force"][2] == pytest.approx(3 * standing["mounts"]["M3"]["force"][2])
    assert main(["static", engine]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines() if "M3 vertical" in line]
    assert [row[-1] for row in rows] == ["failed", "failed"]


def test_rates_that_are_set_change_the_sag(engine, printed_json):
    soft = printed_json("static", engine, "--set", "M3.vertical=130 N/mm", "--case", "standing")
    own = printed_json("static", engine, "--case", "standing")
    assert [case["name"] for case in own["cases"]] == ["standing"]
    z = [record["cases"][0]["bodies"]["engine"][2] for record in (own, soft)]
    assert z[1] < z[0] < 0


@pytest.mark.parametrize(
    ("case", "words"),
    [
        ("push", "load case 'push': nothing holds 'loose' along z, so it falls and nothing is loaded"),
        ("bump 3g", "unknown load case 'bump 3g': did you mean 'bump 3 g'? there are standing, bump"),
    ],
)
def test_a_case_without_an_answer_ends_with_a_sentence(engine, case, words, capsys):
    assert main(["static", engine, "--case", case]) == 2
    assert words in capsys.readouterr().err


def test_a_case_without_an_answer_does_not_keep_the_others_back(engine, capsys):
    assert main(["static", engine]) == 0
    assert "push: no answer, nothing holds 'loose' along z" in capsys.readouterr().out


def test_a_vehicle_that_nothing_holds_is_refused_in_its_file(tmp_path, capsys):
    write_vehicle(Vehicle("free", (block("block"),), ()), tmp_path / "free")
    assert main(["static", str(tmp_path / "free")]) == 2
    error = capsys.readouterr().err
    assert "free/vehicle.toml: load case 'standing': nothing holds 'block' along z" in error


def test_check_doubts_mounts_that_stand_beyond_their_travel(engine, printed_json):
    (doubt,) = [words for words in printed_json("check", engine)["doubts"] if "travel" in words]
    assert doubt == (
        "mount 'M3': stands -1.59 mm off (vertical) under the vehicle's weight, beyond its travel of "
        "-1 to 1 mm"
    )


def test_check_doubts_mounts_beyond_their_curves_or_held_by_nothing(tmp_path, printed_json):
    soft = progressive_block().with_rates({"m": MountRates(3e4, 1e6, 1e6)})
    write_vehicle(soft, tmp_path / "soft")
    doubts = printed_json("check", str(tmp_path / "soft"))["doubts"]
    assert any("beyond the last point of its curve" in words for words in doubts)
    group = progressive_block().mount_groups[0]
    mount = replace(group.mounts[0], bodies=("block", "other"))
    free = Vehicle("free", (block("block"), block("other")), (), (replace(group, mounts=(mount,)),))
    write_vehicle(free, tmp_path / "free")
    doubts = printed_json("check", str(tmp_path / "free"))["doubts"]
    assert any("cannot be told: load case 'standing': nothing holds" in words for words in doubts)
