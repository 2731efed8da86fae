"""Forces and paths on the page: those of the vehicle solved anew, at rest and after a drag."""

import re
from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import on_mounts
from mounted_cabin import mounted_cabin
from mounted_machine import mounted_machine
from opened_app import SOON, opened_app, text
from session_commands import Alter

from modeviz.analysis.results import Conditions
from modeviz.study.conditions import on_even_road
from modeviz.study.study import Study
from modeviz.text.wording import significant
from modeviz.vehicle.engine import Engine, EngineOrder
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.responses import Responses, curve_label
from modeviz.viewer.session.state import ForceCurve, ResponseCurve


@pytest.fixture(scope="module")
def app():
    vehicle = mounted_machine()
    app = opened_app(vehicle, Conditions("road", vehicle.speed))
    yield app
    app.close()


@pytest.fixture
def study():
    return Study(mounted_machine())


def show(app, **changes):
    app.session.do(Alter(**changes))
    return app.session.wait_for_answer(SOON)


def test_rms_of_mounts_follows_a_drag(app, study):
    show(app, load="", in_vehicle_axes=False)
    app.session.do(SetRate("E", "vertical", 5e5))
    app.session.wait_for_answer(SOON)
    study.rates["E.vertical"] = "500 N/mm"
    expected = study.forces("road").rms("rear", "z")
    (row,) = re.findall(r"rear (.*?) foot", text(app.screen.results.forces._content))[:1]
    assert f" {significant(float(f'{expected:.3g}'))} " in f" {row} "
    app.session.do(SetRate("E", "vertical", 3e5))
    app.session.wait_for_answer(SOON)


def test_the_cursor_tells_amplitude_and_phase_under_a_harmonic_load(app, study):
    show(app, load="firing", cursor_hz=9.3)
    phasor = study.forces("firing", frequency_hz=9.3).phasor("rear", "y")[0]
    (_, row) = re.findall(r"rear (.*?) foot", text(app.screen.results.forces._content))[:2]
    assert significant(float(f"{abs(phasor):.3g}")) in row
    assert f"{abs(np.degrees(np.angle(phasor))):.0f}°" in row


def test_paths_at_the_cursor_are_those_of_the_vehicle_solved_anew(app, study):
    for by in ("mount", "body"):
        show(app, load="", cursor_hz=12.5, paths_by=by, path_curve=ResponseCurve(1, "vertical"))
        paths = study.paths("head", "vertical", "road", by=by, frequency_hz=12.5)
        shown = text(app.screen.results.paths._content)
        largest = max(paths.shares(), key=lambda name: abs(paths.spectrum(name)[0]))
        share = paths.spectrum(largest)[0]
        minus = "−" if share < 0 else ""
        assert f"{largest} {minus}{abs(100 * share):.0f} %" in shown
        assert shown.index(largest) < 90


def test_a_click_on_a_path_selects_its_group(app):
    show(app, load="", paths_by="mount", path_curve=ResponseCurve(0, "vertical"), group="E")
    paths = app.screen.results.paths
    assert paths._buttons.label("F", "").removesuffix("</label>") in paths._content.content
    paths._select("F")
    app.session.wait_for_answer(SOON)
    assert app.session.state.group == "F"


@pytest.mark.parametrize("load", ["", "firing"])
@pytest.mark.parametrize("axes", [False, True])
def test_a_chart_draws_the_force_of_a_mount(app, study, load, axes):
    curve = ForceCurve("front", "z", axes)
    solved = show(app, load=load, curves=(curve, ResponseCurve(0, "lateral")))
    responses = Responses(solved)
    forces = study.forces(load or "road")
    expected = forces.psd("front", "z", axes) if not load else np.abs(forces.phasor("front", "z", axes))
    found = np.interp(forces.frequency_hz, responses.lines(""), responses.of("", curve))
    np.testing.assert_allclose(found, expected, rtol=2e-2, atol=1e-3 * expected.max())
    assert responses.quantity_of(curve).unit == ("N" if load else "N²/Hz")
    axes_named = "vehicle" if axes else "local"
    assert curve_label(solved.now.vehicle, curve) == f"Front, force, {axes_named} z"
    assert (
        app.screen.results.response._charts._choices[0].label == f"dB re 1 {'N' if load else 'N²/Hz'}"
    )
    (modes,) = responses.peaks(curve, 3, [], (11.0,))
    assert modes.contributors[0].ratio == 1.0


