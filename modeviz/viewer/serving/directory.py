"""Which session a page is of: opens sessions as people come, and closes those nobody looks at."""

import asyncio
import secrets
import threading
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial
from re import fullmatch
from typing import TypeVar
from urllib.parse import urlencode, urlsplit

from websockets.http11 import Request, Response

from modeviz.compute.memory import give_back
from modeviz.errors import ModevizError
from modeviz.journal.keys import digest_of
from modeviz.journal.sessions import SessionId
from modeviz.viewer.page.acceptor import Acceptor
from modeviz.viewer.page.answers import answer
from modeviz.viewer.page.connection import PageConnection
from modeviz.viewer.page.cookies import cookies
from modeviz.viewer.page.front import Front
from modeviz.viewer.page.handshake import NO_REVIEW, WHY
from modeviz.viewer.page.one_page import PATHS
from modeviz.viewer.page.page_file import PageFile
from modeviz.viewer.page.request_head import query_of
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.health import Health
from modeviz.viewer.serving.lobby import Lobby
from modeviz.viewer.serving.open_session import OpenSession
from modeviz.viewer.serving.review import Review
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
"""s for which a browser remembers its last sessions."""

MOST_LEFT = 6
"""Sessions of a vehicle that it remembers."""

PICTURE = "/picture"
ASKED = {"session", "review", "vehicle", "view", "new"}
"""What an address has that is not that of the start page."""

KEY = r"[A-Za-z0-9_-]{22}"

Result = TypeVar("Result")

BEING_OPENED = "this session is being opened: a moment"
NO_PAGE = "there is no such page"
NO_KEY = "this is no session's address: open the link that modeviz printed"
NO_VEHICLE = "there is no such vehicle here: open the link that modeviz printed"


@dataclass(frozen=True)
class Visit:
    """What a page's address asks for."""

    vehicle: str
    session: SessionId
    key: str
    """Of the session; "" to who comes with that of a review."""
    view: str | None
    """What a new session is to show, as a link says it."""


