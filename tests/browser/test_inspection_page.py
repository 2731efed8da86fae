"""The page of bodies in a browser."""

import base64
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import pytest
from free_network import MASSES
from looked_at import heaving_and_twisting, plate
from network_files import network_unv
from pages import wait_for, wait_until

from modeviz.files import read_vehicle
from modeviz.shapes.motion import DRAWN_FRACTION
from modeviz.viewer.inspection.app import InspectionApp
from modeviz.viewer.inspection.sources import VehicleFolder
from modeviz.viewer.inspection.state import Content
from modeviz.viewer.inspection.subject import subject_of_component
from modeviz.viewer.page.server import open_server

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


@dataclass(frozen=True)
class Given:
    """What there is to look at, without files."""

    content: Content
    folder: None = None

    def read(self):
        return self.content


@contextmanager
def open_app(server, source):
    """The page of bodies, which stand still and cast no shadows, of which each picture takes long."""
    app = InspectionApp(server, source)
    server.scene.configure_environment_map(None)
    app.scene._stage._key.cast_shadow = False
    app._animation._run(False)
    app._animation._ran_before_still = None
    try:
        yield app
    finally:
        app.end()


@pytest.fixture(scope="module")
def app(server):
    subjects = [
        subject_of_component(plate(heaving_and_twisting(kind)), name, None)
        for name, kind in (("computed", float), ("measured", complex))
    ]
    source = Given(Content("plates", tuple(subjects), ("Nothing holds them.",)))
    with open_app(server, source) as app:
        yield app


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


TAKES_FILES = """(() => {
  const carrier = new DataTransfer();
  carrier.items.add(new File([], "none"));
  const event = { dataTransfer: carrier, bubbles: true, cancelable: true };
  return !document.querySelector("canvas").dispatchEvent(new DragEvent("dragover", event));
})()"""

DROP = """([names, contents]) => {
  const carrier = new DataTransfer();
  names.forEach((name, i) => {
    const bytes = Uint8Array.from(atob(contents[i]), (letter) => letter.charCodeAt(0));
    carrier.items.add(new File([bytes], name));
  });
  const event = { dataTransfer: carrier, bubbles: true, cancelable: true };
  const canvas = document.querySelector("canvas");
  return ["dragover", "drop"].map((kind) => !canvas.dispatchEvent(new DragEvent(kind, event)));
}"""


def drop(page, files):
    contents = [base64.b64encode(content.encode()).decode() for content in files.values()]
    wait_for(page, TAKES_FILES)
    assert page.evaluate(DROP, [[*files], contents]) == [True, True]  # or the browser would open them


def choose(page, dropdown, option):
    page.get_by_role("combobox", name=dropdown, exact=True).click()
    page.get_by_role("option", name=option, exact=True).click()


def fill(page, label, text, widget):
    """Fills the field of that label, the last of the page, and waits until it is heard of."""
    labelled = page.get_by_text(label, exact=True).last
    labelled.locator("xpath=ancestor::*[.//input][1]//input").fill(text)
    wait_until(page, lambda: widget.value == text)


@pytest.fixture
def new_vehicle(tmp_path, open_page):
    """An empty folder, and its page with what is in the fields on it."""
    server = open_server(port=0)
    server.scene.configure_default_lights(cast_shadow=False)
    with open_app(server, VehicleFolder(tmp_path)) as app:
        page = open_page(server, (1100, 800))
        yield tmp_path, page, app
        page.close()
    server.stop()


def test_dropped_files_become_a_body_of_the_vehicle(new_vehicle):
    folder, page, app = new_vehicle
    geometry, modes = network_unv(n_modes=0), network_unv().replace("2411", "9999", 1)
    drop(page, {"shape.unv": geometry, "modes.unv": modes})
    page.get_by_text("shape.unv, modes.unv").wait_for()
    wait_for(page, "document.querySelector('.mv .title').innerText.startsWith('Shape')")
    page.get_by_role("button", name="Put it into the vehicle").click()
    page.get_by_text("the file doesn't say its units").wait_for()
    assert not any(folder.iterdir())

    choose(page, "Units", "mm-t-s")
    page.get_by_text("Units: mm-t-s.").wait_for(state="attached")
    fill(page, "Attachments", "left=11; right=12", app._import._fields.attach)
    page.get_by_role("button", name="Put it into the vehicle").click()
    page.get_by_text("Body shape: in the vehicle").wait_for()
    (body,) = read_vehicle(folder).bodies
    assert [attachment.name for attachment in body.attachments] == ["left", "right"]
    assert body.mass == pytest.approx(MASSES.sum() * 1000)
    assert page.get_by_text("Nothing holds its bodies together").is_visible()


def test_response_points_are_added_to_the_vehicle_on_the_page(new_vehicle):
    folder, page, app = new_vehicle
    drop(page, {"shape.unv": network_unv()})
    page.get_by_text("shape.unv", exact=True).wait_for()
    assert not page.get_by_role("button", name="Add the response point").is_visible()
    choose(page, "Units", "mm-t-s")
    page.get_by_text("Units: mm-t-s.").wait_for(state="attached")
    fill(page, "Attachments", "left=11; right=12", app._import._fields.attach)
    page.get_by_role("button", name="Put it into the vehicle").click()
    page.get_by_text("Body shape: in the vehicle").wait_for()

    add = page.get_by_role("button", name="Add the response point")
    add.click()
    page.locator(".bad").get_by_text("found no name").wait_for()
    choose(page, "At", "right")
    fill(page, "Name", "seat", app._points._name)
    add.click()
    page.get_by_text("Response point seat: in the vehicle.").wait_for()
    vehicle = read_vehicle(folder)
    (point,) = vehicle.response_points
    np.testing.assert_array_equal(point.position, vehicle.body("shape").attachment("right").position)
    page.get_by_text("Nobody feels it").wait_for(state="detached")


def test_files_that_make_no_body_say_why_on_the_page(new_vehicle):
    folder, page, app = new_vehicle
    drop(page, {"held.unv": network_unv(first=7)})
    page.get_by_text("held.unv", exact=True).wait_for()
    page.get_by_role("combobox", name="Units").click()
    page.get_by_role("option", name="mm-t-s").click()
    wait_until(page, lambda: app._import._fields.chosen_units)
    page.get_by_role("button", name="Put it into the vehicle").click()
    page.locator(".bad").get_by_text("expected the six rigid ones of a free structure").wait_for()
    assert not any(folder.iterdir())
    page.get_by_role("button", name="Other files").click()
    page.get_by_text("Drop files here").wait_for()
