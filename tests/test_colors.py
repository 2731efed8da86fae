import numpy as np

from modeviz.shapes.colors import (
    DISPLACEMENT_STOPS,
    color_map,
    displacement_colors,
)


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
