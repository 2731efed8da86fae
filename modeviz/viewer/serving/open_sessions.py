"""The sessions in memory: opened as somebody comes, closed when nobody has looked for a while."""

import threading
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from modeviz.compute.memory import give_back
from modeviz.compute.precedence import Precedence
from modeviz.errors import ModevizError
from modeviz.viewer.page.front import Front
from modeviz.viewer.serving.addresses import Addresses, Place, Visit
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.open_session import OpenSession
from modeviz.viewer.serving.review import Review
from modeviz.viewer.session.opening import Opening

MOST_OPEN = 64
"""Sessions in memory; the one that was left longest ago makes room for another."""

IDLE = 900.0
"""s without a page after which a session leaves memory."""

LOOKS_EVERY = 15.0
"""s between two looks which sessions are idle."""


class OpenSessions:
    """Those that pages can look at now; all threads may ask."""

    def __init__(
        self, front: Front, benches: Mapping[str, Bench], addresses: Addresses, dark: bool
    ) -> None:
        """Opens none yet.

        Args:
            front: where pages come in.
            benches: the vehicles, by what addresses call them.
            addresses: of sessions and reviews.
            dark: whether pages are.
        """
        self._front, self._benches, self._addresses = front, benches, addresses
        self._dark = dark
        self.precedence: Precedence = Precedence()
        """Of all that is done here."""
        self.open: dict[Place, OpenSession] = {}
        self._lock = threading.Lock()
        self._locks: dict[Place, tuple[threading.Lock, int]] = {}
        """Of sessions that are being opened or closed, with how many threads want them."""
        self._ended = threading.Event()
        self._watching = threading.Thread(target=self._watch, name="idle sessions", daemon=True)
        self._watching.start()

    @property
    def is_ending(self) -> bool:
        """Whether all are being closed."""
        return self._ended.is_set()

    def get(self, place: Place) -> OpenSession | None:
        """Return a session if it is in memory."""
        return self.open.get(place)

    def is_being_opened(self, place: Place) -> bool:
        """Return whether a page that comes has to wait for its session."""
        return place in self._locks and place not in self.open

    def opened(self, visit: Visit) -> OpenSession | None:
        """Return the session of a page, which is opened if nobody has it open; None without a place."""
        with self._one_at_a_time(visit.place):
            if session := self.open.get(visit.place):
                session.touch()
                return session
            if not self._make_room():
                return None
            session = self.open[visit.place] = self._new(visit)
            return session

    def close(self) -> None:
        """Closes all, side by side, and has their studies remember them."""
        self._ended.set()
        places = tuple(self.open)
        with ThreadPoolExecutor(len(places) or 1, "close session") as closing:
            closing.map(partial(self._close, least=-1.0), places)
        self._watching.join(timeout=1.0)

    def _new(self, visit: Visit) -> OpenSession:
        bench, name = self._benches[visit.vehicle], visit.session
        address = "&" + self._addresses.address(visit.vehicle, "session", visit.key)
        opening, common = _opening(bench, visit), (self._dark, self.precedence)
        with self.precedence.answer():
            session = OpenSession(bench, name, opening, self._front, address, *common)
        review = Review(bench, name, partial(self._addresses.address, visit.vehicle, "review"))
        session.server.visitors.offer(review, bench.is_shared(name))
        return session

    def _make_room(self) -> bool:
        """Closes those that were left longest ago while there are too many; whether there is room."""
        idle = {each: session.idle for each, session in dict(self.open).items()}
        for place in sorted(idle, key=lambda each: idle[each], reverse=True):
            if len(self.open) < MOST_OPEN:
                return True
            self._close(place, 0.0)
        if len(self.open) < MOST_OPEN:
            return True
        self._front.house.notices.note("the server", "has as many sessions open as it takes")
        return False

    def _watch(self) -> None:
        """Closes sessions that are idle, until all are closed."""
        while not self._ended.wait(LOOKS_EVERY):
            for place in tuple(self.open):
                self._close(place, IDLE)

    def _close(self, place: Place, least: float) -> None:
        """Closes a session that nobody has looked at for more than so many s.

        One whose closing goes wrong, which is our mistake, is as good as closed: others go on.
        """
        with self._one_at_a_time(place):
            found = self.open.get(place)
            if found is None or found.idle <= least:
                return
            try:
                found.close()
            except Exception as error:
                found.server.note_mistake(error)
            finally:
                del self.open[place]
        del found
        give_back()

    @contextmanager
    def _one_at_a_time(self, place: Place) -> Iterator[None]:
        """Has a session opened or closed by one thread at a time; others go on."""
        with self._lock:
            lock, n_waiting = self._locks.get(place, (threading.Lock(), 0))
            self._locks[place] = lock, n_waiting + 1
        try:
            with lock:
                yield
        finally:
            with self._lock:
                lock, n_waiting = self._locks.pop(place)
                if n_waiting > 1:
                    self._locks[place] = lock, n_waiting - 1


def _opening(bench: Bench, visit: Visit) -> Opening:
    """Return what a session opens with; if it is none that was left or linked, the usual and why."""
    try:
        left = bench.left(visit.session)
    except ModevizError as error:
        told = f"{error}; it is left as it is, and what is done here is not saved"
        return replace(bench.opening(), remarks=(told,), is_unread=True)
    try:
        return left or bench.opening(visit.view)
    except ModevizError as error:
        return replace(bench.opening(), remarks=(str(error),))
