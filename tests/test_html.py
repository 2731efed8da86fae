import pytest

from modeviz.viewer.html import change, number, row, sentence_case, signed, table, title


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [
        (0.123, 2, "+0.12"),
        (-0.123, 2, "−0.12"),
        (0.004, 2, "0.00"),
        (-0.004, 2, "0.00"),
        (12.0, 0, "+12"),
    ],
)
def test_changes_have_a_sign_and_none_is_a_plain_zero(value, decimals, text):
    assert signed(value, decimals) == text


def test_negative_numbers_have_a_true_minus():
    assert number(-2.846, 2) == "−2.85"
    assert number(-0.001, 2) == "0.00"
    assert number(2.846, 1) == "2.8"


def test_less_is_better():
    assert change(0.9, 1.0) == '<span class="good">−10.0 %</span>'
    assert change(1.1, 1.0) == '<span class="bad">+10.0 %</span>'
    assert change(1.0, 1.0) == '<span class="dim">0.0 %</span>'


def test_names_of_a_vehicle_cannot_bring_markup_into_a_page():
    assert title("<b>cab</b> yaw") == "&lt;b&gt;cab&lt;/b&gt; yaw"
    assert title("cab yaw") == "Cab yaw"


def test_names_on_widgets_are_shown_as_they_are():
    assert sentence_case("front & rear") == "Front & rear"


def test_a_table_has_its_chosen_row_marked():
    text = table(("A", "B"), [row(["1", "2"]), row(["3", "4"], chosen=True)])
    assert text.count("<td>") == 4
    assert '<tr class="on"><td>3</td><td>4</td></tr>' in text
