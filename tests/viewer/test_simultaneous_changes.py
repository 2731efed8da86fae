"""Controls that two people use at once: viser calls them in threads, and neither change may be lost."""

import threading
from dataclasses import replace
from functools import partial

import pytest
from mounted_cabin import mounted_cabin
from session_commands import Become

from modeviz.analysis.results import Conditions
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.panels.modes import step_mode
from modeviz.viewer.session.commands.decisions import LinkRates, ResetRate, SetLossFactor, ToggleLock
from modeviz.viewer.session.commands.looks import Drive

PATIENCE_S = 60
TRIED = {"A": MountRates(4e5, 131.4e3, 4e5)}


@pytest.fixture(scope="module")
def app():
    server, vehicle = open_server(port=0), mounted_cabin()
    app = App(vehicle, {**vehicle.rates, **TRIED}, Conditions("flat", 20.0), server)
    app.start()
    assert app.session.wait_checked(PATIENCE_S)
    yield app
    app.close()


class Meeting:
    """A lock that some threads enter for the first time only once all of them have come to it."""

    def __init__(self, threads):
        self._awaited, self._lock = {*threads}, threading.Lock()
        self._all_here = threading.Barrier(len(threads))

    def __enter__(self):
        if threading.current_thread() in self._awaited:
            self._awaited.remove(threading.current_thread())
            self._all_here.wait(PATIENCE_S)
        self._lock.acquire()

    def __exit__(self, *_):
        self._lock.release()


def do_at_once(session, actions):
    threads = [threading.Thread(target=action) for action in actions]
    lock, session._asked._lock = session._asked._lock, Meeting(threads)
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert session.wait_checked(PATIENCE_S)
    session._asked._lock = lock


def both(app, *commands):
    """Two commands to the session."""
    return [partial(app.session.do, command) for command in commands]


def choose_curves(app):
    """What the dropdowns of the two charts do."""
    writes = (binding._write for binding in app.screen.results.response._charts._bindings)
    return [lambda write=write: write("Seat, fore-aft") for write in writes]


@pytest.mark.parametrize(
    "actions",
    [
        lambda app: both(app, ToggleLock("A", "vertical"), ToggleLock("A", "lateral")),
        lambda app: both(app, ResetRate("A", "vertical"), ResetRate("A", "lateral")),
        lambda app: both(app, SetLossFactor("A", 0.3), SetLossFactor("B", 0.3)),
        lambda app: both(app, LinkRates("A", True), LinkRates("B", True)),
        lambda app: both(app, Drive(road="rough"), Drive(speed=25.0)),
        choose_curves,
        lambda app: [lambda: step_mode(app.session, 1)] * 2,
    ],
    ids=["locks", "resets", "loss factors", "links", "road and speed", "curves", "modes"],
)
def test_both_of_two_changes_at_once_are_kept(app, actions):
    session, start = app.session, app.session.state
    for action in actions(app):
        action()
        assert session.wait_checked(PATIENCE_S)
    one_by_one = session.state
    session.do(Become(start))
    assert session.wait_checked(PATIENCE_S)
    do_at_once(session, actions(app))
    at_once = session.state
    session.do(Become(start))
    assert session.wait_checked(PATIENCE_S)
    # Of what is selected last either may be: the groups' own changes are what counts.
    assert replace(at_once, group="") == replace(one_by_one, group="")
