"""A tuning session of the small cabin, and somebody who waits for what runs beside it."""

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from mounted_cabin import mounted_cabin
from session_commands import Listener

from modeviz.analysis.results import Conditions
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state

SOON = 120
"""s: on a slow machine with others at work."""


@contextmanager
def open_session() -> Iterator[tuple[Session, Listener]]:
    """A session with its first answer, in which nothing fails, and what it tells."""
    vehicle, heard = mounted_cabin(), Listener()
    state = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
    session = Session(vehicle, state, heard)
    session.start()
    assert session.wait(SOON)
    yield session, heard
    session.close()
    assert not heard.failures


class Watcher:
    """Waits for what a computation tells."""

    def __init__(self):
        self._told = threading.Condition()

    def tell(self):
        with self._told:
            self._told.notify_all()

    def wait(self, reached, timeout=SOON):
        """Waits until it is told that something is reached, which it may not find out by itself."""
        begin = time.monotonic()
        with self._told:
            assert self._told.wait_for(reached, timeout)
        assert time.monotonic() - begin < timeout