class Directory:
    """What is behind a server's front: its vehicles, and the sessions on them."""

    def __init__(
        self, front: Front, benches: Mapping[str, Bench], dark: bool, has_lobby: bool = False
    ) -> None:
        """Opens no session yet.

        Args:
            front: where pages come in.
            benches: the vehicles, by what addresses call them.
            dark: whether pages are.
            has_lobby: whether who asks for nothing in particular gets a start page.
        """
        self._front, self._benches, self._dark = front, dict(benches), dark
        self._pages = {name: PageFile(front.door, b.title) for name, b in self._benches.items()}
        self._lobby = Lobby(front.door, self._benches, dark, self.opened) if has_lobby else None
        front.door.health = lambda: self.health.response()
        self._lock = threading.Lock()
        self._open: dict[SessionId, OpenSession] = {}
        self._locks: dict[SessionId, tuple[threading.Lock, int]] = {}
        """Of sessions that are being opened or closed, with how many threads want them."""
        self._openers = ThreadPoolExecutor(OPENERS, "open session")
        front.door.lets_look = self._lets_look
        self._ended = threading.Event()
        self._watching = threading.Thread(target=self._watch, name="idle sessions", daemon=True)
        self._watching.start()

    async def page(self, connection: PageConnection, request: Request) -> Response:
        """Return the page of a session, or the way to one."""
        query = query_of(request)
        if self._lobby and urlsplit(request.path).path == PICTURE:
            return await self._in_a_thread(partial(self._lobby.picture, query, self._left(request)))
        if urlsplit(request.path).path.endswith(f"/{WHY}"):
            return await self._in_a_thread(partial(self._obstacle, query))
        if urlsplit(request.path).path not in PATHS:
            return answer(404, NO_PAGE)
        if self._lobby and not ASKED & query.keys():
            return await self._in_a_thread(partial(self._lobby.page, request, self._left(request)))
        name = self._vehicle_name(query)
        if name is None:
            return answer(404, NO_VEHICLE)
        if not {"session", "review"} & query.keys():
            return self._way_to_a_session(request, name, query)
        if await self._in_a_thread(partial(self._visit, query)) is None:
            return answer(404, NO_REVIEW if "review" in query else NO_KEY)
        response = self._pages[name].response(request)
        if "session" in query:
            others = [key for key in self._keys(request, name) if key != query["session"]]
            keys = ".".join([query["session"], *others][:MOST_LEFT])
            self._front.door.give_cookie(connection, response, self._cookie(name), keys, KEPT)
        return response

    async def acceptor(self, request: Request) -> Acceptor | None:
        """Return what serves a page's websocket; its session is opened if nobody has it open."""
        session = await self._in_a_thread(partial(self._opened, query_of(request)))
        return session and session.server.acceptor

    def close(self) -> None:
        """Ends all sessions, side by side, and has their studies remember them."""
        self._ended.set()
        self._openers.shutdown(cancel_futures=True)
        sessions = tuple(self._open)
        with ThreadPoolExecutor(len(sessions) or 1, "close session") as closing:
            closing.map(partial(self._close_idle, least=-1.0), sessions)
        self._watching.join(timeout=1.0)

    def opened(self, session: SessionId) -> OpenSession | None:
        """Return a session if it is in memory."""
        return self._open.get(session)

    @property
    def health(self) -> Health:
        """How the server is."""
        sessions, benches = list(self._open.values()), self._benches.values()
        return Health(
            vehicles=len(benches),
            prepared=sum(bench.is_prepared for bench in benches),
            sessions=len(sessions),
            pages=sum(len(session.server.get_clients()) for session in sessions),
            stuck=sum(session.app.session.is_stuck for session in sessions),
            unsaved=sum(bool(bench.study and bench.study.trouble) for bench in benches),
            is_stopping=self._ended.is_set(),
        )

    async def _in_a_thread(self, work: Callable[[], Result]) -> Result:
        """Return the result of what may wait for the disk or take long, and would hold others up."""
        return await asyncio.get_running_loop().run_in_executor(self._openers, work)

    def _way_to_a_session(self, request: Request, name: str, query: dict[str, str]) -> Response:
        """Return the way to the last session of a browser, or to a new one if it has or wants one."""
        known = self._keys(request, name)
        wants_new = {"new", "view"} & query.keys()
        key = known[0] if known and not wants_new else secrets.token_urlsafe(16)
        rest = {key: value for key, value in query.items() if key not in ("new", "vehicle")}
        address = self._address(name, "session", key)
        return answer(303, Location=f"./?{address}{'&' * bool(rest)}{urlencode(rest)}")

    def _address(self, vehicle: str, kind: str, key: str) -> str:
        """Return what an address says of a session or a review."""
        several = {"vehicle": vehicle} if len(self._benches) > 1 else {}
        return urlencode({**several, kind: key})

    def _obstacle(self, query: Mapping[str, str]) -> Response:
        """Return what a page is told that cannot open its websocket."""
        visit = self._visit(query)
        if visit is None:
            return answer(200, NO_REVIEW if "review" in query else NO_KEY)
        is_being_opened = visit.session in self._locks and visit.session not in self._open
        return answer(200, BEING_OPENED if is_being_opened else "")

    def _visit(self, query: Mapping[str, str]) -> Visit | None:
        """Return what an address asks for; None if there is no such session."""
        name = self._vehicle_name(query)
        key, review = query.get("session", ""), query.get("review", "")
        if name is None:
            return None
        if fullmatch(KEY, review) and not key:
            session = self._benches[name].reviewed(review)
            return Visit(name, session, "", None) if session else None
        return Visit(name, digest_of(key), key, query.get("view")) if fullmatch(KEY, key) else None

    def _lets_look(self, request: Request) -> bool:
        """Return whether a request is for the page of a review that goes on, and for nothing else."""
        query, path = query_of(request), urlsplit(request.path).path
        is_page = path in PATHS or path.endswith(f"/{WHY}")
        return is_page and "session" not in query and self._visit(query) is not None

    def _vehicle_name(self, query: Mapping[str, str]) -> str | None:
        """Return the name of the vehicle an address asks for, the only one if it says none."""
        only = next(iter(self._benches)) if len(self._benches) == 1 else ""
        name = query.get("vehicle", only)
        return name if name in self._benches else None

    def _left(self, request: Request) -> dict[str, list[str]]:
        """Return the keys of the sessions that a browser left, by vehicle."""
        return {name: self._keys(request, name) for name in self._benches}

    def _keys(self, request: Request, name: str) -> list[str]:
        """Return the keys of the sessions of a vehicle that a browser left, the last one first."""
        given = cookies(request).get(self._cookie(name), "").split(".")
        return [key for key in given[:MOST_LEFT] if fullmatch(KEY, key)]

    def _cookie(self, name: str) -> str:
        """Return the name of the cookie that holds the last sessions of a vehicle."""
        number = list(self._benches).index(name)
        return f"modeviz{self._front.get_port()}session{number}"

    def _opened(self, query: Mapping[str, str]) -> OpenSession | None:
        """Return the session of an address; None if there is none, or no place for it."""
        visit = self._visit(query)
        if visit is None:
            return None
        with self._one_at_a_time(visit.session):
            if session := self._open.get(visit.session):
                session.touch()
                return session
            if not self._make_room():
                return None
            bench, name = self._benches[visit.vehicle], visit.session
            address = "&" + self._address(visit.vehicle, "session", visit.key)
            session = OpenSession(bench, name, _opening(bench, visit), self._front, address, self._dark)
            review = Review(bench, name, partial(self._address, visit.vehicle, "review"))
            session.server.visitors.offer(review, bench.is_shared(name))
            self._open[name] = session
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

    def _close_idle(self, session: SessionId, least: float) -> None:
        """Closes a session that nobody has looked at for more than so many s.

        One whose closing goes wrong, which is our mistake, is as good as closed: others go on.
        """
        with self._one_at_a_time(session):
            found = self._open.get(session)
            if found is None or found.idle <= least:
                return
            try:
                found.close()
            except Exception as error:
                found.server.note_mistake(error)
            finally:
                del self._open[session]
        del found
        give_back()

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
