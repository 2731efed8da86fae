"""What the page calls a vehicle and its responses, where there is little room."""

from dataclasses import replace
from html import escape

import pytest
from mounted_cabin import mounted_cabin

from modeviz.viewer.page.widgets.html import TWO_LINES, named
from modeviz.viewer.page.widgets.title import PANEL_LETTERS, panel_label
from modeviz.viewer.session.responses import curve_label
from modeviz.viewer.session.state import ResponseCurve

LONG = "a name that somebody wrote out in full, on the driver's side"


def with_points(*names):
    cabin = mounted_cabin()
    (point,) = cabin.response_points
    return replace(cabin, response_points=tuple(replace(point, name=name) for name in names))


def test_a_response_keeps_its_direction_whatever_its_point_is_called():
    label = curve_label(with_points(LONG, "seat"), ResponseCurve(0, "lateral"))
    assert label.startswith("A name that")
    assert label.endswith("side, lateral")
    assert len(label) < 36
    assert curve_label(with_points(LONG, "seat"), ResponseCurve(1, "vertical")) == "Seat, vertical"


def test_points_that_differ_only_in_their_midst_are_told_apart():
    vehicle = with_points(f"{LONG}, left, {LONG}", f"{LONG}, right, {LONG}")
    assert len({curve_label(vehicle, ResponseCurve(i, "lateral")) for i in (0, 1)}) == 2


@pytest.mark.parametrize(
    ("vehicle", "variant", "label"),
    [
        ("Pickup", "Original", "Pickup  ·  Original"),
        ("Pickup", "Trial 3, softer still", "Pickup  ·  Trial 3, s…still"),
        ("Pickup, second prototype", "Optimised", "Pickup, …type  ·  Optimised"),
    ],
)
def test_the_column_is_headed_by_vehicle_and_variant(vehicle, variant, label):
    assert panel_label(vehicle, variant) == label


def test_two_long_names_share_the_column():
    vehicle, variant = panel_label(LONG, LONG).split("  ·  ")
    assert len(vehicle) == len(variant) == PANEL_LETTERS // 2


def test_a_long_name_in_a_table_keeps_its_end_and_is_there_as_a_whole_to_hover():
    shown = named(f"{LONG} <left>")
    assert "ide &lt;left&gt;</span>" in shown
    assert f'title="{escape(LONG)} &lt;left&gt;"' in shown
    assert named("C1 left") == '<span class="name" title="C1 left">C1 left</span>'
    assert len(named("x" * 100, "y")) == len(named("x" * TWO_LINES, "y"))
