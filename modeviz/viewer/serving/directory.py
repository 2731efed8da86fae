"""What is behind a server's front: which page or session an address is answered with."""

import asyncio
from collections.abc import Callable, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from functools import partial
from typing import TypeVar
from urllib.parse import urlsplit

from websockets.http11 import Request, Response

from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.door import WHY
from modeviz.viewer.page.doors.entry import NO_REVIEW
from modeviz.viewer.page.doors.page_file import PageFile
from modeviz.viewer.page.front import Front
from modeviz.viewer.page.one_page import PATHS
from modeviz.viewer.page.wire.acceptor import Acceptor
from modeviz.viewer.page.wire.connection import PageConnection
from modeviz.viewer.page.wire.request_head import query_of
from modeviz.viewer.serving.addresses import Addresses
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.health import Health
from modeviz.viewer.serving.lobby import Lobby
from modeviz.viewer.serving.open_session import OpenSession
from modeviz.viewer.serving.open_sessions import OpenSessions

OPENERS, READERS = 4, 4
"""Sessions that are opened at once, and requests that wait for the disk."""

PICTURE = "/picture"
ASKED = {"session", "review", "vehicle", "view", "new"}
"""What an address has that is not that of the start page."""

Result = TypeVar("Result")

BEING_OPENED = "this session is being opened: a moment"
NO_PAGE = "there is no such page"
NO_KEY = "this is no session's address: open the link that modeviz printed"
NO_VEHICLE = "there is no such vehicle here: open the link that modeviz printed"


class Directory:
    """The vehicles of a server, and the sessions on them."""

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
        self.benches: Mapping[str, Bench] = dict(benches)
        self._pages = {
            name: PageFile(front.door, bench.title, "dark" if dark else "light")
            for name, bench in benches.items()
        }
        self._addresses = Addresses(front, self.benches)
        self.sessions: OpenSessions = OpenSessions(front, self.benches, self._addresses, dark)
        self._lobby = Lobby(front.door, self.benches, dark, self.sessions) if has_lobby else None
        self._openers = ThreadPoolExecutor(OPENERS, "open session")
        self._readers = ThreadPoolExecutor(READERS, "read study")
        self._drawing = ThreadPoolExecutor(1, "draw pictures")
        front.door.health = lambda: self.health.response()
        front.door.lets_look = self._lets_look

    async def page(self, connection: PageConnection, request: Request) -> Response:
        """Return the page of a session, or the way to one."""
        query, path = query_of(request), urlsplit(request.path).path
        left = self._addresses.left(request)
        if self._lobby and path == PICTURE:
            return await _done_by(self._drawing, partial(self._lobby.picture, query, left))
        if path.endswith(f"/{WHY}"):
            return await _done_by(self._readers, partial(self._obstacle, query))
        if path not in PATHS:
            return answer(404, NO_PAGE)
        if self._lobby and not ASKED & query.keys():
            return await _done_by(self._readers, partial(self._lobby.page, request, left))
        vehicle = self._addresses.vehicle(query)
        if vehicle is None:
            return answer(404, NO_VEHICLE)
        if not {"session", "review"} & query.keys():
            return answer(303, Location=self._addresses.way(request, vehicle, query))
        if await _done_by(self._readers, partial(self._addresses.visit, query)) is None:
            return answer(404, _nothing_there(query))
        response = self._pages[vehicle].response(request)
        if "session" in query:
            self._addresses.remember(connection, request, response, vehicle, query["session"])
        return response

    async def acceptor(self, request: Request) -> Acceptor | None:
        """Return what serves a page's websocket; its session is opened if nobody has it open."""
        session = await _done_by(self._openers, partial(self._opened, query_of(request)))
        return session and session.server.acceptor

    def close(self) -> None:
        """Ends all sessions, and has their studies remember them."""
        for threads in (self._openers, self._readers):
            threads.shutdown(cancel_futures=True)
        self.sessions.close()
        self._drawing.shutdown(cancel_futures=True)

    @property
    def health(self) -> Health:
        """How the server is."""
        sessions, benches = list(self.sessions.open.values()), self.benches.values()
        return Health(
            vehicles=len(benches),
            prepared=sum(bench.is_prepared for bench in benches),
            sessions=len(sessions),
            pages=sum(len(session.server.get_clients()) for session in sessions),
            stuck=sum(session.app.session.is_stuck for session in sessions),
            unsaved=sum(bool(bench.study and bench.study.trouble) for bench in benches),
            is_stopping=self.sessions.is_ending,
        )

    def _opened(self, query: Mapping[str, str]) -> OpenSession | None:
        """Return the session of an address; None if there is none, or no place for it."""
        visit = self._addresses.visit(query)
        return visit and self.sessions.opened(visit)

    def _obstacle(self, query: Mapping[str, str]) -> Response:
        """Return what a page is told that cannot open its websocket."""
        visit = self._addresses.visit(query)
        if visit is None:
            return answer(200, _nothing_there(query))
        return answer(200, BEING_OPENED if self.sessions.is_being_opened(visit.place) else "")

    def _lets_look(self, request: Request) -> bool:
        """Return whether a request is for the page of a review that goes on, and for nothing else."""
        query, path = query_of(request), urlsplit(request.path).path
        is_page = path in PATHS or path.endswith(f"/{WHY}")
        return is_page and "session" not in query and self._addresses.visit(query) is not None


async def _done_by(threads: Executor, work: Callable[[], Result]) -> Result:
    """Return the result of what may wait for the disk or take long, and would hold others up."""
    return await asyncio.get_running_loop().run_in_executor(threads, work)


def _nothing_there(query: Mapping[str, str]) -> str:
    """Why an address opens nothing."""
    return NO_REVIEW if "review" in query else NO_KEY
