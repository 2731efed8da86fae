from html_documents import Document

from modeviz.text.markup import change, section, table, title


def test_less_is_better():
    assert change(0.9, 1.0) == '<span class="good">−10.0 %</span>'
    assert change(1.1, 1.0) == '<span class="bad">+10.0 %</span>'
    assert change(1.0, 1.0) == '<span class="dim">0.0 %</span>'


def test_names_of_a_vehicle_cannot_bring_markup_into_a_page():
    assert title("<b>cab</b> yaw") == "&lt;b&gt;cab&lt;/b&gt; yaw"
    assert title("cab yaw") == "Cab yaw"


def test_a_table_names_its_rows_and_groups_them():
    text = section("S", table(["", "A", "B"], [["over"], ["x", "1", "y"]], [("", 1), ("both", 2)], {2}))
    assert Document(text).tables["S"] == [["", "both"], ["", "A", "B"], ["over"], ["x", "1", "y"]]
    assert '<th colspan="3" scope="rowgroup">over</th>' in text
    assert text.count(' class="words"') == 2
