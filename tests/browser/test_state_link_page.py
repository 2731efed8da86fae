"""A link that is copied on one page, opened in another browser: the same view, number by number."""

from contextlib import ExitStack
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
import viser
from apps import SOLVE_S
from mounted_cabin import mounted_cabin
from pages import draw_on, send, wait_for, wait_until

from modeviz.analysis.results import Conditions
from modeviz.viewer.page.front import open_front
from modeviz.viewer.scene.stage import Stage
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.directory import Directory
from modeviz.viewer.session.commands import decisions, looks
from modeviz.viewer.session.state import ForceCurve

FIELD = "document.querySelector('#mv-view-link input')?.value"
SAID = "document.querySelector('#mv-view-link span')?.textContent"

SEEN = (
    decisions.SetRate("B", "lateral", 123456.7),
    decisions.PlaceMounts("B", "offset", (0.02, None, None)),
    decisions.Pin("Kept"),
    decisions.SetRate("A", "vertical", 5.5e5),
    looks.ShowMode("cab roll"),
    looks.ChangeLook(coloring="kinetic energy"),
    looks.ChooseCurve(1, ForceCurve("A -0.5", "z")),
    looks.ChangeCharts(cursor_hz=9.3, decibels=False),
    looks.Overlay("Kept", True),
    looks.Drive("rough", 25.0),
)


@pytest.fixture
def directory(monkeypatch):
    """A server of the cabin, with nothing in its scenes that is slow to draw in software."""
    monkeypatch.setattr(viser.SceneApi, "configure_environment_map", lambda *_, **__: None)
    built = Stage.__init__

    def without_shadows(stage, *arguments):
        built(stage, *arguments)
        stage._key.cast_shadow = False

    monkeypatch.setattr(Stage, "__init__", without_shadows)
    cabin = mounted_cabin()
    front = open_front(port=0)
    bench = Bench(cabin, cabin.rates, Conditions("flat", 20.0))
    with ExitStack() as ending:
        directory = Directory(front, {cabin.name: bench}, dark=False)
        ending.callback(directory.close)
        ending.callback(front.close)
        front.open(directory)
        yield directory, front


def opened(directory, page, count):
    """The app that was opened as so many were, with its answer."""
    wait_until(page, lambda: len(directory.sessions.open) == count)
    app = [*directory.sessions.open.values()][-1].app
    wait_until(page, lambda: app.session.answer is not None)
    assert app.session.wait(SOLVE_S)
    return app


def drawn(app):
    """All curves of the charts, as they are on the page."""
    return [
        np.array(column)
        for plot in app.screen.results.response._charts._plots
        for column in plot._chart.data
    ]


def is_near(camera, position):
    """Whether a camera that is kept is at a position."""
    return camera is not None and np.allclose(camera.position, position, atol=1e-3)


def move(page, app, client, position, look_at):
    """Moves a camera, again where the page was about to frame the vehicle yet, until it stays."""
    seen = []

    def stays():
        seen.append(is_near(app.keeping.camera, position))
        if not seen[-1]:
            client.camera.position, client.camera.look_at = position, look_at
        draw_on(page, 5)
        return len(seen) > 10 and all(seen[-10:])

    wait_until(page, stays)


def test_a_copied_link_opens_the_same_view_in_another_browser(directory, open_page):
    directory, front = directory
    page = open_page(front, (1100, 760))
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    first = opened(directory, page, 1)
    wait_for(page, "document.body.textContent.includes('Solved')")
    for command in SEEN:
        first.session.do(command)
    assert first.session.wait(SOLVE_S)
    page.keyboard.press("Escape")  # closes the guide
    send(page, first.screen.motion.animation._amplitude, 1.85)
    send(page, first.screen.motion.animation._phase, 215.0)
    wait_until(page, lambda: first.screen.motion.animation._amplitude.value == 1.85)
    wait_until(page, lambda: not first.screen.motion.animation.animation.is_running)
    (client,) = first.server.get_clients().values()
    move(page, first, client, (4.0, -3.0, 2.5), (1.2, 0.0, 0.8))

    page.get_by_role("tab", name="View").click()
    page.get_by_text("Copy link", exact=True).click()
    link = wait_for(page, FIELD)
    wait_for(page, f"{SAID} === 'Copied: paste it where somebody is to see this.'")
    assert page.evaluate("navigator.clipboard.readText()") == link
    assert {*parse_qs(urlsplit(link).query)} == {"view"}

    other = open_page(front, (1100, 760), f"?{urlsplit(link).query}")
    second = opened(directory, other, 2)
    assert second is not first
    assert second.session.state.design.rates == first.session.state.design.rates
    assert second.session.state.look == first.session.state.look
    assert second.session.state.charts == first.session.state.charts
    assert second.session.state.motion == first.session.state.motion
    assert second.session.state.conditions == first.session.state.conditions
    assert second.screen.motion.animation.animation == first.screen.motion.animation.animation
    solved = second.session.answer, first.session.answer
    np.testing.assert_allclose(*(each.now.modes.frequency_hz for each in solved), rtol=1e-9)
    assert solved[0].followed.mode == solved[1].followed.mode
    for one, two in zip(drawn(first), drawn(second), strict=True):
        np.testing.assert_allclose(one, two, rtol=1e-9)
    wait_until(other, second.server.get_clients)
    (seer,) = second.server.get_clients().values()
    wait_until(other, lambda: np.allclose(seer.camera.position, (4.0, -3.0, 2.5), atol=1e-3))
    np.testing.assert_allclose(seer.camera.look_at, (1.2, 0.0, 0.8), atol=1e-3)
    wait_until(other, lambda: is_near(second.keeping.camera, (4.0, -3.0, 2.5)))

    second.session.do(decisions.SetRate("A", "vertical", 4e5))
    assert first.session.state.design.rates["A"].vertical == 5.5e5  # a session of its own
    page.get_by_role("button", name="Close", exact=True).click()
    page.evaluate("Object.defineProperty(navigator, 'clipboard', { value: undefined })")
    page.get_by_text("Copy link", exact=True).click()
    wait_for(page, f"{SAID}?.endsWith('copy it from the field.')")
    chosen = f"(field => field.selectionEnd - field.selectionStart)({FIELD.replace('?.value', '')})"
    assert page.evaluate(chosen) == len(link)
