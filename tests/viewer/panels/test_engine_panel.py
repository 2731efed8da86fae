"""A running engine on the page, over its speed: by order and in all, as it is solved anew."""

from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import on_mounts
from opened_app import SOON, opened_app, text

from modeviz.analysis.engine_results import solve_engine
from modeviz.analysis.preparation import prepare
from modeviz.study.conditions import on_even_road
from modeviz.text.axes import shown_hz
from modeviz.text.wording import significant
from modeviz.vehicle.engine import Engine, EngineOrder
from modeviz.viewer.panels.peaks import _told_band
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ChangeCharts, LookAtEngine
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.state import ForceCurve, ResponseCurve

SPEEDS = np.linspace(10.0, 30.0, 5)
TORQUE = np.tile([3.0, 0, 20.0, 120.0, 0, 0], (len(SPEEDS), 1))
ORDERS = tuple(
    EngineOrder(f"four order {n:g}", "four", n, n * SPEEDS, TORQUE / n) for n in (1.0, 2.0, 4.5)
)
FOUR = Engine("four", "engine", np.array([0.1, 0.0, 0.95]), SPEEDS, 12.5, ORDERS)
QUIET = replace(on_mounts(None), forces=(), base_motions=())
VEHICLE = replace(QUIET, engines=(FOUR,))


@pytest.fixture(scope="module")
def app():
    app = opened_app(*on_even_road(VEHICLE))
    yield app
    app.close()


@pytest.fixture
def tuned(app):
    """The answer once a rate was dragged, with what the engine then does."""
    app.session.do(SetRate("E", "vertical", 5e5))
    solved = app.session.wait_for_answer(SOON)
    return solved, solve_engine(prepare(VEHICLE), solved.state.design.rates, FOUR)


def drawn(plot):
    """Speeds in rpm, and the curves, dB."""
    return plot._data[0], plot._data[1:-1]


def test_the_sum_of_all_orders_follows_the_rates_beside_the_set_compared_with(app, tuned):
    app.session.do(LookAtEngine(curve=ResponseCurve(1, "vertical")))
    solved = app.session.wait_for_answer(SOON)
    _, run = tuned
    base = solve_engine(prepare(VEHICLE), {}, FOUR)
    rpm, curves = drawn(app.screen.results.engine._total)
    np.testing.assert_allclose(rpm, 60 * run.speed_hz, rtol=1e-12)
    assert len(curves) == 2
    for curve, found in zip(curves, (base, run), strict=True):
        np.testing.assert_allclose(curve, 20 * np.log10(found.rms[:, 1, 2]), atol=1e-6)
    assert solved.state.engine.speed_hz == FOUR.idle_hz


def test_each_order_is_drawn_where_its_frequency_is_in_the_band(app, tuned):
    app.session.do(LookAtEngine(curve=ForceCurve("E0", "z")))
    app.session.wait_for_answer(SOON)
    _, run = tuned
    rpm, curves = drawn(app.screen.results.engine._by_order)
    now = curves[len(ORDERS) :]
    for number, order in enumerate(ORDERS):
        inside = order.order * rpm / 60 <= VEHICLE.highest_frequency + 1e-9
        assert np.isnan(now[number, ~inside]).all()
        expected = 20 * np.log10(np.abs(run.force[inside, number, 0, 2]))
        np.testing.assert_allclose(now[number, inside], expected, atol=1e-6)
    assert app.screen.results.engine._choice.label == "dB re 1 N"


def test_orders_are_told_at_the_cursor_and_at_idle_to_begin_with(app, tuned):
    app.session.do(LookAtEngine(curve=ForceCurve("E0", "z"), speed_hz=FOUR.idle_hz))
    app.session.wait_for_answer(SOON)
    _, run = tuned
    told = text(app.screen.results.engine._content)
    assert "At 750 rpm, idle" in told
    peak = float(np.abs(run.force[run.idle, 1, 0, 2]))
    assert f" {significant(float(f'{peak:.3g}'))} " in told
    assert "Order 4.5 56.2 beyond the band" in told
    app.session.do(LookAtEngine(speed_hz=20.0))
    app.session.wait_for_answer(SOON)
    assert "At 1200 rpm, peak" in text(app.screen.results.engine._content)


def test_a_click_on_an_order_draws_it_over_frequency(app):
    app.session.do(LookAtEngine(speed_hz=12.5))
    app.session.wait_for_answer(SOON)
    app.screen.results.engine._select(1)
    charts = app.session.wait_for_answer(SOON).state.charts
    assert (charts.load, charts.cursor_hz) == ("four order 2", 25.0)


def test_one_of_several_engines_is_chosen():
    slow = Engine("two", "frame", np.array([0.0, 0.0, 0.5]), SPEEDS / 2, 5.0, (
        EngineOrder("two order 1", "two", 1.0, SPEEDS / 2, TORQUE),
    ))  # fmt: skip
    app = opened_app(*on_even_road(replace(QUIET, engines=(FOUR, slow), response_points=())))
    try:
        assert app.screen.results.engine._total._shown == (300.0, 1800.0)
        app.session.do(LookAtEngine(engine="two", curve=ForceCurve("F1", "x")))
        app.session.wait_for_answer(SOON)
        rpm, _ = drawn(app.screen.results.engine._total)
        assert (rpm[0], rpm[-1]) == (300.0, 900.0)
    finally:
        app.close()


def test_vehicles_without_an_engine_have_no_such_tab():
    app = opened_app(*on_even_road(QUIET))
    try:
        assert app.screen.results.engine is None
    finally:
        app.close()


def test_peaks_are_looked_for_where_the_order_acts(app):
    app.session.do(ChangeCharts(load="four order 2"))
    solved = app.session.wait_for_answer(SOON)
    high = shown_hz(VEHICLE.highest_frequency)[1]
    assert _told_band(solved, Responses(solved)) == f"between 20 and {high:g} Hz"
    app.session.do(ChangeCharts(load="four order 1"))
    assert app.session.wait_for_answer(SOON)
