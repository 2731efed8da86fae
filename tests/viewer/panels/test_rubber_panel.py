"""Rates over frequency on the page: the selected group's, following its sliders."""

import re
from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import HYDRAULIC, MAXWELL, measured, on_mounts
from opened_app import SOON, opened_app

from modeviz.analysis.results import Conditions
from modeviz.analysis.rubber import rubber_curve
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ChangeCharts, SelectGroup

TABLE = replace(measured(HYDRAULIC, 25), amplitude=1e-4)


@pytest.fixture(scope="module")
def app():
    engine, feet = on_mounts(TABLE).mount_groups
    vehicle = replace(on_mounts(None), mount_groups=(engine, replace(feet, dynamic=MAXWELL)))
    app = opened_app(vehicle, Conditions("random", vehicle.speed))
    yield app
    app.close()


def shown(app, *commands):
    for command in commands:
        app.session.do(command)
    solved = app.session.wait_for_answer(SOON)
    return solved, app.screen.results.rubber


def drawn(plot):
    """Frequencies, both sets' curves, and the points."""
    f, base, now, points = (np.asarray(values, float) for values in plot._chart.data)
    return f, base, now, points


def test_the_curve_of_the_selected_group_follows_its_slider(app):
    solved, panel = shown(app, SelectGroup("E"), SetRate("E", "vertical", 4e5))
    f, base, now, points = drawn(panel._stiffness)
    for curve, results in ((base, solved.base), (now, solved.now)):
        expected = rubber_curve(results.prepared, results.rates, "E", f).stiffness[:, 2] / 1e3
        np.testing.assert_allclose(curve, expected, rtol=1e-5)
    at = ~np.isnan(points)
    inside = TABLE.frequency_hz[(TABLE.frequency_hz >= 1) & (TABLE.frequency_hz <= 25)]
    np.testing.assert_allclose(f[at], inside)
    np.testing.assert_allclose(points[at], base[at])
    assert "at 0.1 mm" in panel._about.content


def test_loss_angles_are_told_at_the_reference_and_at_the_cursor(app):
    solved, panel = shown(
        app, SelectGroup("F"), ChangeCharts(cursor_hz=9.0, rubber_direction="lateral")
    )
    curve = rubber_curve(solved.now.prepared, solved.now.rates, "F", np.array([5.0, 9.0]))
    told = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", panel._content.content))
    k, angle = curve.stiffness[:, 1] / 1e3, np.degrees(curve.loss_angle[:, 1])
    assert f"lateral {k[0]:.1f} {angle[0]:.1f} {k[1]:.1f} {angle[1]:.1f}" in told
    _, _, now, points = drawn(panel._angle)
    assert now.max() > 5
    assert np.isnan(points).all()
    assert "three-parameter" in panel._about.content


def test_vehicles_whose_rates_no_frequency_changes_have_no_such_tab():
    vehicle = on_mounts(None)
    app = opened_app(vehicle, Conditions("random", vehicle.speed))
    try:
        assert app.screen.results.rubber is None
    finally:
        app.close()
