"""The charts, peaks and figures of the right column, on the smallest vehicle."""

import json

import numpy as np
import pytest
from apps import open_app
from charts import at_lines, has_lines
from mounted_cabin import mounted_cabin
from pages import draw_on, wait_for, wait_until
from session_commands import Alter

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli import main
from modeviz.files import write_vehicle
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.panels.plots import SHOWN_HZ
from modeviz.viewer.session.commands.decisions import Load, SetRate, TakeRates
from modeviz.viewer.session.commands.looks import Overlay
from modeviz.viewer.session.state import ResponseCurve

SOLVE_S = 60
SINGLE = 2.0**-23  # relative, between neighbours in single precision
FLAT = Conditions("flat", 20.0)
CURVES = ResponseCurve(0, "lateral"), ResponseCurve(0, "vertical")
LOW, HIGH = SHOWN_HZ
CHARTS = """
  Object.values(window.__viserTestpoints?.uplots ?? {}).sort((one, other) =>
    one.chart.root.getBoundingClientRect().top - other.chart.root.getBoundingClientRect().top)
"""
DRAWN = f"""
  {CHARTS}.map(({{ chart }}) => Object.fromEntries(
    chart.series.map((s, i) => [i ? s.label : "Hz", Array.from(chart.data[i])])))
"""


@pytest.fixture(scope="module")
def app(server):
    with open_app(server, mounted_cabin(), FLAT) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 760))
    wait_for(page, f"{CHARTS}.length === 2")
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the vehicle's rates, on the road, in decibels."""
    page.get_by_role("tab", name="Response").click()
    app.session.do(Load("Original"))
    app.session.do(Alter(
        load="", curves=CURVES, conditions=FLAT, decibels=True, log_frequency=False,
        against="Original", overlaid=frozenset(), group="A", mode="cab yaw",
    ))  # fmt: skip
    assert app.session.wait(SOLVE_S)


def zoom(page, chart, low, high):
    """Drags across a chart from one frequency to another, and gives what it shows then."""
    left, right, y = page.evaluate(
        f"""([i, low, high]) => {{
            const {{ chart }} = {CHARTS}[i];
            const box = chart.over.getBoundingClientRect();
            const at = (f) => box.left + chart.valToPos(f, "x");
            return [at(low), at(high), box.top + box.height / 2];
        }}""",
        [chart, low, high],
    )
    page.mouse.move(left, y)
    page.mouse.down()
    page.mouse.move((left + right) / 2, y, steps=3)
    page.mouse.move(right, y, steps=3)
    page.mouse.up()
    return wait_for(page, f"(([low, high]) => high - low < 20 && [low, high])({range_of(chart)})")


def decibels_of(app, curve):
    return decibels(app.session.answer.now, curve)


def range_of(chart):
    return f"((x) => [x.min, x.max])({CHARTS}[{chart}].chart.scales.x)"


def test_a_chart_keeps_its_zoom_when_another_response_is_chosen(app, page):
    seen = zoom(page, 0, 10.0, 17.0)
    assert seen == pytest.approx([10, 17], abs=0.3)
    for curve in (ResponseCurve(0, "vertical"), ResponseCurve(0, "fore-aft")):
        app.session.do(Alter(curves=(curve, CURVES[1])))
        assert app.session.wait(SOLVE_S)
        assert_drawn(page, 0, "now", decibels_of(app, curve))
        wait_for(page, f"(([low, high]) => low === a.low && high === a.high)({range_of(0)})",
                 low=seen[0], high=seen[1])  # fmt: skip
    page.evaluate(f"{CHARTS}[0].chart.over.dispatchEvent(new MouseEvent('dblclick'))")
    wait_for(page, f"(([low, high]) => low === {LOW} && high === {HIGH})({range_of(0)})")
    page.evaluate("() => new Promise(requestAnimationFrame)")  # in which the page takes note of it
    app.session.do(Alter(curves=CURVES))
    assert app.session.wait(SOLVE_S)
    assert_drawn(page, 0, "now", decibels_of(app, CURVES[0]))
    draw_on(page)  # a zoom that came back would be there by now
    assert page.evaluate(range_of(0)) == [LOW, HIGH]


