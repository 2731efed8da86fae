"""The only socket that others reach: answers requests, hands websockets to the servers of sessions."""

import asyncio
import socket
import threading
from contextlib import suppress
from functools import partial
from typing import Any, Protocol
from weakref import WeakValueDictionary

from websockets.asyncio.server import ServerConnection, serve
from websockets.http11 import Request, Response

from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.door import Door
from modeviz.viewer.page.doors.links import link, local_link
from modeviz.viewer.page.doors.origins import LOOPBACK
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import NOTHING_AROUND, Surroundings
from modeviz.viewer.page.doors.tokens import checked_token
from modeviz.viewer.page.wire.acceptor import Acceptor
from modeviz.viewer.page.wire.connection import PageConnection
from modeviz.viewer.page.wire.house import House
from modeviz.viewer.page.wire.limits import client_of
from modeviz.viewer.page.wire.listening import listening_socket
from modeviz.viewer.page.wire.loop_troubles import report, silent_logger
from modeviz.viewer.page.wire.notices import Notices
from modeviz.viewer.page.wire.request_head import awaited_head, has_left, is_websocket

HANDSHAKE_S = 10.0
"""s: how long a client may take to say what it wants."""

AGAIN_S = 0.02
"""s until the next connection is taken where one could not be."""

OPENED_AT_ONCE = 2
"""Sessions for one client, so that others need not wait for as many as it wants."""

BACKLOG = 100

NO_SESSION = "there is no such session here, or it has ended: open the link that modeviz printed"


class Site(Protocol):
    """What is behind a front."""

    async def page(self, connection: PageConnection, request: Request) -> Response:
        """Return the answer to a request for a page, which the door has let in.

        To one for `WHY`, that is why its websocket has to wait, or "".
        """
        ...

    async def acceptor(self, request: Request) -> Acceptor | None:
        """Return what serves a websocket that the door lets in; None if there is no such session."""
        ...


