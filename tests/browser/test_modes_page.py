"""Choosing what moves and how, in the page of the smallest vehicle."""

import re
from dataclasses import replace

import numpy as np
import pytest
from apps import listening, n_bytes, open_app
from mounted_cabin import mounted_cabin
from pages import send, wait_for, wait_until
from session_commands import Alter, Become

from modeviz.analysis.results import Conditions
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.commands.looks import ShowMode
from modeviz.viewer.session.state import first_state

SOLVE_S = 60
HALF = 2.0**-11  # relative rounding of half precision
BOX = np.array([[x, y, z] for x in (-0.9, 0.9) for y in (-0.7, 0.7) for z in (-0.4, 0.4)])
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
FACES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
PHASE = "window.__modeviz.phase"
FREQUENCY = "window.__viserMutable.nodePoseData['/_driver'].position[1]"

DRAWN = """
(() => {
  let mesh;
  window.__viserMutable.nodeRefFromName[a.name]?.traverse((object) => {
    if (object.geometry?.index) mesh ??= object;
  });
  const { position, modevizReal, modevizImaginary } = mesh?.geometry.attributes ?? {};
  if (!modevizReal) return null;
  const values = ({ array }) => [array instanceof Uint16Array, Array.from(array)];
  return [position, modevizReal, modevizImaginary].map(values);
})()
"""


WATCH_PAUSE = f"""(() => {{
  let ran = false;
  const look = () => {{
    ran ||= {FREQUENCY} > 0;
    if (ran && {FREQUENCY} === 0) window.stood = {PHASE};
    else requestAnimationFrame(look);
  }};
  look();
}})()"""
"""Keeps the phase of the first frame in which the motion that will begin has ended."""


def cabin_with_boxes():
    vehicle = mounted_cabin()
    bodies = tuple(
        replace(b, mesh=(MeshPart("box", b.center_of_gravity + BOX, FACES, Material((90, 90, 90))),))
        for b in vehicle.bodies
    )
    return replace(vehicle, bodies=bodies)


@pytest.fixture(scope="module")
def app(server):
    with open_app(server, cabin_with_boxes(), Conditions("flat", 20.0)) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(1280, 640))
    wait_for(page, DRAWN, name="/vehicle/cab")
    return page


@pytest.fixture(autouse=True)
def first(app, page):
    """Every test starts with what the session opened with, standing still."""
    state = first_state(app.session.vehicle, app.session.vehicle.rates, Conditions("flat", 20.0))
    app.screen.motion.animation._run(False)
    app.session.do(Become(state))
    assert app.session.wait(SOLVE_S)
    shown(app, page)


def drawn(page, body):
    """The vertices of a body and how each is drawn to move, (n_vertices, 3), complex."""
    read = wait_for(page, DRAWN, name=f"/vehicle/{body}")
    numbers = [np.array(v, np.uint16).view(np.float16) if half else np.array(v) for half, v in read]
    position, real, imaginary = (np.reshape(n, (-1, 3)).astype(float) for n in numbers)
    return position, real + 1j * imaginary


def expected(app, body, position):
    """How a rigid body's vertices move in the newest answer, of no particular size."""
    moving = app.session.answer.movement.shape[app.session.answer.now.prepared.system.dofs[body]]
    arms = position - app.session.vehicle.body(body).center_of_gravity
    return moving[:3] + np.cross(moving[3:], arms)


def is_shown(app, page):
    """Whether the page draws the newest answer's shape, to the rounding of halves."""
    pairs = [(drawn(page, b), b) for b in ("cab", "chassis")]
    found = np.concatenate([shape for (_, shape), _ in pairs])
    exact = np.concatenate([expected(app, b, position) for (position, _), b in pairs])
    scale = np.linalg.norm(found) / np.linalg.norm(exact)
    return np.abs(found - scale * exact).max() < 4 * HALF * scale * np.abs(exact).max()


