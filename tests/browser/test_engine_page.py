"""A powertrain from tables in a real page: its engine over speed, and its rubber over frequency."""

from dataclasses import replace

import numpy as np
import pytest
from apps import SOLVE_S, open_app
from dynamic_mounts import MAXWELL
from pages import CLOSE_NOTICES, draw_on, wait_for, wait_still, wait_until
from test_texts_fit import MISPLACED, SHOW

from modeviz.cli.options import RoadOptions
from modeviz.files import read_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.viewer.session.commands.decisions import SetRate

RUN_UPS = """Object.values(window.__viserTestpoints.uplots)
  .filter(({ chart }) => chart.series[0].label === "rpm")"""


@pytest.fixture(scope="module")
def app(server, tmp_path_factory):
    vehicle = read_vehicle(new_vehicle("powertrain", tmp_path_factory.mktemp("new") / "engine"))
    groups = tuple(replace(group, dynamic=MAXWELL) for group in vehicle.mount_groups)
    vehicle, conditions = RoadOptions().shown(replace(vehicle, mount_groups=groups))
    with open_app(server, vehicle, conditions) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        app.session.do(SetRate("M1", "vertical", 3e5))
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(1280, 720))
    wait_for(page, "document.querySelector('[role=tab][title=Engine]') !== null")
    page.evaluate(CLOSE_NOTICES)
    return page


def test_texts_of_an_engine_and_of_rubber_stay_in_their_places(page):
    for tab in ("Rubber", "Load", "Response", "Engine"):
        page.evaluate(SHOW, tab)
        wait_still(page)
        assert not page.evaluate(MISPLACED), tab


def test_the_cursor_along_the_speed_leaves_that_of_frequencies_alone(app, page):
    page.evaluate(SHOW, "Engine")
    wait_for(page, f"{RUN_UPS}.length === 2")
    wait_for(page, f"{RUN_UPS}[0].chart.over.querySelector('.mv-cursor')")
    at = page.evaluate(
        f"""() => {{
            const {{ chart }} = {RUN_UPS}[0];
            const box = chart.over.getBoundingClientRect();
            return [box.left + chart.valToPos(1500, "x"), box.top + box.height / 2];
        }}"""
    )
    page.mouse.click(*at)
    wait_until(page, lambda: abs(60 * app.session.state.engine.speed_hz - 1500) < 20)
    draw_on(page)
    drawn = page.evaluate(
        f"""() => {RUN_UPS}.map(({{ chart }}) =>
            chart.posToVal(parseFloat(chart.over.querySelector(".mv-cursor").style.left), "x"))"""
    )
    np.testing.assert_allclose(drawn, 60 * app.session.state.engine.speed_hz, atol=10)
    assert app.session.state.charts.cursor_hz == 25.0
    wait_for(page, "document.body.innerText.includes('Order 2')")


def test_what_the_engine_does_follows_the_rates(app, page):
    page.evaluate(SHOW, "Engine")
    last = f"{RUN_UPS}[0].chart.data[2][0]"
    before = wait_for(page, last)
    app.session.do(SetRate("M1", "vertical", 6e5))
    assert app.session.wait(SOLVE_S)
    run = app.session.answer.now.running(app.session.vehicle.engines[0])
    expected = float(20 * np.log10(run.rms[0, 0, 2]))
    wait_for(page, f"Math.abs({last} - a.now) < 1e-3", now=expected)
    assert abs(before - expected) > 1e-2