class Front:
    """Listens on one address in a thread of its own; everybody passes its door."""

    def __init__(self, door: Door, port: int, notices: Notices) -> None:
        """Takes the address; nobody is let in before `open`.

        Args:
            door: judges requests.
            port: to listen on; 0 takes a free one.
            notices: told of clients that go too far.

        Raises:
            ModevizError: the port is in use, or the address is not this machine's.
        """
        self.door: Door = door
        self.house: House = House(notices, door.around.proxies)
        self._listening = listening_socket(door.host, port)
        self._loop = asyncio.SelectorEventLoop()
        self._own = Acceptor()
        self._turns: WeakValueDictionary[str, asyncio.Semaphore] = WeakValueDictionary()
        """Of clients whose sessions are being opened."""
        self._site: Site
        self._thread = threading.Thread(target=self._run, name="front", daemon=True)
        if door.secret:
            door.secret.listen(self._tell_token)

    @property
    def link(self) -> str:
        """The address of the page for everybody who can reach it, with its token."""
        return link(self.door.host, self.get_port(), self.door.token, self.door.around.prefix)

    @property
    def local_link(self) -> str:
        """The address of the page for a browser of this machine; ready for `&name=value`."""
        return local_link(self.door.host, self.get_port(), self.door.token, self.door.around.prefix)

    def get_port(self) -> int:
        """Return the port it listens on."""
        return self._listening.getsockname()[1]

    def open(self, site: Site) -> None:
        """Lets people in to what is behind."""
        self._site = site
        self._listening.listen(BACKLOG)
        self._thread.start()
        self.house.notices.tell(f"listens on port {self.get_port()} of {self.door.host}", "started")

    def close(self) -> None:
        """Gives the address back; who is in stays in."""
        if self._thread.is_alive():
            with suppress(RuntimeError):  # it has ended meanwhile
                self._loop.call_soon_threadsafe(self._loop.stop)
            self._thread.join(timeout=2.0)
        self._listening.close()

    def _tell_token(self) -> None:
        """Says that the token has changed, and where the page is now: no log keeps that."""
        self.house.notices.note("the token", "has changed: links and cookies from before are refused")
        if self.door.token:
            with suppress(OSError, ValueError):  # nobody reads it
                print(f"{self.door.title} is now at {self.link}", flush=True)

    def _run(self) -> None:
        loop = self._loop
        asyncio.set_event_loop(loop)
        loop.set_exception_handler(partial(report, self.house.notices))
        loop.create_task(self._serve())
        loop.run_forever()
        tasks = asyncio.all_tasks(loop)
        for task in tasks:
            task.cancel()
        loop.run_until_complete(asyncio.gather(*tasks, return_exceptions=True))
        loop.close()

    async def _serve(self) -> None:
        """Builds the server of our own answers and accepts connections for ever."""
        options: dict[str, Any] = {
            "process_request": self.door.guard(self._answer),
            "create_connection": partial(PageConnection, house=self.house),
            "open_timeout": HANDSHAKE_S,
            "logger": silent_logger(),
        }
        with self._own.inside():
            await serve(_no_websocket, **options)
        tasks: set[asyncio.Task[None]] = set()
        while True:
            try:
                connection, peer = await self._loop.sock_accept(self._listening)
            except OSError as error:  # no more files, or the client has gone again
                report(self.house.notices, self._loop, {"exception": error, "message": ""})
                await asyncio.sleep(AGAIN_S)
                continue
            task = self._loop.create_task(self._receive(connection, peer[0]))
            tasks.add(task)
            task.add_done_callback(tasks.discard)

    async def _receive(self, connection: socket.socket, address: str) -> None:
        """Hands a connection to who is to serve it, as soon as it is known what it wants."""
        connection.setblocking(False)
        client = client_of(address)
        if not self.house.arrivals.take(client, is_one=not self.house.proxies.trusts(address)):
            self.house.notices.note(client, "opened more connections than it may: the last are refused")
            connection.close()
            return
        try:
            async with asyncio.timeout(HANDSHAKE_S):
                request = await awaited_head(self._loop, connection)
            is_ours = is_websocket(request) and self._is_admitted(connection, request)
            acceptor = await self._acceptor(connection, address, request) if is_ours else None
        except (OSError, TimeoutError):
            connection.close()
        except BaseException:
            connection.close()
            raise
        else:
            (acceptor or self._own).take(connection)
        finally:
            self.house.arrivals.leave(client)

    async def _acceptor(
        self, connection: socket.socket, address: str, request: Request
    ) -> Acceptor | None:
        """Return what serves a websocket, when it is its client's turn.

        Raises:
            OSError: the client has left meanwhile.
        """
        client = client_of(self.door.around.proxies.asked(address, request.headers).client)
        turn = self._turns.setdefault(client, asyncio.Semaphore(OPENED_AT_ONCE))
        async with turn:
            if has_left(connection):
                raise ConnectionResetError("left before its session was opened")
            return await self._site.acceptor(request)

    def _is_admitted(self, connection: socket.socket, request: Request) -> bool:
        """Whether the door lets a request in, whoever is to serve it."""
        address, *_ = connection.getpeername()
        return self.door.admits(request, address, self.get_port())

    async def _answer(self, connection: PageConnection, request: Request) -> Response | None:
        """Return the answer to who has passed the door: a page, or that there is no such session."""
        if is_websocket(request):
            return answer(404, NO_SESSION)
        return await self._site.page(connection, request)


async def _no_websocket(connection: ServerConnection) -> None:
    """Never called: every websocket is answered or handed on before."""
    await connection.close()


def open_front(
    host: str = "127.0.0.1",
    port: int = 8080,
    token: str | Secret | None = None,
    title: str = "modeviz",
    around: Surroundings = NOTHING_AROUND,
    is_framed: bool = False,
) -> Front:
    """Return a front that has its address and lets nobody in yet.

    Only who has the token, or else who is on this machine, can reach what is behind.

    Args:
        host: the address to listen on.
        port: to listen on; 0 takes a free one.
        token: what a link must carry, `?token=…`; needed beyond this machine.
        title: of the page.
        around: it, see there.
        is_framed: whether notebooks may show it in a frame, and under any name of their server.

    Raises:
        ModevizError: the port is none or in use, the address is not this machine's, or the
            token is missing or no good one.
    """
    if host not in LOOPBACK and token is None:
        raise ModevizError(f"other machines reach {host}: a token is needed, so leave out --no-token")
    secret = Secret(checked_token(token, "token")) if isinstance(token, str) else token
    if not 0 <= port <= 65535:
        raise ModevizError(f"port: found {port}, expected 0 to 65535")
    return Front(Door(host, secret, title, around, is_framed), port, Notices())
