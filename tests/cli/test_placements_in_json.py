"""What is printed of moved mounts as JSON says where they are."""

import json

import pytest
from numpy.testing import assert_allclose

from modeviz.cli import main
from modeviz.files.new_vehicle import new_vehicle

COMMANDS = {
    "modes": (),
    "rigid": (),
    "static": (),
    "psd": ("--road", "shaking frame"),
    "forces": ("--load", "shaking frame"),
    "paths": ("--load", "shaking frame"),
}


@pytest.fixture(scope="module")
def cab(tmp_path_factory):
    return new_vehicle("cab", tmp_path_factory.mktemp("new") / "cab")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_record_says_where_mounts_were_moved(capsys, cab, command):
    arguments = [command, str(cab), *COMMANDS[command], "--json"]
    assert main([*arguments, "--place", "F=20,0,-10 mm", "--place", "F=0,5,0 deg"]) == 0
    found = json.loads(capsys.readouterr().out)["placements"]
    assert list(found) == ["F"]
    assert_allclose(found["F"]["offset_mm"], [20, 0, -10], rtol=1e-12)
    assert_allclose(found["F"]["angles_deg"], [0, 5, 0], rtol=1e-12)


def test_of_mounts_where_they_were_given_nothing_is_said(capsys, cab):
    assert main(["rigid", str(cab), "--json"]) == 0
    assert "placements" not in json.loads(capsys.readouterr().out)
