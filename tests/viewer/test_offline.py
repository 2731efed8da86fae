"""What stands beside the scene in an offline page, against what the solver says."""

import re

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from session_commands import Alter

from modeviz.analysis.results import Conditions
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.commands.looks import ChangeLook

WIDTH = 420 - 62 - 14
"""Of the frame of a chart, in its own units."""


@pytest.fixture(scope="module")
def app():
    vehicle = mounted_cabin()
    rates = vehicle.all_rates(vehicle.rate_sets["soft"])
    app = App(vehicle, rates, Conditions("flat", 20.0), open_server(port=0, token="open-sesame-open"))
    app.start()
    yield app
    app.close()


def beside(app, **asked):
    """The text beside the scene with something asked for, and the charts' lines, x from 0 to 1."""
    app.session.do(Alter(**asked))
    app.session.wait_for_answer(30)
    page = app.documents.offline(np.array([-5.0, -5, 2]), np.zeros(3)).decode()
    text = page[page.index("<aside>") : page.index("</aside>")]
    points = [line.split() for line in re.findall('<polyline points="([^"]+)"', text)]
    lines = [np.array([p.split(",") for p in line], float) / (WIDTH, 1) for line in points]
    return text, lines


def test_road_charts_show_the_compared_set_and_the_present_one_at_the_chosen_points(app):
    text, lines = beside(app, load="")
    assert len(lines) == 4
    assert text.count("dB re 1 g²/Hz") == 2
    assert all(words in text for words in ("Seat, lateral", "Seat, vertical", "Flat, 72 km/h"))
    solved = app.session.answer
    drawn = [(d, results) for d in ("lateral", "vertical") for results in (solved.base, solved.now)]
    for line, (direction, results) in zip(lines, drawn, strict=True):
        check(line, results.frequency_hz, results.response(0, direction))


def test_under_a_wheel_load_its_response_is_drawn_not_the_roads(app):
    load = app.session.vehicle.wheel_loads[0].name
    text, lines = beside(app, load=load)
    assert text.count("dB re 1 g<") == 2
    assert "Front left radial force" in text
    assert "km/h" not in text
    now = app.session.answer.now
    found = solve_wheels(now.prepared, now.rates)
    check(lines[1], found.frequency_hz, found.acceleration_g[:, 0, 0, 1])
    check(lines[3], found.frequency_hz, found.acceleration_g[:, 0, 0, 2])


def test_other_scales_are_those_of_the_page(app):
    text, lines = beside(app, load="", decibels=False, log_frequency=True)
    assert "dB" not in text
    f = app.session.answer.now.frequency_hz
    inside = (lines[1][:, 0] >= 0) & (lines[1][:, 0] <= 1)
    np.testing.assert_allclose(25 ** lines[1][inside, 0], f[(f >= 1) & (f <= 25)], rtol=2e-3)
    app.session.do(Alter(decibels=True, log_frequency=False))


def check(line, frequency_hz, response):
    """That a line is highest where a response is."""
    inside = (frequency_hz >= 1) & (frequency_hz <= 25)
    highest = frequency_hz[inside][response[inside].argmax()]
    x, y = line[inside].T
    assert 1 + 24 * x[y.argmin()] == pytest.approx(highest, abs=0.05)


def test_the_handle_of_mounts_stays_behind(app, monkeypatch):
    app.session.do(ChangeLook(handle=True))
    app.session.wait_for_answer(30)
    handle, seen = app.scene._handle._handle, []
    monkeypatch.setattr("modeviz.viewer.documents.offline_page", lambda *_: seen.append(handle.visible))
    assert handle.visible
    app.documents.offline(np.zeros(3), np.ones(3))
    assert seen == [False]
    assert handle.visible