def test_the_modes_at_the_cursor_are_those_of_a_peak_that_is_there(app):
    curve = ResponseCurve(0, "lateral")
    solved = show(app, load="", curves=(curve, ResponseCurve(0, "vertical")))
    responses = Responses(solved)
    line = responses.peak_lines(curve)[-1]
    (peak, there) = responses.peaks(curve, 3, [line], (float(responses.lines("")[line]),))
    assert there.contributors == peak.contributors
    assert there.level == pytest.approx(peak.level)


def test_force_modes_are_of_the_motion_that_stretches_the_mount(app):
    """Where one mode makes all of a response, it makes all of a force through a mount, too."""
    solved = show(app, load="firing", curves=(ForceCurve("rear", "z"), ResponseCurve(1, "vertical")))
    responses = Responses(solved)
    curve = ForceCurve("rear", "z")
    line = max(responses.peak_lines(curve), key=lambda i: responses.of("", curve)[i])
    (peak,) = responses.peaks(curve, 2, [line])
    shape = solved.now.modes.shapes[:, peak.contributors[0].mode]
    assert abs(solved.now.modes.frequency_hz[peak.contributors[0].mode] - peak.frequency_hz) < 1.0
    assert np.abs(solved.now.prepared.system.mount_motions[5] @ shape) > 0


def test_a_cursor_beyond_what_is_known_of_a_load_says_so(app):
    show(app, load="", cursor_hz=99.0)
    assert "its table holds" in text(app.screen.results.paths._content)
    assert "its table holds" in text(app.screen.results.forces._content)
    show(app, cursor_hz=11.0)


def test_energy_has_what_the_shown_mode_loses_in_a_cycle(app):
    solved = show(app, load="")
    assert sum(solved.dissipated.values()) == pytest.approx(1.0)
    assert "Dissipated in a cycle" in text(app.screen.results.energy._content)


def test_tabs_that_have_nothing_to_say_are_not_there():
    app = opened_app(*on_even_road(replace(mounted_cabin(), wheel_loads=())))
    try:
        assert app.screen.results.forces is None
        assert app.screen.results.paths is None
    finally:
        app.close()


def test_forces_are_shown_under_the_orders_of_an_engine_that_nothing_else_shakes():
    speeds = np.linspace(10.0, 30.0, 21)
    torque = np.tile([0.0, 0, 0, 120.0, 0, 0], (len(speeds), 1))
    orders = tuple(EngineOrder(f"order {n}", "four", n, n * speeds, torque) for n in (1.0, 2.0))
    engine = Engine("four", "engine", np.array([0.1, 0.0, 0.95]), speeds, 12.5, orders)
    quiet = replace(on_mounts(None), forces=(), base_motions=(), response_points=())
    vehicle = replace(quiet, engines=(engine,))
    app = opened_app(*on_even_road(vehicle))
    try:
        order = orders[1].name
        assert app.session.state.charts.load == orders[0].name
        show(app, load=order, cursor_hz=25.0)
        phasor = Study(vehicle).forces(order, frequency_hz=25.0).phasor("E0", "z")[0]
        (_, row) = re.findall(r"E0 (.*?) E1", text(app.screen.results.forces._content))[:2]
        assert significant(float(f"{abs(phasor):.3g}")) in row
    finally:
        app.close()


def test_forces_are_shown_without_anybody_who_feels_them():
    app = opened_app(*on_even_road(replace(mounted_cabin(), response_points=())))
    try:
        assert app.session.state.charts.load == "front left radial force"
        assert "Largest peak, N" in text(app.screen.results.forces._content)
    finally:
        app.close()
