from modeviz.viewer.page.widgets.html import row, table


def test_a_table_has_its_chosen_row_marked():
    text = table(("A", "B"), [row(["1", "2"]), row(["3", "4"], chosen=True)])
    assert text.count("<td>") == 4
    assert '<tr class="on"><td>3</td><td>4</td></tr>' in text
