"""The page of bodies in a browser."""

import numpy as np
import pytest
from looked_at import heaving_and_twisting, plate
from pages import wait_for

from modeviz.shapes.motion import DRAWN_FRACTION
from modeviz.viewer.inspection.app import InspectionApp
from modeviz.viewer.inspection.state import Content
from modeviz.viewer.inspection.subject import subject_of_component

SHAPE = """
(() => {
  let mesh;
  window.__viserMutable.nodeRefFromName[a.name]?.traverse((object) => {
    if (object.geometry?.index) mesh ??= object;
  });
  const { modevizReal: real, modevizImaginary: imaginary } = mesh?.geometry.attributes ?? {};
  return real ? [real, imaginary].map(({ array }) => Array.from(array)) : null;
})()
"""


@pytest.fixture(scope="module")
def app(server):
    subjects = [
        subject_of_component(plate(heaving_and_twisting(kind)), name, None)
        for name, kind in (("computed", float), ("measured", complex))
    ]
    app = InspectionApp(server, Content("plates", tuple(subjects), ("Nothing holds them.",)))
    server.scene.configure_environment_map(None)
    return app


@pytest.fixture(scope="module")
def page(app, open_page):
    return open_page(app.server, (1100, 800))


def title(page):
    return page.locator(".mv .title").inner_text()


def test_the_first_mode_that_deforms_moves_and_is_named(page):
    assert "Computed" in title(page)
    assert "20.00 Hz" in title(page)
    assert page.get_by_text("Nothing holds them.").is_visible()
    real, imaginary = wait_for(page, SHAPE, name="/vehicle/computed")
    halves = np.array(real, np.uint16).view(np.float16) if max(map(abs, real)) > 100 else np.array(real)
    up = np.abs(halves.reshape(-1, 3)[:, 2].astype(float))
    np.testing.assert_allclose(up, DRAWN_FRACTION, rtol=1e-3)
    assert not np.any(imaginary)


def test_a_click_on_a_mode_shows_it(page):
    page.get_by_text("Mode 1", exact=True).click()
    wait_for(page, "!document.querySelector('.mv .title').innerText.includes('Hz')")
    page.keyboard.press("n")
    wait_for(page, "document.querySelector('.mv .title').innerText.includes('20.00 Hz')")


def test_a_measured_body_moves_in_quadrature(page, app):
    app.inspection.look_at("measured")
    wait_for(page, "document.querySelector('.mv .title').innerText.startsWith('Measured')")
    assert not app.scene.driver.is_real
    assert page.get_by_text("Complex mode 2", exact=True).is_visible()
