import xml.etree.ElementTree as ET

from modeviz.viewer.ladder import Rail, ladder

RAILS = [
    Rail(11.57, 9.69, weak=False, strong=True),
    Rail(9.99, 9.98, weak=False, strong=False),
    Rail(10.4, 11.9, weak=True, strong=False),
]
BEFORE, AFTER = [1.5, 9.99, 10.4, 11.57, 12.0], [1.5, 9.69, 9.98, 11.9, 17.0]


def drawing(label="Cab yaw 11.57 → 9.69"):
    return ET.fromstring(ladder(BEFORE, AFTER, RAILS, 1, label))


def rails(root):
    joined = [e for e in root.iter("line") if (e.get("y1"), e.get("y2")) == ("34", "70")]
    return [e for e in joined if e.get("stroke") != "var(--mv-soft)"]


def test_what_is_off_the_scale_has_no_mark():
    marks = [e for e in drawing().iter("line") if (e.get("y1"), e.get("y2")) == ("28", "34")]
    assert len(marks) == 4


def test_the_shown_modes_rail_is_strong_and_leans_to_where_it_went():
    (strong,) = [e for e in rails(drawing()) if e.get("stroke-width") == "2"]
    assert float(strong.get("x2")) < float(strong.get("x1"))


def test_a_shape_that_is_the_same_only_in_part_is_dashed():
    (dashed,) = [e for e in rails(drawing()) if e.get("stroke-dasharray")]
    assert float(dashed.get("x2")) > float(dashed.get("x1"))


def test_the_shown_mode_has_one_thick_mark():
    assert len([e for e in drawing().iter("line") if e.get("stroke-width") == "3"]) == 1


def test_the_label_is_text_and_no_markup():
    texts = [e.text for e in drawing("<b>yaw</b>").iter("text")]
    assert "<b>yaw</b>" in texts
