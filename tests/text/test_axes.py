import numpy as np
import pytest

from modeviz.text.axes import Axis, decibel_axis


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (1, 25, ["5", "10", "15", "20", "25"]),
        (-80, -20, ["−80", "−70", "−60", "−50", "−40", "−30", "−20"]),
        (0, 2.1e-3, ["0.0000", "0.0005", "0.0010", "0.0015", "0.0020"]),
        (-0.3, 0.3, ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]),
        (0, 3, ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]),
    ],
)
def test_even_ticks_are_round_and_have_a_true_minus(low, high, labels):
    assert [text for _, text in Axis("f", low, high).ticks()] == labels


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (1, 25, ["1", "2", "5", "10", "20"]),
        (0.3, 3, ["0.5", "1", "2"]),
        (1e-5, 1, ["10⁻⁵", "10⁻⁴", "10⁻³", "0.01", "0.1", "1"]),
        (1e-20, 1, ["10⁻²⁰", "10⁻¹⁷", "10⁻¹⁴", "10⁻¹¹", "10⁻⁸", "10⁻⁵", "0.01"]),
    ],
)
def test_ticks_of_a_logarithm_are_decades_or_their_1_2_5(low, high, labels):
    assert [text for _, text in Axis("f", low, high, is_logarithmic=True).ticks()] == labels


@pytest.mark.parametrize("is_logarithmic", [False, True])
def test_every_tick_says_the_value_it_stands_at(is_logarithmic):
    for low, high in [(1, 25), (0.1, 40), (3, 7), (0.2, 9000)]:
        axis = Axis("f", low, high, is_logarithmic)
        assert 2 <= len(axis.ticks()) <= 20
        for value, text in axis.ticks():
            assert float(text.replace("10⁴", "1e4")) == pytest.approx(value)
            assert -1e-9 <= axis.place(value) <= 1 + 1e-9


def test_a_logarithmic_axis_gives_every_octave_the_same_room():
    places = Axis("f", 1, 16, is_logarithmic=True).place([1.0, 2.0, 4.0, 8.0, 16.0])
    np.testing.assert_allclose(places, [0, 0.25, 0.5, 0.75, 1], atol=1e-15)


def test_what_has_no_logarithm_is_far_below():
    assert Axis("f", 1, 10, is_logarithmic=True).place(0.0) == pytest.approx(-9)


def test_an_axis_of_decibels_holds_its_curves_down_to_60_db():
    axis = decibel_axis("dB", [np.array([-31.0, -58.0]), np.array([-22.0, -43.0])])
    assert (axis.low, axis.high) == (-60, -20)
    deep = decibel_axis("dB", [np.array([-21.0, -200.0])])
    assert (deep.low, deep.high) == (-80, -20)
    silent = decibel_axis("dB", [np.full(3, -200.0)])
    assert (silent.low, silent.high) == (-210, -200)
