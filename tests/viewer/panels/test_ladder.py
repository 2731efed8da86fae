import xml.etree.ElementTree as ET

import pytest

from modeviz.viewer.panels.ladder import BOTTOM, TOP, Rail, around, ladder

RAILS = [
    Rail(11.57, 9.69, weak=False, strong=True),
    Rail(9.99, 9.98, weak=False, strong=False),
    Rail(10.4, 11.9, weak=True, strong=False),
    Rail(12.0, 17.0, weak=False, strong=False),
    Rail(1.5, 1.5, weak=False, strong=False),
]
BEFORE = {"roll": 1.5, "hop": 9.99, "roll 2": 10.4, "cab yaw": 11.57, "tramp": 12.0}
AFTER = {"roll": 1.5, "cab yaw": 9.69, "hop": 9.98, "roll 2": 11.9, "<b>tramp</b>": 17.0}


def drawing(scale=(8, 15)):
    return ET.fromstring(ladder(BEFORE, AFTER, RAILS, "cab yaw", scale))


def lines(root, top, bottom):
    at = [e for e in root.iter("line") if (int(e.get("y1")), int(e.get("y2"))) == (top, bottom)]
    return [e for e in at if e.get("stroke") != "var(--mv-soft)"]


def x(element, end="x1"):
    return float(element.get(end).rstrip("%"))


def tips(elements):
    return [e.find("title").text for e in elements]


def test_what_is_off_the_scale_has_no_mark():
    before, after = lines(drawing(), TOP - 6, TOP), lines(drawing(), BOTTOM, BOTTOM + 7)
    assert tips(before) == ["hop 9.99 Hz", "roll 2 10.40 Hz", "cab yaw 11.57 Hz", "tramp 12.00 Hz"]
    assert tips(after) == ["cab yaw 9.69 Hz", "hop 9.98 Hz", "roll 2 11.90 Hz"]


def test_a_rail_with_one_end_off_the_scale_goes_to_its_edge():
    rails = lines(drawing(), TOP, BOTTOM)
    assert len(rails) == 4
    assert max(x(r, "x2") for r in rails) == 96


def test_frequencies_are_in_proportion():
    low, high = (x(e) for e in lines(drawing((9, 12)), TOP - 6, TOP)[1:3])
    assert high - low == pytest.approx(92 * (11.57 - 10.4) / 3, abs=0.011)


def test_the_shown_modes_rail_is_strong_and_leans_to_where_it_went():
    (strong,) = [e for e in lines(drawing(), TOP, BOTTOM) if e.get("stroke-width") == "2"]
    assert x(strong, "x2") < x(strong)


def test_a_shape_that_is_the_same_only_in_part_is_dashed():
    (dashed,) = [e for e in lines(drawing(), TOP, BOTTOM) if e.get("stroke-dasharray")]
    assert x(dashed, "x2") > x(dashed)


def test_the_shown_mode_has_one_thick_mark():
    (thick,) = [e for e in drawing().iter("line") if e.get("stroke-width") == "4"]
    assert tips([thick]) == ["cab yaw 9.69 Hz"]


def test_a_name_is_text_and_no_markup():
    assert "<b>tramp</b> 17.00 Hz" in tips(lines(drawing((8, 20)), BOTTOM, BOTTOM + 7))


@pytest.mark.parametrize(
    ("scale", "labels"),
    [
        ((8, 12), ["8", "9", "10", "11", "12 Hz"]),
        ((7, 21), ["8", "10", "12", "14", "16", "18", "20 Hz"]),
        ((1, 21), ["2", "4", "6", "8", "10", "12", "14", "16", "18", "20 Hz"]),
    ],
)
def test_numbers_along_the_scale_do_not_crowd(scale, labels):
    assert [e.text for e in drawing(scale).iter("text")] == labels


def test_a_scale_is_in_whole_hertz_with_room_at_both_ends():
    assert around([8.21, 20.38]) == (7, 21)
    assert around([0.2]) == (0, 1)
