"""Which session a page is of: opens sessions as people come, and closes those nobody looks at."""

import asyncio
import secrets
import threading
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from re import fullmatch
from urllib.parse import urlencode, urlsplit

from websockets.http11 import Request, Response

from modeviz.errors import ModevizError
from modeviz.journal.keys import digest_of
from modeviz.journal.sessions import SessionId
from modeviz.viewer.page.acceptor import Acceptor
from modeviz.viewer.page.connection import PageConnection
from modeviz.viewer.page.front import Front
from modeviz.viewer.page.handshake import answer, cookies
from modeviz.viewer.page.one_page import PATHS
from modeviz.viewer.page.page_file import PageFile
from modeviz.viewer.page.request_head import query_of
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.open_session import OpenSession
from modeviz.viewer.session.opening import Opening

MOST_OPEN = 64
"""Sessions in memory; the one that was left longest ago makes room for another."""

IDLE = 900.0
"""s without a page after which a session leaves memory."""

LOOKS_EVERY = 15.0
"""s between two looks which sessions are idle."""

OPENERS = 4
"""Sessions that are opened at once."""

KEPT = 365 * 86400
"""s for which a browser remembers its last session."""

KEY = r"[\w-]{22}"

NO_PAGE = "there is no such page"
NO_KEY = "this is no session's address: open the link that modeviz printed"
NO_REVIEW = "this review has ended: ask who shared it for a new link"
NO_VEHICLE = "there is no such vehicle here: open the link that modeviz printed"


@dataclass(frozen=True)
class Visit:
    """What a page's address asks for."""

    bench: Bench
    session: SessionId
    key: str
    """Of the session."""
    view: str | None
    """What a new session is to show, as a link says it."""


class Directory:
    """What is behind a server's front: its vehicles, and the sessions on them."""

    def __init__(self, front: Front, benches: Mapping[str, Bench], dark: bool) -> None:
        """Opens no session yet.

        Args:
            front: where pages come in.
            benches: the vehicles, by what addresses call them.
            dark: whether pages are.
        """
        self._front, self._benches, self._dark = front, dict(benches), dark
        self._pages = {name: PageFile(front.door, b.title) for name, b in self._benches.items()}
        self._lock = threading.Lock()
        self._open: dict[SessionId, OpenSession] = {}
        self._locks: dict[SessionId, tuple[threading.Lock, int]] = {}
        """Of sessions that are being opened or closed, with how many threads want them."""
        self._openers = ThreadPoolExecutor(OPENERS, "open session")
        self._ended = threading.Event()
        self._watching = threading.Thread(target=self._watch, name="idle sessions", daemon=True)
        self._watching.start()

    async def page(self, connection: PageConnection, request: Request) -> Response:
        """Return the page of a session, or the way to one."""
        query = query_of(request)
        if urlsplit(request.path).path not in PATHS:
            return answer(404, NO_PAGE)
        name = self._vehicle_name(query)
        if name is None:
            return answer(404, NO_VEHICLE)
        if not {"session", "review"} & query.keys():
            return self._way_to_a_session(request, name, query)
        if self._visit(query) is None:
            return answer(404, NO_REVIEW if "review" in query else NO_KEY)
        response = self._pages[name].response(request)
        if "session" in query:
            kept = f"{self._cookie(name)}={query['session']}; HttpOnly; SameSite=Strict"
            response.headers["Set-Cookie"] = f"{kept}; Max-Age={KEPT}"
        return response

    async def acceptor(self, request: Request) -> Acceptor | None:
        """Return what serves a page's websocket; its session is opened if nobody has it open."""
        visit = self._visit(query_of(request))
        if visit is None:
            return None
        loop = asyncio.get_running_loop()
        session = await loop.run_in_executor(self._openers, partial(self._opened, visit))
        return session and session.server.acceptor

    def close(self) -> None:
        """Ends all sessions."""
        self._ended.set()
        self._openers.shutdown(cancel_futures=True)
        for session in self._open.values():
            session.close()
        self._watching.join(timeout=1.0)

    def _way_to_a_session(self, request: Request, name: str, query: dict[str, str]) -> Response:
        """Return the way to the last session of a browser, or to a new one if it has or wants one."""
        known = cookies(request).get(self._cookie(name), "")
        wants_new = {"new", "view"} & query.keys()
        key = known if fullmatch(KEY, known) and not wants_new else secrets.token_urlsafe(16)
        rest = {key: value for key, value in query.items() if key != "new"}
        return answer(303, Location=f"./?{urlencode({'session': key, **rest})}")

    def _visit(self, query: Mapping[str, str]) -> Visit | None:
        """Return what an address asks for; None if there is no such session."""
        name = self._vehicle_name(query)
        key = query.get("session", "")
        if name is None or not fullmatch(KEY, key):
            return None
        return Visit(self._benches[name], digest_of(key), key, query.get("view"))

    def _vehicle_name(self, query: Mapping[str, str]) -> str | None:
        """Return the name of the vehicle an address asks for, the only one if it says none."""
        only = next(iter(self._benches)) if len(self._benches) == 1 else ""
        name = query.get("vehicle", only)
        return name if name in self._benches else None

    def _cookie(self, name: str) -> str:
        """Return the name of the cookie that holds the last session of a vehicle."""
        number = list(self._benches).index(name)
        return f"modeviz{self._front.get_port()}session{number}"

    def _opened(self, visit: Visit) -> OpenSession | None:
        """Return a session in memory; None if there is no place for it."""
        with self._one_at_a_time(visit.session):
            if session := self._open.get(visit.session):
                session.touch()
                return session
            if not self._make_room():
                return None
            address = f"&{urlencode({'session': visit.key})}"
            opening = _opening(visit)
            session = OpenSession(visit.bench, opening, self._front, address, self._dark)
            self._open[visit.session] = session
            return session

    def _make_room(self) -> bool:
        """Closes those that were left longest ago while there are too many; whether there is room."""
        idle = {each: session.idle for each, session in dict(self._open).items()}
        for session in sorted(idle, key=lambda each: idle[each], reverse=True):
            if len(self._open) < MOST_OPEN:
                return True
            self._close_idle(session, 0.0)
        if len(self._open) < MOST_OPEN:
            return True
        self._front.house.notices.note("the server", "has as many sessions open as it takes")
        return False

    def _watch(self) -> None:
        """Closes sessions that are idle, until the directory is closed."""
        while not self._ended.wait(LOOKS_EVERY):
            for session in tuple(self._open):
                self._close_idle(session, IDLE)

    def _close_idle(self, session: SessionId, least: float) -> bool:
        """Closes a session that nobody has looked at for more than so many s; whether it is closed."""
        with self._one_at_a_time(session):
            found = self._open.get(session)
            if found is None or found.idle <= least:
                return found is None
            found.close()
            del self._open[session]
            return True

    @contextmanager
    def _one_at_a_time(self, session: SessionId) -> Iterator[None]:
        """Has a session opened or closed by one thread at a time; others go on."""
        with self._lock:
            lock, n_waiting = self._locks.get(session, (threading.Lock(), 0))
            self._locks[session] = lock, n_waiting + 1
        try:
            with lock:
                yield
        finally:
            with self._lock:
                lock, n_waiting = self._locks.pop(session)
                if n_waiting > 1:
                    self._locks[session] = lock, n_waiting - 1


def _opening(visit: Visit) -> Opening:
    """Return what a session opens with: the usual, and why, if its link cannot be followed."""
    try:
        return visit.bench.opening(visit.view)
    except ModevizError as error:
        return replace(visit.bench.opening(), remarks=(str(error),))
