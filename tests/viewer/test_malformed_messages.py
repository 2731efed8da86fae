"""A page to which thousands of messages come that no page sends."""

import re

import pytest
import viser
from mounted_cabin import mounted_cabin
from opened_app import SOON, opened_app
from visitors import entered, update, wait_until

from benchmarks.malformed import malformed
from modeviz.analysis.results import Conditions
from modeviz.viewer.page.wire import connection, pace

N_MESSAGES = 2000


@pytest.fixture(scope="module")
def app():
    app = opened_app(mounted_cabin(), Conditions("flat", 20.0))
    yield app
    app.close()


def sliders(server):
    handles = server.gui._gui_input_handle_from_uuid.values()
    return [handle for handle in handles if isinstance(handle, viser.GuiSliderHandle)]


def rms(app, slider, value):
    """What is solved once a page has moved a slider to another value."""
    design = app.session.state.design
    with entered(app.server) as socket:
        socket.send(update(slider, value))
        wait_until(lambda: app.session.state.design != design)
        assert app.session.wait(SOON)
    return app.session.answer.now.rms


@pytest.fixture
def patient(monkeypatch):
    """Connections that hear everything: as it is, a page is closed after a hundred such messages."""
    monkeypatch.setattr(connection, "MOST_WRONG", 100_000)
    for limit in ("MESSAGES_PER_S", "MOST_MESSAGES"):
        monkeypatch.setattr(pace, limit, 100_000)


def test_after_two_thousand_malformed_and_hostile_messages_all_is_solved_as_before(app, patient, capfd):
    slider = sliders(app.server)[0]
    value, other = slider.value, round(0.4 * slider.max)
    moved, before = rms(app, slider, other), rms(app, slider, value)
    design = app.session.state.design
    fence = app.server.gui.add_checkbox("Fence", False)
    ids = [slider._impl.uuid for slider in sliders(app.server)]
    with entered(app.server) as socket:
        for message in malformed(N_MESSAGES, 0, ids):
            socket.send(message)
        socket.send(update(fence, True))
        wait_until(lambda: fence.value)
    fence.remove()
    assert app.session.state.design == design
    assert rms(app, slider, other) == pytest.approx(moved, rel=1e-9)
    assert rms(app, slider, value) == pytest.approx(before, rel=1e-9)
    app.server.notices.tally()
    printed = capfd.readouterr().err
    (line,) = printed.splitlines()[1:]
    assert int(re.search(r"(\d+) times in all", line)[1]) > N_MESSAGES / 2
    assert len(printed) < 300
