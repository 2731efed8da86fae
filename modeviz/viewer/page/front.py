"""The only socket that others reach: answers requests, hands websockets to the servers of sessions."""

import asyncio
import errno
import logging
import select
import socket
import threading
from contextlib import suppress
from functools import partial
from typing import Any, Protocol
from weakref import WeakValueDictionary

from websockets.asyncio.server import ServerConnection, serve
from websockets.http11 import Request, Response

from modeviz.errors import ModevizError
from modeviz.viewer.page.acceptor import Acceptor
from modeviz.viewer.page.answers import answer
from modeviz.viewer.page.connection import House, PageConnection
from modeviz.viewer.page.handshake import Door
from modeviz.viewer.page.limits import client_of
from modeviz.viewer.page.links import link, local_link
from modeviz.viewer.page.notices import Notices
from modeviz.viewer.page.request_head import is_websocket, request_head

HANDSHAKE_S = 10.0
"""s: how long a client may take to say what it wants."""

SOON, LATER = 0.02, 0.5
"""s between two looks whether the rest of a request has come: at first, and at last."""

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
        self._listening = _listening(door.host, port)
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
                await asyncio.sleep(SOON)
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
                request = await _peeked(self._loop, connection)
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
            if _has_left(connection):
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


async def _peeked(loop: asyncio.AbstractEventLoop, connection: socket.socket) -> Request:
    """Return what a connection asks for, which stays to be read.

    Raises:
        OSError: it is closed.
    """
    came = loop.create_future()
    loop.add_reader(connection, lambda: came.done() or came.set_result(None))
    try:
        await came
    finally:
        loop.remove_reader(connection)
    wait = SOON
    while (request := request_head(connection)) is None:
        await asyncio.sleep(wait)
        wait = min(2 * wait, LATER)
    return request


def _has_left(connection: socket.socket) -> bool:
    """Whether the other end has closed a connection, of which something is still to be read."""
    left = select.POLLHUP | select.POLLERR | getattr(select, "POLLRDHUP", 0)
    poll = select.poll()
    poll.register(connection, left)
    return any(events & left for _, events in poll.poll(0))


async def _no_websocket(connection: ServerConnection) -> None:
    """Never called: every websocket is answered or handed on before."""
    await connection.close()


def _listening(host: str, port: int) -> socket.socket:
    """Return a socket that has an address, and does not listen yet.

    Raises:
        ModevizError: the port is in use, or the address is not this machine's.
    """
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        listening = socket.socket(family, kind)
    except OSError as error:
        raise _refused(host, port, error) from None
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.setblocking(False)
        listening.bind(address)
    except OSError as error:
        listening.close()
        raise _refused(host, port, error) from None
    return listening


def _refused(host: str, port: int, error: OSError) -> ModevizError:
    if error.errno == errno.EADDRINUSE:
        return ModevizError(f"port {port} of {host} is in use: choose another with --port")
    return ModevizError(f"cannot listen on port {port} of {host}: {error.strerror}")


def silent_logger() -> logging.Logger:
    """Return a logger that keeps silent on what is no request, such as a port scan."""
    logger = logging.getLogger("modeviz.websockets")
    logger.setLevel(logging.CRITICAL)
    return logger


def report(notices: Notices, _loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Says once what went wrong in a loop, such as that there are no more files to open."""
    error = context.get("exception")
    if isinstance(error, OSError):
        notices.note("the server", f"cannot take a connection: {error.strerror}")
    elif isinstance(error, Exception):
        notices.mistake(error)
    else:
        notices.note("the server", f"has trouble: {context['message']}")
