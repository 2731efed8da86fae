"""Our mistakes as pages are told of them: a notice with a number, under which the log has the rest."""

import re

import pytest
from mounted_cabin import mounted_cabin
from opened_app import SOON, opened_app
from visitors import CAMERA, encoded, update, visit, wait_until

from benchmarks.page_client import messages
from modeviz.analysis.results import Conditions
from modeviz.viewer.session import beginnings
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.tasks.background_task import BackgroundTask, Job

BAD, GOOD = 3.3e5, 2e5


@pytest.fixture(scope="module")
def app():
    app = opened_app(mounted_cabin(), Conditions("flat", 20.0), token=None)
    yield app
    app.close()


class Page:
    """A page that keeps the notices it is told to show."""

    def __init__(self, socket):
        self._socket, self.notices = socket, {}
        socket.send(encoded(CAMERA))

    def say(self, widget, value):
        self._socket.send(update(widget, value))

    def number(self):
        """The number of the first notice of a mistake that comes."""
        while True:
            for message in messages(self._socket.recv(timeout=SOON)):
                if message["type"] == "NotificationShowMessage":
                    found = re.search("under the number ([0-9a-f]{6})", message["props"]["body"])
                    if found:
                        return found[1]

    def n_more(self):
        """How many notices come in half a second."""
        found = 0
        try:
            while True:
                said = messages(self._socket.recv(timeout=0.5))
                found += sum(m["type"] == "NotificationShowMessage" for m in said)
        except TimeoutError:
            return found


@pytest.fixture
def pages(app):
    wait_until(lambda: not app.server.get_clients())
    with visit(app.server) as one, visit(app.server) as other:
        pages = Page(one), Page(other)
        wait_until(lambda: len(app.server.get_clients()) == 2)
        yield pages


def slider(app):
    gui = app.server.gui._gui_input_handle_from_uuid.values()
    return next(w for w in gui if type(w).__name__ == "GuiSliderHandle" and w.label)


def test_a_solver_that_fails_is_told_to_every_page_and_the_slider_goes_back(
    app, pages, monkeypatch, capfd
):
    solve = beginnings.solve_on

    def faulty(excitation, rates):
        if rates["A"].lateral == BAD:
            raise IndexError("a bug")
        return solve(excitation, rates)

    monkeypatch.setattr(beginnings, "solve_on", faulty)
    app.session.do(SetRate("A", "lateral", GOOD))
    assert app.session.wait(SOON)
    content = app.screen.controls.status._content.content
    app.session.do(SetRate("A", "lateral", BAD))
    numbers = {page.number() for page in pages}
    (number,) = numbers
    said = capfd.readouterr().err
    assert f"mistake {number}\n" in said
    assert "IndexError: a bug" in said
    assert app.session.wait(SOON)
    assert app.session.state.design.rates["A"].lateral == GOOD
    assert "Solved" in content
    app.session.do(SetRate("A", "lateral", BAD))
    assert app.session.wait(SOON)
    assert {page.number() for page in pages} == numbers
    assert "Traceback" not in capfd.readouterr().err  # it stands there already


def test_a_panel_that_fails_leaves_the_page_at_the_last_state_that_all_show(app, pages, monkeypatch):
    app.session.do(SetRate("A", "lateral", GOOD))
    assert app.session.wait(SOON)
    for panel in (app.screen.results.modes, app.screen.results.energy, app.screen.results.static):
        show = panel.show

        def faulty(solved, show=show):
            if solved.state.design.rates["A"].lateral == BAD:
                raise IndexError("a bug")
            show(solved)

        with monkeypatch.context() as patched:
            patched.setattr(panel, "show", faulty)
            app.session.do(SetRate("A", "lateral", BAD))
            assert {page.number() for page in pages}
            assert app.session.wait(SOON)
            assert app.session.state.design.rates["A"].lateral == GOOD
            assert app.session.answer.state.design.rates["A"].lateral == GOOD
    assert app.server._websock_server._broadcast_buffer.atomic_counter == 0


def test_a_callback_that_fails_is_told_to_its_page_alone_and_its_widget_goes_back(
    app, pages, monkeypatch
):
    app.session.do(SetRate("A", "lateral", GOOD))
    assert app.session.wait(SOON)
    widget, before = slider(app), slider(app).value

    def fail(command):
        raise IndexError("a bug")

    for page in pages:
        page.n_more()
    monkeypatch.setattr(app.session, "do", fail)
    pages[0].say(widget, widget.min)
    assert pages[0].number()
    assert pages[1].n_more() == 0
    assert widget.value == before
    monkeypatch.undo()
    pages[0].say(widget, widget.min)
    wait_until(lambda: widget.value == widget.min)


def test_a_computation_that_fails_is_told_with_its_number(app, pages, capfd):
    task = BackgroundTask("work", lambda *_: [].pop(), lambda: None, app.server.mistake)
    task.start(Job("it"))
    number = pages[0].number()
    wait_until(lambda: not task.job.is_running)
    assert number in task.job.failure
    assert f"mistake {number}\n" in capfd.readouterr().err