def spectrum(results, curve):
    """A response with its lines."""
    return results.frequency_hz, results.response(curve.point, curve.direction)


def decibels(results, curve):
    f, psd = spectrum(results, curve)
    return f, 10 * np.log10(psd)


def assert_drawn(page, chart, label, expected):
    """Waits until a chart's curve of that name is what is expected, frequencies and values."""

    def is_drawn():
        curves = page.evaluate(DRAWN)
        if len(curves) <= chart or label not in curves[chart]:
            return False
        lines, found = curves[chart]["Hz"], curves[chart][label]
        return has_lines(lines, expected[0]) and np.allclose(
            *at_lines(lines, found, *expected), rtol=SINGLE, atol=0
        )

    wait_until(page, is_drawn)


def choose(page, label, option):
    page.get_by_role("combobox", name=label).click()
    page.get_by_role("option", name=option, exact=True).click()


def test_curves_are_the_results_in_decibels_and_in_their_unit(app, page):
    rates = {"A": MountRates(4e5, 1.5e5, 4e5)}
    app.session.do(TakeRates(rates))
    prepared = prepare(mounted_cabin())
    now, base = solve(prepared, rates, FLAT), solve(prepared, {}, FLAT)
    for chart, curve in enumerate(CURVES):
        assert_drawn(page, chart, "now", decibels(now, curve))
        assert_drawn(page, chart, "Original", decibels(base, curve))
    page.get_by_role("tab", name="Road").click()
    choose(page, "Level", "Linear unit, logarithmic axis")
    page.get_by_role("tab", name="Response").click()
    assert_drawn(page, 0, "now", spectrum(now, ResponseCurve(0, "lateral")))


def test_another_direction_is_drawn_where_it_is_chosen(app, page):
    page.get_by_role("combobox", name="dB re 1 g²/Hz").first.click()
    page.get_by_role("option", name="Seat, fore-aft").click()
    assert app.session.wait(SOLVE_S)
    assert_drawn(page, 0, "now", decibels_of(app, ResponseCurve(0, "fore-aft")))


def test_an_overlaid_set_is_drawn_as_a_curve_of_its_own_and_named(app, page):
    app.session.do(Overlay("Soft", True))
    soft = solve(prepare(mounted_cabin()), mounted_cabin().rate_sets["soft"], FLAT)
    assert_drawn(page, 1, "Soft", decibels(soft, ResponseCurve(0, "vertical")))
    wait_for(page, "document.querySelector('.mv .keyed')?.textContent.includes('Soft')")


