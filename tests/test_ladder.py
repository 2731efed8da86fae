import xml.etree.ElementTree as ET

from modeviz.viewer.ladder import ladder

BASE = {"cab yaw": 11.57, "rear hop": 9.99, "roll": 1.5, "gone": 12.0}
NOW = {"cab yaw": 9.69, "rear hop": 9.98, "roll": 1.5, "new": 13.0}


def lines(drawing, stroke_width):
    root = ET.fromstring(drawing)
    return [e for e in root.iter("line") if e.get("stroke-width") == stroke_width]


def test_the_ladder_is_well_formed_and_joins_before_to_now():
    drawing = ladder(BASE, NOW, "cab yaw")
    # The shown mode's rung is the only thick slanted line; it leans to lower frequency.
    slanted = [e for e in lines(drawing, "2") if e.get("x1") != e.get("x2")]
    (rung,) = slanted
    assert float(rung.get("x2")) < float(rung.get("x1"))


def test_the_ladder_leaves_out_what_is_not_in_both():
    drawing = ladder(BASE, NOW, "cab yaw")
    assert len(lines(drawing, "3")) == 1
    # Marks below: rear hop's is normal, the shown mode's strong; roll is off the scale.
    rungs = [
        e for e in ET.fromstring(drawing).iter("line") if e.get("y1") == "34" and e.get("y2") == "70"
    ]
    assert len([e for e in rungs if e.get("stroke") != "var(--mv-soft)"]) == 2


def test_the_shown_mode_is_written_out():
    texts = [e.text for e in ET.fromstring(ladder(BASE, NOW, "cab yaw")).iter("text")]
    assert "Cab yaw 11.57 → 9.69" in texts
