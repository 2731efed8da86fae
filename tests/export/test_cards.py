"""Cards keep every digit, in fields that Nastran reads."""

import numpy as np
import pytest
from bulk_data import bulk_data

from modeviz.export.cards import card, comment

REALS = [
    0.0, -0.0, 1.0, -1.5, 724.0, 1e7, -123456.0, 1 / 3, -np.pi * 1e-7, 6.02214076e23, -1.6e-19, 1e15,
    1e-300, -1.2345678901234e-105, 549.4389999999999, 0.1 + 0.2,
]  # fmt: skip


@pytest.mark.parametrize("value", REALS)
def test_a_real_number_is_read_as_it_was_to_ten_digits(value):
    (read,) = bulk_data(card("PBUSH", [7, "K", value]))
    assert read[:3] == ["PBUSH", 7, "K"]
    assert read[3] == pytest.approx(value, rel=1e-10, abs=0)
    assert isinstance(read[3], float)


def test_fields_are_small_where_these_hold_all_digits_and_large_elsewhere():
    assert card("GRID", [1, 0, -436.692, 0.5]).startswith("GRID    ")
    assert card("GRID", [1, 0, -436.69271, 0.5]).startswith("GRID*   ")


@pytest.mark.parametrize("last", [2.5, 1 / 3])
def test_lines_go_on_where_fields_do(last):
    fields = [9, "K", 1.0, 2.0, 3.0, None, None, 4.0, None, "GE", last]
    (read,) = bulk_data(card("PBUSH", fields))
    assert read[1:10] == [9, "K", 1.0, 2.0, 3.0, "", "", 4.0, ""]
    assert read[10:12] == ["GE", pytest.approx(last)]


def test_a_comment_is_short_lines_of_ascii_whatever_its_text():
    text = comment("ärger\n$ENDDATA with " + "many words " * 20)
    assert all(line.startswith("$ ") and len(line) <= 72 for line in text.splitlines())
    assert text.isascii()
    assert bulk_data(text) == []
