import xml.etree.ElementTree as ET

import numpy as np
import pytest

from modeviz.report.charts import BASE, NOW, Curve, line_chart
from modeviz.text.axes import Axis

SVG = "{http://www.w3.org/2000/svg}"
F = np.array([0.0, 10.0, 20.0, 30.0])
WIDTH, HEIGHT = 640 - 76, 270 - 74  # of the frame


def drawn(*curves, x=None, y=None, title="a chart"):
    x, y = x or Axis("Frequency, Hz", 0, 20), y or Axis("dB", -40, 0)
    return ET.fromstring(line_chart(curves, x, y, title))


def lines(root):
    return [
        np.array([[float(v) for v in p.split(",")] for p in e.get("points").split()])
        for e in root.iter(f"{SVG}polyline")
    ]


def texts(root):
    return [e.text for e in root.iter(f"{SVG}text")]


def test_a_curve_goes_through_its_points():
    (line,) = lines(drawn(Curve("now", F, np.array([-40.0, -20.0, 0.0, 0.0]))))
    np.testing.assert_allclose(line[:3], [[0, HEIGHT], [WIDTH / 2, HEIGHT / 2], [WIDTH, 0]], atol=0.06)


def test_curves_are_drawn_in_order_and_named_in_the_legend():
    root = drawn(Curve("original", F, F - 40, BASE), Curve("now", F, F - 30))
    assert [e.get("stroke") for e in root.iter(f"{SVG}polyline")] == [BASE, NOW]
    assert texts(root)[:2] == ["original", "now"]


def test_what_is_outside_is_cut_off():
    root = drawn(Curve("now", F, np.array([-40.0, 1e9, -1e9, 0.0])))
    (inner,) = [e for e in root.iter(f"{SVG}svg") if e is not root]
    assert (float(inner.get("width")), float(inner.get("height"))) == (WIDTH, HEIGHT)
    assert inner.get("overflow") == "hidden"
    assert len(list(inner.iter(f"{SVG}polyline"))) == 1
    assert np.abs(lines(root)[0]).max() < 2000


def test_a_logarithmic_chart_has_straight_lines_for_powers():
    f = np.array([1.0, 2.0, 5.0, 10.0])
    x, y = (
        Axis(name, low, high, is_logarithmic=True) for name, low, high in (("f", 1, 10), ("S", 1e-4, 1))
    )
    (line,) = lines(drawn(Curve("now", f, f**-4), x=x, y=y))
    np.testing.assert_allclose(line[:, 1] / HEIGHT, line[:, 0] / WIDTH, atol=3e-4)


def test_axes_have_titles_and_ticks_stand_at_their_values():
    root = drawn(Curve("now", F, F - 40))
    assert {"Frequency, Hz", "dB"} <= set(texts(root))
    (ten,) = [e for e in root.iter(f"{SVG}text") if e.text == "10"]
    assert float(ten.get("x")) == WIDTH / 2
    (minus_ten,) = [e for e in root.iter(f"{SVG}text") if e.text == "−10"]
    assert float(minus_ten.get("y")) == pytest.approx(HEIGHT / 4 + 4, abs=0.06)


def test_only_a_dashed_curve_has_dashes():
    root = drawn(Curve("full", F, F - 40, peaks=(1,)), Curve("dashed", F, F - 30, dash=(7, 3)))
    assert [e.get("stroke-dasharray") for e in root.iter(f"{SVG}polyline")] == [None, "7 3"]


def test_curve_without_a_name_is_not_in_the_legend():
    root = drawn(Curve("", F, F - 40), Curve("now", F, F - 30))
    assert "now" in texts(root)
    assert None not in texts(root)


def test_peaks_are_marked_where_they_are_with_their_frequency():
    root = drawn(Curve("now", F, np.array([-30.0, -20.0, -30.0, -10.0]), peaks=(1, 3)))
    (dot,) = root.iter(f"{SVG}circle")  # 30 Hz is outside
    assert (float(dot.get("cx")), float(dot.get("cy"))) == (WIDTH / 2, HEIGHT / 2)
    assert "10.0" in texts(root)


def test_of_peaks_in_one_place_the_last_curves_is_labelled():
    near = np.array([-30.0, -20.5, -30.0, -30.0])
    root = drawn(Curve("a", F, near, BASE, peaks=(1,)), Curve("b", F, near + 0.5, NOW, peaks=(1,)))
    assert len(list(root.iter(f"{SVG}circle"))) == 2
    (label,) = [e for e in root.iter(f"{SVG}text") if e.text == "10.0"]
    assert label.get("fill") == NOW


def test_names_are_text_and_no_markup():
    root = drawn(Curve("<b>&", F, F), title='"<i>')
    assert "<b>&" in texts(root)
    assert root.get("aria-label") == '"<i>'
