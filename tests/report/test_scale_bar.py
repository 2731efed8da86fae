"""The scale of colours in a picture: its colours in their order, legible, or else not there."""

import numpy as np
import pytest
from PIL import Image

from modeviz.report.scale_bar import ScaleBar, with_scale
from modeviz.shapes.colors import stop_colors

BAR = ScaleBar("Displacement", "100 %", stop_colors(), (16, 20, 26), (255, 255, 255))
PAPER = (40, 90, 60)


def drawn(width, height, mode="RGB"):
    return with_scale(Image.new(mode, (width, height), PAPER), BAR)


def places_of(image, color):
    """Where a colour is, (n, 2), row and column."""
    return np.argwhere((np.asarray(image)[..., :3] == color).all(axis=-1))


@pytest.mark.parametrize(("width", "height"), [(1280, 720), (640, 360), (400, 1000), (3840, 2160)])
def test_colours_stand_in_their_order_in_the_lower_left_corner(width, height):
    image = drawn(width, height)
    first, *_, last = [places_of(image, stop) for stop in (stop_colors()[0], stop_colors()[-1])]
    assert first.size
    assert first[:, 1].max() < last[:, 1].min()
    for rows, columns in (first.T, last.T):
        assert rows.min() > 0.8 * height
        assert columns.max() < 0.75 * width
    middle = image.getpixel((int(first[:, 1].mean() + last[:, 1].mean()) // 2, int(first[0, 0])))
    np.testing.assert_allclose(middle, stop_colors()[2:4].mean(axis=0), atol=12)


def test_letters_stand_on_paper_of_their_own():
    image = drawn(1280, 720)
    plate = np.argwhere((np.asarray(image) != PAPER).any(axis=-1))
    (top, left), (bottom, right) = plate.min(axis=0), plate.max(axis=0)
    ink = places_of(image, BAR.ink)
    bar = places_of(image, stop_colors()[0])[:, 1].min()
    assert ink[:, 1].min() < bar - 60  # "Displacement" is before the bar
    assert ink[:, 1].max() > places_of(image, stop_colors()[-1])[:, 1].max()  # and "100 %" behind
    assert bottom - top < 0.08 * 720
    assert left > 0
    assert right < 1280 / 2


def test_a_picture_too_small_to_read_it_in_is_left_alone():
    assert np.ptp(np.asarray(drawn(96, 64)).reshape(-1, 3), axis=0).tolist() == [0, 0, 0]


@pytest.mark.parametrize("mode", ["RGB", "RGBA"])
def test_pictures_keep_their_kind(mode):
    assert drawn(640, 360, mode).mode == mode


def test_the_scale_is_opaque_enough_on_a_transparent_picture():
    image = with_scale(Image.new("RGBA", (640, 360), (0, 0, 0, 0)), BAR)
    alpha = np.asarray(image)[..., 3]
    assert alpha[0, 0] == 0
    assert set(np.unique(alpha)) - {0} <= set(range(200, 256))
