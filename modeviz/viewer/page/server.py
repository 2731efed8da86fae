"""viser's server, opened behind our handshake, limits and message filter, silent on the terminal.

Its web server is built inside `ViserServer.__init__`, so these are put in while that runs.
tests/viewer/page/test_server.py fails when viser changes.
"""

import asyncio
import errno
import io
import logging
import re
import socket
import threading
from collections.abc import Callable, Coroutine, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from functools import partial
from typing import Any

import viser
import websockets.asyncio.server
from viser import _messages
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from modeviz.errors import ModevizError
from modeviz.viewer.page.connection import CLOSING_S, House, PageConnection
from modeviz.viewer.page.decoding import LARGEST_MESSAGE
from modeviz.viewer.page.handshake import LOOPBACK, Door, ProcessRequest
from modeviz.viewer.page.links import link, local_link
from modeviz.viewer.page.message_filter import gate_messages
from modeviz.viewer.page.notices import Notices
from modeviz.viewer.page.tokens import checked_token
from modeviz.viewer.page.turns import Turns

HANDSHAKE_S = 10.0
"""s: how long a client may take to say what it wants."""

_one_server_at_a_time = threading.Lock()

Handler = Callable[[ServerConnection], Coroutine[Any, Any, None]]


class Server(viser.ViserServer):
    """viser's server behind a door, silent on the terminal."""

    def __init__(self, host: str, port: int, door: Door) -> None:
        self.notices: Notices = Notices()
        house = House(self.notices, Turns(self.notices.mistake))
        with _guarded_by(door, house), redirect_stdout(io.StringIO()):
            super().__init__(host=host, port=port, label=door.title, verbose=False)
        if not door.is_hung:
            self.stop()
            raise RuntimeError("viser no longer starts through websockets.asyncio.server.serve")
        for request in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self._websock_server.unregister_handler(request)
        self._thread_executor.shutdown()
        for caller in (self, self.gui, self.scene):
            caller._thread_executor = house.turns
        gate_messages(self, self.notices)
        self._door = door
        door.is_open = True

    @property
    def link(self) -> str:
        """The address of the page for everybody who can reach it, with its token."""
        return link(self._door.host, self.get_port(), self._door.token)

    @property
    def local_link(self) -> str:
        """The address of the page for a browser of this machine; ready for `&name=value`."""
        return local_link(self._door.host, self.get_port(), self._door.token)

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never opens viser's public tunnel."""
        return None

    def stop(self) -> None:
        with redirect_stdout(io.StringIO()):
            super().stop()
        self.notices.tally()


def open_server(
    host: str = "127.0.0.1",
    port: int = 8080,
    token: str | None = None,
    title: str = "modeviz",
    public_names: Sequence[str] = (),
    is_framed: bool = False,
) -> Server:
    """A viser server that only who has the token, or without one the users of this machine, can reach.

    Args:
        host: the address to listen on.
        port: to listen on; 0 takes a free one.
        token: what a link must carry, `?token=…`; needed beyond this machine.
        title: of the page.
        public_names: under which a proxy makes the page known.
        is_framed: whether notebooks may show it in a frame, and under any name of their server.

    Raises:
        ModevizError: the port is none or in use, the address is not this machine's, a name is none, or
            the token is missing or no good one.
    """
    if host not in LOOPBACK and token is None:
        raise ModevizError(f"other machines reach {host}: a token is needed, so leave out --no-token")
    if token is not None:
        checked_token(token, "token")
    for name in public_names:
        if not re.fullmatch(r"[\w.-]+", name, re.ASCII):
            raise ModevizError(
                f"--public-name: found {name!r}, expected a name such as tool.example.com"
            )
    if not 0 <= port <= 65535:
        raise ModevizError(f"port: found {port}, expected 0 to 65535")
    _check_free(host, port)
    names = tuple(map(str.lower, public_names))
    server = Server(host, port, Door(host, token, title, names, is_framed))
    if port and server.get_port() != port:
        server.stop()
        raise ModevizError(_in_use(host, port))
    return server


def _check_free(host: str, port: int) -> None:
    """Raises ModevizError if nothing can listen there; viser would silently take the next port."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise ModevizError(_in_use(host, port)) from None
        raise ModevizError(f"cannot listen on port {port} of {host}: {error.strerror}") from None


def _in_use(host: str, port: int) -> str:
    return f"port {port} of {host} is in use: choose another with --port"


@contextmanager
def _guarded_by(door: Door, house: House) -> Iterator[None]:
    """While this lasts, a server that viser starts asks `door` first; it has places as `house` has."""
    serve = websockets.asyncio.server.serve

    def guarded_serve(handler: Handler, *args: Any, process_request: ProcessRequest, **options: Any):
        asyncio.get_running_loop().set_exception_handler(partial(_report, house.notices))
        ours = {
            "process_request": door.guard(process_request),
            "create_connection": partial(PageConnection, house=house),
            "max_size": LARGEST_MESSAGE,
            "open_timeout": HANDSHAKE_S,
            "close_timeout": CLOSING_S,
            "logger": _silent(),
        }
        return serve(_reported(handler, house.notices), *args, **{**options, **ours})

    with _one_server_at_a_time:
        websockets.asyncio.server.serve = guarded_serve
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve


def _silent() -> logging.Logger:
    """Silences the words of websockets on what is no request, such as a port scan."""
    logger = logging.getLogger("modeviz.websockets")
    logger.setLevel(logging.CRITICAL)
    return logger


def _reported(handler: Handler, notices: Notices) -> Handler:
    """A handler of connections that says once where it went wrong."""

    async def handle(connection: ServerConnection) -> None:
        try:
            await handler(connection)
        except ConnectionClosed:
            pass
        except Exception as error:
            notices.mistake(error)

    return handle


def _report(notices: Notices, _loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Says once what went wrong in the server's loop, such as that there are no more files to open."""
    error = context.get("exception")
    if isinstance(error, OSError):
        notices.note("the server", f"cannot take a connection: {error.strerror}")
    elif isinstance(error, Exception):
        notices.mistake(error)
    else:
        notices.note("the server", f"has trouble: {context['message']}")
