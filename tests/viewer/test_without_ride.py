"""Vehicles that have no road, or nobody to feel it: their modes are shown all the same."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from session_commands import Alter

from modeviz.analysis.engine_results import solve_engine
from modeviz.analysis.preparation import prepare
from modeviz.cli import main
from modeviz.cli.options import RoadOptions
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.study.conditions import has_ride, on_even_road
from modeviz.vehicle.connections import Spring, Tyre
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.cursor import is_shaken
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.state import ResponseCurve

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
    app.tell_failure = failures.append
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
        assert "[[response_point]]" in app.screen.results.response._figures._content.content
        assert np.isfinite(app.session.answer.findings.sensitivity.frequency_hz).all()
        app.documents.report([])
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
        assert app.screen.results.figures is app.screen.results.excitation is None
        table = next(iter(app.screen.controls.mounts._folders.values()))._details._table
        assert ("RMS" in table.content) == bool(vehicle.response_points)
        assert "+10 %" in table.content
    finally:
        app.close()


@pytest.fixture(scope="module")
def powertrain(tmp_path_factory):
    """A new powertrain on its page, and its vehicle as it is shown."""
    vehicle = read_vehicle(new_vehicle("powertrain", tmp_path_factory.mktemp("new") / "engine"))
    shown, conditions = RoadOptions().shown(vehicle)
    app = App(shown, shown.rates, conditions, open_server(port=0, token="open-sesame-open"))
    app.start()
    assert app.session.wait(60)
    yield app, shown
    app.close()


def test_an_order_of_an_engine_is_drawn_where_the_engine_runs(powertrain):
    app, vehicle = powertrain
    app.session.do(SetRate("M1", "vertical", 3e5))
    solved = app.session.wait_for_answer(60)
    assert solved.state.charts.load == "four-cylinder order 2"
    curve, responses = ResponseCurve(0, "vertical"), Responses(solved)
    f = responses.lines("")
    assert (f[0], f[-1]) == (20.0, 100.0), "600 to 3000 rpm"
    expected = solve_engine(
        prepare(vehicle), solved.state.design.rates, vehicle.engines[0], f[[3, -4]] / 2
    )
    np.testing.assert_allclose(
        responses.of("", curve)[[3, -4]], expected.acceleration_g[:, 0, 0, 2], rtol=1e-9
    )
    assert responses.quantity_of(curve).unit == "g"
    drawn = app.screen.results.response._charts._plots[0]._data
    assert np.isnan(drawn[1:3, drawn[0] < 20]).all()
    app.session.do(Alter(kind="operating shape", operating_hz=30.0))
    assert not app.session.wait_for_answer(60).movement.problem


def test_what_an_engine_does_is_traced_through_mounts_without_a_road(powertrain):
    app, _ = powertrain
    solved = app.session.answer
    assert solved.state.charts.cursor_hz == pytest.approx(25.0), "the second order of 750 rpm"
    assert "loads on the body" in app.screen.results.paths._content.content
    assert "torque rod" in app.screen.results.forces._content.content
    idle = Responses(solved).running("")
    assert (
        f"{1000 * idle.rms[idle.idle, 0, 2]:.3g}"
        in app.screen.results.response._figures._content.content
    )
    assert solved.state.design.plan.goal == "decoupling"
    app.documents.report([])


def test_bodies_are_felt_at_their_centers_where_no_point_is_named(powertrain):
    _, vehicle = powertrain
    shown, _ = on_even_road(replace(vehicle, roads=(), response_points=()))
    (point,) = shown.response_points
    np.testing.assert_array_equal(point.position, vehicle.body("engine").center_of_gravity)
    unshaken, _ = on_even_road(replace(vehicle, roads=(), response_points=(), engines=()))
    assert not unshaken.response_points


def test_problems_that_need_no_road_stay_on_the_page(powertrain):
    _, vehicle = powertrain
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    idle = Problem("idle", groups, goal="idle")
    rough = Problem("rough", groups, (Performance(np.array([9.0]), roads=("ISO C",)),))
    shown, _ = on_even_road(replace(mounted_cabin(), **NO_ROAD, problems=()))
    assert not shown.problems
    shown, _ = on_even_road(replace(vehicle, problems=(idle,)))
    assert shown.problems == (idle,)
    with pytest.raises(VehicleError):
        on_even_road(replace(vehicle, problems=(rough,)))


def test_tyres_without_a_road_of_their_own_shake_it():
    on_iso_8608 = replace(mounted_cabin(), roads=(), wheel_loads=())
    assert has_ride(on_iso_8608)
    assert is_shaken(on_iso_8608)
    unfelt, _ = on_even_road(replace(mounted_cabin(), **LACKING["response point"]))
    assert not is_shaken(unfelt)
