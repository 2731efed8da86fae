"""Vehicles that have no road, or nobody to feel it: their modes are shown all the same."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from session_commands import Alter

from modeviz.cli import main
from modeviz.cli.options import RoadOptions
from modeviz.files import write_vehicle
from modeviz.study.conditions import has_ride, on_even_road
from modeviz.vehicle.connections import Spring, Tyre
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.cursor import is_shaken

NO_TYRES = tuple(
    Spring(c.name, c.group, c.bodies, c.points, stiffness=c.stiffness) if isinstance(c, Tyre) else c
    for c in mounted_cabin().connections
)
NO_ROAD = {"roads": (), "connections": NO_TYRES, "wheel_loads": ()}
LACKING = {
    "road": NO_ROAD,
    "response point": {"response_points": (), "wheel_loads": ()},
    "both": {**NO_ROAD, "response_points": ()},
}


@pytest.fixture(params=LACKING)
def vehicle(request):
    return replace(mounted_cabin(), **LACKING[request.param])


def test_its_modes_are_rendered(vehicle, tmp_path, capsys):
    write_vehicle(vehicle, tmp_path / "cabin")
    file = tmp_path / "yaw.html"
    assert main(["render", str(tmp_path / "cabin"), "--mode", "cab yaw", "--output", str(file)]) == 0
    text = file.read_text("utf-8")
    beside = text[text.index("<aside>") :]
    assert "Cab yaw" in beside
    assert "<svg" not in beside[: beside.index("</aside>")]


def test_a_road_that_is_asked_for_must_be_there(vehicle, tmp_path, capsys):
    write_vehicle(vehicle, tmp_path / "cabin")
    options = ["--road", "flat", "--output", str(tmp_path / "yaw.html")]
    assert main(["render", str(tmp_path / "cabin"), *options]) == 2
    assert "give its vehicle.toml a [[" in capsys.readouterr().err


def test_the_page_shows_everything_but_responses(vehicle, tmp_path):
    vehicle, conditions = RoadOptions().shown(vehicle)
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rates, conditions, server)
    failures = []
    app.session._inspector._worker._fail = app.session._worker._fail = failures.append
    app.start()
    try:
        for change in (
            {"rates": vehicle.all_rates(vehicle.rate_sets["soft"])},
            {"kind": "damped mode", "classic": True},
            {"kind": "component"},
            {"kind": "operating shape"},
            {"against": "Soft", "overlaid": frozenset({"Original"})},
        ):
            app.session.do(Alter(**change))
            solved = app.session.wait_for_answer(30)
            if change.get("kind") == "operating shape":
                assert "[[response_point]]" in solved.movement.problem
        assert app.session.wait_checked(60)
        assert app.session.answer.findings.check.is_complete
        assert app.session.answer.findings.check.error < 1e-6
        assert "[[response_point]]" in app._response._figures._content.content
        assert np.isfinite(app.session.answer.findings.sensitivity.frequency_hz).all()
        app.report([])
    finally:
        app.close()
    assert not failures


def test_what_has_nothing_to_say_is_not_on_the_page(vehicle):
    """Neither the figures nor the road, nor what a rate would do to accelerations."""
    vehicle, conditions = RoadOptions().shown(vehicle)
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rates, conditions, server)
    try:
        app.start()
        app.session.wait(60)
        assert app._of_ride == []
        table = app._mounts._folders[0]._details._table
        assert ("RMS" in table.content) == bool(vehicle.response_points)
        assert "+10 %" in table.content
    finally:
        app.close()


def test_tyres_without_a_road_of_their_own_shake_it():
    on_iso_8608 = replace(mounted_cabin(), roads=(), wheel_loads=())
    assert has_ride(on_iso_8608)
    assert is_shaken(on_iso_8608)
    unfelt, _ = on_even_road(replace(mounted_cabin(), **LACKING["response point"]))
    assert not is_shaken(unfelt)
