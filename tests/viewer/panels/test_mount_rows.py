from modeviz.viewer.panels.mounts.rows import change_in_words, row_label, step_of_box


def test_a_label_carries_the_change_and_nothing_where_there_is_none():
    assert row_label("vertical", 1641e3, 1094e3) == "Vertical  +50 %"
    assert row_label("fore-aft", 130e3, 350e3) == "Fore-aft  −63 %"
    assert row_label("lateral", 294e3, 294e3) == "Lateral"


def test_changes_are_as_short_as_they_are_clear():
    assert change_in_words(100.4, 100.0) == "+0.4 %"
    assert change_in_words(0.0, 100.0) == "−100 %"
    assert change_in_words(100.0, 0.0) == "added"
    assert change_in_words(0.0, 0.0) == ""
    assert change_in_words(999.0, 100.0) == "+899 %"
    assert change_in_words(1200.0, 100.0) == "× 12"


def test_an_arrow_key_moves_a_number_by_a_power_of_ten_of_at_most_two_percent():
    assert [step_of_box(rate) for rate in (1094, 294, 50, 49, 2.94)] == [10.0, 1.0, 1.0, 0.1, 0.01]
    assert step_of_box(0.0) == 1.0
