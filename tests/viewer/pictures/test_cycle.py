"""A cycle in pictures: those that look alike are drawn once."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from modeviz.viewer.page.server import open_server
from modeviz.viewer.pictures import pictures
from modeviz.viewer.pictures.pictures import Cycle, ImageSettings, Pose, cycle_pictures
from modeviz.viewer.scene.driver import ShapeDriver
from modeviz.viewer.scene.stage import LIGHT

POSE = Pose(np.array([1.0, 0, 0, 0]), np.zeros(3))
SHOT = ImageSettings(16, 16, "white", LIGHT, 0.5)
SHAPE = 0.8 - 0.6j


@pytest.mark.parametrize("n", [2, 3, 5, 8, 36])
@pytest.mark.parametrize("shape", [SHAPE.real, SHAPE], ids=["real", "complex"])
def test_every_frame_shows_the_shape_where_its_phase_puts_it(n, shape):
    cycle = Cycle(n, is_real=np.isrealobj(shape))
    drawn = [(shape * np.exp(2j * np.pi * k / n)).real for k in range(cycle.n_drawn)]
    expected = (shape * np.exp(2j * np.pi * np.arange(n) / n)).real
    np.testing.assert_allclose([drawn[i] for i in cycle.order], expected, atol=1e-12)


@pytest.mark.parametrize(("is_real", "n_asked"), [(True, 19), (False, 36)])
def test_of_a_real_shape_half_the_frames_are_drawn_and_progress_goes_by_these(
    monkeypatch, is_real, n_asked
):
    image = Image.new("RGB", (16, 16))
    asked, phases, told = [], [], []
    monkeypatch.setattr(pictures, "picture", lambda *_: asked.append(phases[-1]) or image)
    cycle = Cycle(36, is_real)
    assert (
        list(cycle_pictures(None, phases.append, SHOT, POSE, cycle, told.append)) == [image] * n_asked
    )
    assert len(asked) == len(phases) == n_asked
    assert told == pytest.approx(np.arange(n_asked) / n_asked)
    assert [b - a for a, b in pairwise(phases)] == pytest.approx([np.pi / 18] * (n_asked - 1))


def test_shapes_are_real_while_none_is_complex():
    server = open_server(port=0)
    try:
        driver = ShapeDriver(server.scene)
        for name in ("/cab", "/bed"):
            driver.add(name, b"", 4)
        assert driver.is_real
        driver.show({"/cab": np.ones((4, 3))})
        assert driver.is_real
        driver.show({"/bed": np.full((2, 3), 1j)})
        assert not driver.is_real
        driver.remove("/bed")
        assert driver.is_real
    finally:
        server.stop()
