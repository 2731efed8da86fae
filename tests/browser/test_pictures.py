"""Pictures to take away, taken by real pages."""

from contextlib import suppress

import numpy as np
import pytest
from pages import wait_for

from modeviz.shapes.gltf import glb
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.viewer.driver import ShapeDriver, held
from modeviz.viewer.pictures import Shot, cycle, picture
from modeviz.viewer.stage import LIGHT

PANEL = np.array([[0.0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
SIDE = 160
RISE, DRIFT = 0.6, 0.3j
"""Of the panel up the picture and, a quarter of a cycle apart, across it, m."""


@pytest.fixture(scope="module")
def driver(server):
    """A panel that runs around an ellipse."""
    driver = ShapeDriver(server.scene)
    dark = MeshPart("panel", PANEL, FACES, Material((20, 20, 20)))
    driver.add("/panel", glb(surface((dark,))), 4)
    shape = np.zeros((4, 3), complex)
    shape[:, 1], shape[:, 2] = DRIFT, RISE
    driver.show({"/panel": shape})
    driver.drive(amplitude=1.0, frequency_hz=0.5, running=True)
    server.scene.world_axes.visible = False
    return driver


@pytest.fixture(scope="module")
def client(server, driver, page):
    wait_for(page, "window.__modeviz?.complete")
    client = max(server.get_clients().items())[1]
    client.camera.position, client.camera.look_at, client.camera.fov = (-10.0, 0, 0), (0.0, 0, 0), 0.5
    wait_for(page, "Math.abs(window.__viserMutable.camera.position.length() - 10) < 1e-3")
    return client


def center(image):
    """Where the panel is, m: right (−y) and up."""
    rows, columns = np.nonzero(np.asarray(image)[..., :3].max(axis=-1) < 200)
    metres = 2 * 10 * np.tan(0.25) / SIDE
    middle = (SIDE - 1) / 2
    return (columns.mean() - middle) * metres, (middle - rows.mean()) * metres


def test_frames_of_a_cycle_are_where_their_phases_put_them(client):
    n = 8
    frames = list(cycle(client, Shot(SIDE, SIDE, "white", LIGHT), n))
    angles = 2 * np.pi * np.arange(n) / n
    expected = np.stack([-(DRIFT * np.exp(1j * angles)).real, (RISE * np.exp(1j * angles)).real])
    pixel = 2 * 10 * np.tan(0.25) / SIDE
    assert np.transpose([center(f) for f in frames]) == pytest.approx(expected, abs=pixel)


def test_a_whole_turn_later_is_the_same_picture(client):
    shot = Shot(SIDE, SIDE, "white", LIGHT)
    with held(client) as hold:
        drawn = []
        for phase in (1.0, 4.0, 1.0 + 2 * np.pi):
            hold(phase)
            drawn.append(np.asarray(picture(client, shot)))
    np.testing.assert_array_equal(drawn[0], drawn[2])
    assert (drawn[0] != drawn[1]).any()


def test_a_page_goes_on_where_it_was_even_after_an_error_and_others_never_stop(
    server, driver, client, page, open_page
):
    other = open_page(server)
    wait_for(other, "window.__modeviz?.complete")
    with suppress(KeyError), held(client) as hold:
        hold(1.0)
        wait_for(page, "window.__modeviz.weights.value[0] === Math.cos(1)")
        held_at, other_at = (p.evaluate("window.__modeviz.phase") for p in (page, other))
        wait_for(other, "window.__modeviz.phase !== a.before", before=other_at)
        assert page.evaluate("window.__modeviz.phase") == held_at
        raise KeyError
    wait_for(page, "window.__modeviz.phase !== a.before", before=held_at)


def test_picture_has_the_size_asked_for_and_its_backdrop(client):
    for backdrop, corner in (
        ("scene", LIGHT.top),
        ("white", (255, 255, 255)),
        ("transparent", (0,) * 4),
    ):
        image = picture(client, Shot(96, 64, backdrop, LIGHT))
        assert image.size == (96, 64)
        assert image.getpixel((0, 0))[: len(corner)] == corner
    assert image.getpixel((48, 32))[3] == 255


def test_background_of_the_page_is_in_no_picture_and_stays_on_the_page(server, client, page):
    server.scene.set_background_image(np.full((4, 4, 3), (255, 0, 0), np.uint8), format="png")
    is_drawn = "window.__viserMutable.backgroundMaterial.uniforms.enabled.value"
    wait_for(page, is_drawn)
    image = picture(client, Shot(64, 64, "transparent", LIGHT))
    assert image.getpixel((0, 0))[3] == 0
    wait_for(page, "window.__viserMutable.backgroundMaterial.visible")
    server.scene.set_background_image(None)
    wait_for(page, f"!{is_drawn}")
