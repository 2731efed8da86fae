"""Frequencies as a person writes them."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.viewer.session.planning.frequencies import parse_frequencies, spoken_frequencies

PAPER = np.linspace(6, 14, 25)


def test_the_papers_road_is_a_range_in_thirds():
    assert spoken_frequencies(PAPER) == "6 to 14 by 1/3"
    assert (parse_frequencies("6 to 14 by 1/3") == PAPER).all()


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("11, 13.25,15.75", [11, 13.25, 15.75]),
        (" .5 ", [0.5]),
        ("6 to 8 by 0.5, 7, 20", [6, 6.5, 7, 7.5, 8, 20]),
        ("6to7by2/4", [6, 6.5, 7]),
        ("1 to 2 by 0.4", [1, 1.4, 1.8]),
        ("9, 3", [3, 9]),
    ],
)
def test_numbers_and_ranges_are_read_rising_and_each_once(text, found):
    assert parse_frequencies(text) == pytest.approx(found, rel=1e-15)


@pytest.mark.parametrize(
    ("frequency_hz", "spoken"),
    [
        ([11.0, 13.25, 15.75], "11, 13.25, 15.75"),
        ([1.0, 2.0, 3.0], "1, 2, 3"),
        ([1.0, 2.0, 3.0, 5.0], "1, 2, 3, 5"),
        (np.linspace(1, 2, 11), "1 to 2 by 0.1"),
        (np.linspace(1, np.pi, 7), "1 to 3.141592654 by 0.3569321089"),
    ],
)
def test_they_are_written_as_they_are_read(frequency_hz, spoken):
    assert spoken_frequencies(np.array(frequency_hz)) == spoken
    assert parse_frequencies(spoken) == pytest.approx(frequency_hz, rel=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "6 to 14",
        "6–14",
        "8,,9",
        "-3",
        "1e3",
        "nan",
        "14 to 6 by 1",
        "6 to 14 by 0",
        "6 to 7 by 1/0",
    ],
)
def test_what_is_no_frequency_is_named(text):
    with pytest.raises(
        VehicleError, match=r"frequencies: found '.*', expected numbers and ranges in Hz"
    ):
        parse_frequencies(text)


@pytest.mark.parametrize(
    "text", ["1 to 1000 by 0.1", "1 to 2 by 1/999999999", "1 to 999 by 1, " * 3 + "1"]
)
def test_more_than_anybody_waits_for_are_refused(text):
    with pytest.raises(VehicleError, match="found more than 2000: take a wider step"):
        parse_frequencies(text)