def test_a_wheel_load_is_drawn_as_the_command_line_prints_it(app, page, tmp_path, capsys):
    page.get_by_role("tab", name="Road").click()
    choose(page, "Excitation", "Front left radial force")
    page.get_by_role("tab", name="Response").click()
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    capsys.readouterr()
    assert main(["wheels", str(tmp_path / "cabin"), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    (load,) = record["loads"]
    for chart, curve in enumerate(CURVES):
        (printed,) = [r for r in load["responses"] if r["direction"] == curve.direction]
        assert_drawn(page, chart, "now", (record["frequency_hz"], printed["acceleration_db"]))
        wait_for(page, "document.body.textContent.includes('dB re 1 g')")
    wait_for(page, "document.querySelector('.mv .figures')?.textContent.includes('Mean lateral')")


def test_the_zoom_stays_while_rates_move(app, page):
    zoom = f"{CHARTS}.map(({{ chart }}) => [chart.scales.x.min, chart.scales.x.max])"
    for chart, curve in enumerate(CURVES):
        assert_drawn(page, chart, "now", decibels_of(app, curve))
    page.evaluate(f"{CHARTS}.forEach(c => c.chart.setScale('x', {{ min: 8, max: 14 }}))")
    for rate in (2.9e5, 2.5e5, 2e5):
        app.session.do(SetRate("A", "lateral", rate))
        assert app.session.wait(SOLVE_S)
        assert_drawn(page, 0, "now", decibels_of(app, ResponseCurve(0, "lateral")))
    assert page.evaluate(zoom) == [[8, 14], [8, 14]]


def test_a_click_on_a_contributor_shows_its_mode_and_selects_its_mounts(app, page):
    pill = page.locator(".mv .pill:not(.on)").first
    text = pill.locator("span").inner_text().removeprefix("~")
    pill.locator("label").click()
    wait_until(page, lambda: app.session.state.motion.mode == text.lower())
    assert app.session.wait(SOLVE_S)
    solved = app.session.answer
    largest = max(("A", "B"), key=lambda group: solved.strain[group])
    assert solved.state.group == largest


def place(page, chart, frequency_hz):
    """Where a frequency is on the screen, in the middle of a chart."""
    return page.evaluate(
        f"""([i, f]) => {{
            const {{ chart }} = {CHARTS}[i];
            const box = chart.over.getBoundingClientRect();
            return [box.left + chart.valToPos(f, "x"), box.top + box.height / 2];
        }}""",
        [chart, frequency_hz],
    )


def drawn_cursors(page):
    """The frequencies at which the charts have their line, Hz."""
    return page.evaluate(
        f"""() => {CHARTS}.map(({{ chart }}) =>
            chart.posToVal(parseFloat(chart.over.querySelector(".mv-cursor").style.left), "x"))"""
    )


def test_a_click_in_a_chart_puts_the_cursor_there_and_a_drag_takes_it_along(app, page):
    app.session.do(Alter(cursor_hz=9.0))
    app.session.wait(SOLVE_S)
    wait_for(page, "document.querySelectorAll('.mv-cursor').length === 2")
    everything = {"min": LOW, "max": HIGH}
    page.evaluate(f"(x) => {CHARTS}.forEach(({{ chart }}) => chart.setScale('x', x))", everything)
    page.mouse.click(*place(page, 1, 17.0))
    wait_until(page, lambda: abs(app.session.state.charts.cursor_hz - 17.0) < 0.2)
    draw_on(page)
    np.testing.assert_allclose(drawn_cursors(page), app.session.state.charts.cursor_hz, atol=0.05)
    x, y = place(page, 0, app.session.state.charts.cursor_hz)
    page.mouse.move(x, y)
    page.mouse.down()
    for f in (15.0, 13.0, 12.0):
        page.mouse.move(*place(page, 0, f))
    page.mouse.up()
    wait_until(page, lambda: abs(app.session.state.charts.cursor_hz - 12.0) < 0.2)
    shown = page.evaluate(f"() => {CHARTS}.map(({{ chart: {{ scales }} }}) => scales.x.max)")
    assert shown == [HIGH, HIGH]  # nothing was zoomed


def test_the_forces_of_mounts_follow_a_drag_on_the_page(app, page):
    page.get_by_role("tab", name="Forces").click()
    before = app.screen.results.forces._content.content
    app.session.do(SetRate("A", "vertical", 2e6))
    assert app.session.wait(SOLVE_S)
    assert app.screen.results.forces._content.content != before
    rms = app.session.answer.now.mount_forces().rms[0, 2]
    wait_for(page, "document.body.innerText.includes(a.text)", text=f"{float(f'{rms:.3g}'):g}")


def test_a_click_on_a_path_selects_its_mounts(app, page):
    page.get_by_role("tab", name="Paths").click()
    page.locator(".mv label", has_text="B -0.5").last.click()
    wait_until(page, lambda: app.session.state.group == "B")