def shown(app, page):
    wait_until(page, lambda: is_shown(app, page))


def pick(page, box, option):
    page.get_by_role("combobox", name=box).click()
    page.get_by_role("option", name=option, exact=True).click()


def open_tab(page, name):
    page.get_by_role("tab", name=name).click()


def test_a_mode_picked_in_the_table_is_drawn(app, page):
    _, before = drawn(page, "cab")
    page.locator(".mv .modes label", has_text="Cab roll").click()
    wait_until(page, lambda: app.session.state.motion.mode == "cab roll")
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    _, after = drawn(page, "cab")
    assert np.abs(after - before).max() > 0.01
    wait_for(page, "document.querySelector('.mv .title').textContent.includes('Cab roll')")


def test_a_damped_mode_is_drawn_with_its_true_phases(app, page):
    assert not drawn(page, "cab")[1].imag.any()
    open_tab(page, "What moves")
    pick(page, "Shows", "Mode with damping")
    wait_until(page, lambda: app.session.answer.movement.about.startswith("damped"))
    shown(app, page)
    _, shape = drawn(page, "cab")
    assert np.abs(shape.imag).max() > 8 * HALF * np.abs(shape).max()


def test_the_operating_shape_follows_rates_and_frequency(app, page):
    open_tab(page, "What moves")
    pick(page, "Shows", "Shape at a frequency")
    wait_for(page, "document.querySelector('.mv .title').textContent === 'Operating shape  11.00 Hz'")
    shown(app, page)
    before = drawn(page, "cab")[1]
    app.session.do(SetRate("A", "lateral", 1e5))
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    softer = drawn(page, "cab")[1]
    assert np.abs(softer - before).max() > 0.01
    send(page, app.screen.motion.shape._frequency, 14.0)
    wait_until(page, lambda: app.session.answer.movement.frequency_hz == 14.0)
    shown(app, page)
    assert np.abs(drawn(page, "cab")[1] - softer).max() > 0.01


def test_sag_stands_still_as_large_as_is_said_and_follows_rates(app, page):
    app.screen.motion.animation._run(True)
    open_tab(page, "Static")
    page.get_by_label("Draw sag").check()
    wait_for(page, "document.querySelector('.mv .title').textContent === 'Sag: standing'")
    wait_for(page, f"{FREQUENCY} === 0 && {PHASE} === 0")
    shown(app, page)
    (words,) = page.get_by_text("times as large as it is").all_text_contents()
    said = float(re.search(r"Drawn ([\d.]+) times", words)[1])
    position, shape = drawn(page, "cab")
    is_large = expected(app, "cab", position)
    assert np.abs(shape).max() / np.abs(is_large).max() == pytest.approx(said, rel=0.06)
    app.session.do(SetRate("A", "vertical", 1e5))
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    force = app.session.answer.static.now.case("standing").connections["A 0.5"].force[2]
    wait_for(page, "document.body.innerText.includes(a.force)", force=f"{force:.0f}")
    page.get_by_label("Draw sag").uncheck()
    wait_for(page, f"{FREQUENCY} > 0")
    app.screen.motion.animation._run(False)


def test_a_peak_is_one_click_away(app, page):
    open_tab(page, "What moves")
    app.session.do(Alter(kind="operating shape", operating_hz=20.0))
    page.get_by_role("button", name=re.compile(r"^1\d\.\d$")).first.click()
    wait_until(page, lambda: app.session.state.motion.operating_hz != 20.0)
    f, psd = app.session.answer.now.frequency_hz, app.session.answer.now.response(0, "lateral")
    line = int(np.flatnonzero(np.isclose(f, app.session.state.motion.operating_hz))[0])
    assert psd[line] > max(psd[line - 1], psd[line + 1])


