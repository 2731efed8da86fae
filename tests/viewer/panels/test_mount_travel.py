import numpy as np
import pytest

from modeviz.viewer.panels.mounts.travel import STEP, Travel, travel

TRUCK = Travel(73.5e3, 882e3)


def test_every_position_gives_a_rate_that_gives_the_position_back():
    for way in (TRUCK, Travel(273.5e3, 3282e3), Travel(1e4, 1e7), Travel(137.75e3, 1653e3)):
        for marked in (0.0, way.softest, 294e3, 2.2222e6, way.stiffest):
            rates = [way.rate(p, marked) for p in range(way.length + 1)]
            assert [way.position(rate) for rate in rates] == list(range(way.length + 1))


def test_the_marked_rate_is_given_exactly_and_only_at_its_step():
    marked = 294123.456789
    at = TRUCK.position(marked)
    assert TRUCK.rate(at, marked) == marked
    assert marked not in (TRUCK.rate(at - 1, marked), TRUCK.rate(at + 1, marked))


def test_a_marked_rate_beyond_the_slider_is_at_neither_end():
    assert TRUCK.rate(0, 0.0) == 73.5e3
    assert TRUCK.rate(TRUCK.length, 1e9) == 882e3


def test_equal_steps_are_equal_factors_of_at_most_one_percent():
    rates = np.array([TRUCK.rate(p, 0.0) for p in range(TRUCK.length + 1)])
    factors = rates[1:] / rates[:-1]
    step = (882 / 73.5) ** (1 / TRUCK.length)
    assert 1.0 < step <= 1 + STEP
    # Four digits leave half a unit in the fourth on either side.
    np.testing.assert_allclose(factors, step, rtol=1.0e-3)


def test_the_middle_is_the_geometric_mean():
    way = Travel(1e4, 1e6)
    assert way.rate(way.length / 2, 0.0) == pytest.approx(1e5, rel=1e-3)


def test_rates_beyond_the_bounds_are_at_the_ends():
    assert TRUCK.position(0.0) == 0
    assert TRUCK.position(1.0) == 0
    assert TRUCK.position(1e9) == TRUCK.length


def test_known_rates_widen_the_bounds_and_zero_does_not():
    assert travel(1e5, 1e6, [2e5]) == Travel(1e5, 1e6)
    assert travel(1e5, 1e6, [0.0, 5e4, 3e6]) == Travel(5e4, 3e6)


def test_a_bound_of_zero_leaves_three_decades():
    assert travel(0.0, 1e6, [1e6]) == Travel(1e3, 1e6)
