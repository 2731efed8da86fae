import numpy as np
import pytest

from modeviz.shapes.colors import (
    DISPLACEMENT_STOPS,
    color_map,
    displacement_colors,
    linear_to_srgb,
    srgb_to_linear,
)


def test_middle_grey_of_srgb_reflects_a_fifth_of_the_light():
    # IEC 61966-2-1: code value 119 is 18.4 % linear; the line and the curve meet at 0.04045
    assert srgb_to_linear(119 / 255) == pytest.approx(0.1845, abs=5e-5)
    assert srgb_to_linear([0, 0.04045, 1]) == pytest.approx([0, 0.0031308, 1], abs=1e-7)


def test_linear_to_srgb_undoes_srgb_to_linear():
    values = np.arange(256) / 255
    assert linear_to_srgb(srgb_to_linear(values)) == pytest.approx(values, abs=1e-6)


def test_color_map_passes_through_its_stops_and_stays_within_its_ends():
    colors = color_map(np.array([-1, 0, 0.2, 0.4, 0.6, 0.8, 1, 2]))
    names = ["#" + bytes(color).hex() for color in colors]
    assert tuple(names[1:-1]) == DISPLACEMENT_STOPS
    assert (names[0], names[-1]) == (names[1], names[-2])


def test_color_halfway_between_two_stops_is_their_mean():
    assert color_map(np.array([0.1])).tolist() == [[60, 111, 144]]  # of 3a5480 and 3e8aa0


def test_displacement_colors_follow_the_distance_and_not_the_direction():
    shape = np.array([[0, 0, 2.0], [-2.0, 0, 0], [0, 1j, 0], [0, 0, 0]])
    assert displacement_colors(shape, 2.0).tolist() == color_map(np.array([1, 1, 0.5, 0])).tolist()


def test_vehicle_that_does_not_move_has_the_first_color_everywhere():
    assert np.unique(displacement_colors(np.zeros((5, 3)), 0.0), axis=0).tolist() == [[58, 84, 128]]