def test_a_body_alone_is_all_that_is_seen_and_its_modes_are_a_click_away(app, page):
    open_tab(page, "What moves")
    pick(page, "Shows", "One body alone")
    pick(page, "Body", "Chassis")
    wait_for(page, "document.querySelector('.mv .title').textContent.startsWith('Chassis alone')")
    visible = "window.__viserMutable.nodeRefFromName[a.name].visible"
    wait_for(page, f"!{visible}", name="/vehicle/cab")
    wait_for(page, visible, name="/vehicle/chassis")
    page.locator(".mv .energy label", has_text="Yaw").first.click()
    wait_for(page, "document.querySelector('.mv .title').textContent === 'Chassis alone: yaw'")
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    app.session.do(ShowMode("cab yaw"))
    wait_for(page, visible, name="/vehicle/cab")


def test_the_scale_of_colours_is_on_both_tabs_of_the_card(app, page):
    app.session.do(Alter(coloring="displacement"))
    for tab in ("What moves", "Motion"):
        open_tab(page, tab)
        page.locator(".mv .scale >> visible=true", has_text="Displacement").wait_for()
    app.session.do(Alter(coloring="bodies"))
    page.locator(".mv .scale >> visible=true").wait_for(state="detached")


def test_what_cannot_move_is_said_on_the_card(app, page):
    app.session.do(Alter(kind="operating shape", operating_hz=99.0))
    open_tab(page, "Motion")
    wait_for(
        page, "[...document.querySelectorAll('.mv .bad')].some(e => e.textContent.includes('99 Hz'))"
    )


def test_undo_takes_a_rate_back_and_leaves_what_moves(app, page):
    open_tab(page, "What moves")
    before = app.session.state.design
    app.session.do(SetRate("A", "lateral", 1e5))
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    pick(page, "Shows", "Mode with damping")
    wait_until(page, lambda: app.session.state.motion.kind == "damped mode")
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: app.session.state.design == before)
    assert app.session.wait(SOLVE_S)
    shown(app, page)
    assert page.get_by_role("combobox", name="Shows").input_value() == "Mode with damping"


def test_scrubbing_goes_to_the_phase_and_stops(app, page):
    app.screen.motion.animation._run(True)
    wait_for(page, f"{FREQUENCY} > 0")
    send(page, app.screen.motion.animation._phase, 215.0)
    wait_for(page, f"Math.abs({PHASE} - a.phase) < 1e-5", phase=np.deg2rad(215))
    assert not app.scene.driver._running


def test_pausing_keeps_the_phase_that_is_seen_and_the_slider_says_it(app, page):
    open_tab(page, "Motion")
    phase = app.screen.motion.animation._phase
    send(page, phase, 0.0)
    wait_for(page, f"{PHASE} === 0")
    page.evaluate(WATCH_PAUSE)
    page.get_by_role("button", name="Play", exact=True).click()
    wait_for(page, f"{PHASE} > 0.3")
    page.get_by_role("button", name="Pause", exact=True).click()
    wait_until(page, lambda: phase.value != 0)
    stood = wait_for(page, "window.stood")
    assert np.rad2deg(stood) % 360 == pytest.approx(phase.value, abs=0.5 + 1e-6)
    wait_for(page, f"Math.abs({PHASE} - a.phase) < 1e-5", phase=np.deg2rad(phase.value))
    row = page.get_by_text("Phase", exact=True).locator("xpath=ancestor::*[.//input][1]")
    wait_until(page, lambda: row.locator("input").last.input_value() == f"{phase.value:g}")
    assert not app.scene.driver._running


@pytest.mark.parametrize(("slider", "value"), [("_amplitude", 1.5), ("_speed", 0.8), ("_phase", 120.0)])
def test_moving_amplitude_speed_or_phase_sends_less_than_1_kb(app, server, page, slider, value):
    assert app.session.wait_checked(SOLVE_S)  # else it goes on sending how far the check is
    with listening(server) as socket:
        send(page, getattr(app.screen.motion.animation, slider), value)
        sent = n_bytes(socket)
    assert 0 < sent < 1000
