"""A session in memory: its page, its server, what records it, and whether anybody looks."""

import threading
import time
from contextlib import ExitStack

from modeviz.compute.precedence import Precedence
from modeviz.journal.sessions import SessionId
from modeviz.viewer.app import App
from modeviz.viewer.page.front import Front
from modeviz.viewer.page.server import STOPPED_KEPT, Server
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.session.notifications import Failed
from modeviz.viewer.session.opening import Opening

DIGITS = 8
"""Of a session's name in its study that the log has."""


class OpenSession:
    """A session that pages can look at."""

    def __init__(
        self,
        bench: Bench,
        name: SessionId,
        opening: Opening,
        front: Front,
        address: str,
        dark: bool,
        precedence: Precedence,
    ) -> None:
        """Builds the page; the vehicle is prepared and solved in a thread of its own.

        Args:
            bench: with the vehicle.
            name: under which its study knows the session.
            opening: what is shown first.
            front: where pages come in.
            address: of the session, after the token.
            dark: whether the page is.
            precedence: of the sessions of the server.
        """
        self.server: Server = Server(front, address, name[:DIGITS])
        with ExitStack() as undoing:
            undoing.callback(self.server.stop)
            self.app: App = App(
                bench.vehicle,
                bench.rates,
                bench.conditions,
                self.server,
                dark,
                opening,
                bench.shared(precedence),
            )
            undoing.callback(self.app.end)
            if bench.study and not opening.is_unread:
                self.server.farewell = STOPPED_KEPT
                self.app.record(bench.study, name)
            if not opening.past:
                self.app.screen.guide.welcome_first()
            undoing.pop_all()
        self.server.note("a session was opened", "session opened")
        self._looked_at = time.monotonic()
        self._starting = threading.Thread(target=self._start, name="start session", daemon=True)
        self._starting.start()

    @property
    def idle(self) -> float:
        """How long nobody has looked at it, s; 0 while it has pages or is at work."""
        now = time.monotonic()
        if self.server.get_clients() or self._starting.is_alive() or self.app.tasks.are_busy:
            self._looked_at = now
        return now - self._looked_at

    def touch(self) -> None:
        """Keeps it open for somebody who is about to come."""
        self._looked_at = time.monotonic()

    def close(self) -> None:
        """Ends it, has the study remember it, and gives its memory back."""
        self.app.close()
        self.server.note("a session was closed", "session closed")

    def _start(self) -> None:
        try:
            self.app.start()
        except Exception as error:
            self.app.tell_failure(Failed(error))
