import numpy as np

from modeviz.shapes.colors import (
    COLOR_STOPS,
    Shade,
    color_map,
    displacement_shade,
    motion_shades,
    share_shade,
)
from modeviz.shapes.motion import mean_square, peak_displacement


def shaded(shape, shade):
    """The colours of vertices (n_vertices, 3) as the page's shader computes them."""
    measures = {0: lambda u: np.ones(len(u)), 1: peak_displacement, 2: mean_square}
    return color_map(shade.gain * measures[shade.power](shape))


def test_color_map_passes_through_its_stops_and_stays_within_its_ends():
    colors = color_map(np.array([-1, 0, 0.2, 0.4, 0.6, 0.8, 1, 2]))
    names = ["#" + bytes(color).hex() for color in colors]
    assert tuple(names[1:-1]) == COLOR_STOPS
    assert (names[0], names[-1]) == (names[1], names[-2])


def test_color_halfway_between_two_stops_is_their_mean():
    assert color_map(np.array([0.1])).tolist() == [[60, 111, 144]]  # of 3a5480 and 3e8aa0


def test_displacement_colors_follow_the_distance_and_not_the_direction():
    shape = np.array([[0, 0, 2.0], [-2.0, 0, 0], [0, 1j, 0], [0, 0, 0]])
    colors = shaded(shape, displacement_shade(2.0))
    assert colors.tolist() == color_map(np.array([1, 1, 0.5, 0])).tolist()


def test_vehicle_that_does_not_move_has_the_first_color_everywhere():
    for shade in (displacement_shade(0.0), share_shade(0.0, 0.0)):
        assert np.unique(shaded(np.zeros((5, 3)), shade), axis=0).tolist() == [[58, 84, 128]]
    assert motion_shades({"cab": 0.5}, {"cab": np.zeros((5, 3))}, 0.5) == {"cab": Shade(0.0, 2)}


def test_body_has_the_color_of_its_share_where_it_moves_most_and_of_a_quarter_at_half_of_that():
    shapes = {"cab": np.array([[0, 0, 2.0], [1j, 0, 0]]), "box": np.array([[0.3, 0, 0], [0, 0, 0]])}
    shades = motion_shades({"cab": 0.6, "box": 0.15}, shapes, largest=0.6)
    assert shaded(shapes["cab"], shades["cab"]).tolist() == color_map(np.array([1, 0.25])).tolist()
    assert shaded(shapes["box"], shades["box"]).tolist() == color_map(np.array([0.25, 0])).tolist()


def test_share_colors_the_whole_of_a_body():
    colors = shaded(np.array([[0, 0, 2.0], [0, 0, 0]]), share_shade(0.2, largest=0.5))
    assert colors.tolist() == color_map(np.array([0.4, 0.4])).tolist()
