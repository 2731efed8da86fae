from modeviz.viewer.html import change, row, table, title


def test_less_is_better():
    assert change(0.9, 1.0) == '<span class="good">−10.0 %</span>'
    assert change(1.1, 1.0) == '<span class="bad">+10.0 %</span>'
    assert change(1.0, 1.0) == '<span class="dim">0.0 %</span>'


def test_names_of_a_vehicle_cannot_bring_markup_into_a_page():
    assert title("<b>cab</b> yaw") == "&lt;b&gt;cab&lt;/b&gt; yaw"
    assert title("cab yaw") == "Cab yaw"


def test_a_table_has_its_chosen_row_marked():
    text = table(("A", "B"), [row(["1", "2"]), row(["3", "4"], chosen=True)])
    assert text.count("<td>") == 4
    assert '<tr class="on"><td>3</td><td>4</td></tr>' in text
