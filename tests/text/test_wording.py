from types import SimpleNamespace

import pytest

from modeviz.text.wording import (
    file_name,
    in_a_box,
    number,
    percent_change,
    power_of_ten,
    scientific,
    sentence_case,
    signed,
    significant,
    told_apart,
    within_sentence,
)


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


def test_names_on_widgets_are_shown_as_they_are():
    assert sentence_case("front & rear") == "Front & rear"
    assert sentence_case("~cab yaw") == "~Cab yaw"


def test_titles_go_on_small_within_a_sentence():
    assert within_sentence("Cab yaw") == "cab yaw"
    assert within_sentence("~Cab yaw") == "~cab yaw"


def test_powers_and_small_numbers_are_written_with_superscripts():
    assert [power_of_ten(e) for e in (-12, -3, -2, 0, 3, 4)] == [
        "10⁻¹²",
        "10⁻³",
        "0.01",
        "1",
        "1000",
        "10⁴",
    ]
    assert [scientific(v) for v in (7.4e-8, 0.0, 2e10)] == ["7 × 10⁻⁸", "0", "2 × 10¹⁰"]
    assert scientific(float("inf")) == "∞"


def test_four_digits_are_kept_and_no_empty_ones():
    values = {1094.0: "1094", 21000.0: "21000", 137.75: "137.8", 0.25: "0.25", 100.0: "100", 0.0: "0"}
    assert {v: significant(v) for v in values} == values
    assert significant(100 / 3) == "33.33"


def test_a_box_shows_four_digits_of_what_has_more_than_it_has_room_for():
    values = {139.312345: 139.3, 139.25: 139.25, 0: 0, 1234567.8: 1234568, 1 / 3: 0.3333, 12000: 12000}
    assert {v: in_a_box(v) for v in values} == values
    assert significant(9.99996) == "10"


def test_a_change_is_relative_to_what_was():
    assert percent_change(0.45, 1.0) == "−55.0 %"
    assert percent_change(2.5, 1.0) == "+150.0 %"
    assert percent_change(0.0, 0.0) == "0.0 %"
    assert percent_change(1.0, 0.0) == "–"


def test_file_names_hold_nothing_that_a_file_system_minds():
    assert file_name("Cabin Trial 1/2: soft*", "csv") == "cabin-trial-1-2-soft.csv"
    assert file_name("../..", "json") == "modeviz.json"


def test_things_of_one_label_are_told_apart_by_their_names():
    things = [
        SimpleNamespace(name="road 1", label="country"),
        SimpleNamespace(name="road 2", label="Country"),
        SimpleNamespace(name="road 3", label="town"),
    ]
    assert told_apart(things) == {
        "Country (road 1)": "road 1",
        "Country (road 2)": "road 2",
        "Town": "road 3",
    }
