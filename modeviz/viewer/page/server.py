"""The server of one session: viser's, behind our handshake, limits and message filter, and silent.

Its web server is built inside `ViserServer.__init__`, so these are put in while that runs.
tests/viewer/page/test_server.py fails when viser changes.
"""

import asyncio
import io
import threading
import warnings
from collections.abc import Callable, Coroutine, Hashable, Iterator
from concurrent.futures import wait
from contextlib import contextmanager, redirect_stdout
from functools import partial
from typing import Any

import rich
import viser
import websockets.asyncio.server
from viser import _messages
from viser.infra import ClientId, WebsockMessageHandler
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.http11 import Request, Response

from modeviz.errors import ModevizError
from modeviz.text.log import our_mistake
from modeviz.viewer.page.acceptor import Acceptor
from modeviz.viewer.page.alerts import alert
from modeviz.viewer.page.connection import CLOSING_S, PageConnection
from modeviz.viewer.page.decoding import LARGEST_MESSAGE
from modeviz.viewer.page.front import HANDSHAKE_S, Front, report, silent_logger
from modeviz.viewer.page.handshake import Door
from modeviz.viewer.page.message_filter import gate_messages
from modeviz.viewer.page.notices import Notices
from modeviz.viewer.page.one_page import OnePage
from modeviz.viewer.page.origins import LOOPBACK
from modeviz.viewer.page.secret import Secret
from modeviz.viewer.page.surroundings import NOTHING_AROUND, Surroundings
from modeviz.viewer.page.tokens import checked_token
from modeviz.viewer.page.turns import Turns
from modeviz.viewer.page.visitors import Visitors

STOPPED = "modeviz was stopped, and this page goes on once it runs again"
STOPPED_KEPT = "modeviz was stopped: what you did is kept, and this page goes on once it runs again"
"""Pages show one of both; at most 123 bytes go with the end of a connection."""

DISMISSED_WITHIN = 1.0
"""s that pages have to answer that they close."""

_one_server_at_a_time, _one_is_quiet_at_a_time = threading.Lock(), threading.Lock()

LEFT_ALREADY = r"Queued a \w+ on a closed connection"
"""What viser warns of whenever a page leaves while it is being drawn."""

Handler = Callable[[ServerConnection], Coroutine[Any, Any, None]]


class Server(viser.ViserServer):
    """viser's server of one session: its pages come from the front; silent on the terminal."""

    def __init__(self, front: Front, address: str = "", session: str | None = None) -> None:
        """Waits for pages; see `acceptor`.

        Args:
            front: where pages come in.
            address: what a page's address says after the token, such as "&session=…".
            session: what the log calls it, which opens nothing.
        """
        warnings.filterwarnings("ignore", LEFT_ALREADY, UserWarning)
        self.notices: Notices = front.house.notices
        self.farewell: str = STOPPED
        """What pages are told when it stops."""
        self.acceptor: Acceptor = Acceptor()
        self._front, self._address, self._session = front, address, session
        self._turns = Turns(self._tell_page)
        with _behind(front, self._turns, self.acceptor), _quietly():
            door = front.door
            super().__init__(host=door.host, port=front.get_port(), label=door.title, verbose=False)
        if not self.acceptor.is_ready:
            self.stop()
            raise RuntimeError("viser no longer starts through websockets.asyncio.server.serve")
        for request in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self._websock_server.unregister_handler(request)
        self._thread_executor.shutdown()
        for caller in (self, self.gui, self.scene):
            caller._thread_executor = self._turns
        _let_leave_in_silence(self._websock_server)
        self._websock_server.on_client_connect(_let_leave_in_silence)
        self.visitors: Visitors = Visitors(self)
        gate_messages(self, self._tell_client, self.visitors)
        self.on_client_connect(lambda client: self._note_page(client, "opened"))
        self.on_client_disconnect(lambda client: self._note_page(client, "closed"))

    @property
    def link(self) -> str:
        """The address of the page for everybody who can reach it, with its token."""
        return self._front.link + self._address

    @property
    def local_link(self) -> str:
        """The address of the page for a browser of this machine; ready for `&name=value`."""
        return self._front.local_link + self._address

    def mistake(self, error: Exception, client: viser.ClientHandle | None = None) -> str:
        """Logs our mistake and tells the page it concerns, or all; returns its number in the log."""
        number = self.note_mistake(error)
        for told in self.get_clients().values() if client is None else (client,):
            alert(told, number, "Something went wrong", our_mistake(number))
        return number

    def note_mistake(self, error: Exception) -> str:
        """Logs our mistake as one of this session; returns its number in the log."""
        return self.notices.mistake(error, self._session)

    def note(self, what: str, event: str, **fields: str) -> None:
        """Logs what happens in this session as it should; see `Notices.tell`."""
        self.notices.tell(what, event, session=self._session, **fields)

    def _tell_client(self, client_id: ClientId, error: Exception) -> None:
        self.mistake(error, self.get_clients().get(client_id))

    def _tell_page(self, page: Hashable, error: Exception) -> None:
        """Tells of a mistake in what was done for a page, known by its connection."""
        pages = self._websock_server._live_connections.items()
        known = (client_id for client_id, connection in [*pages] if connection is page)
        self.mistake(error, self.get_clients().get(next(known, -1)))

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never opens viser's public tunnel."""
        return None

    def stop(self) -> None:
        """Tells all pages that it stops, and stops."""
        self._dismiss(self.farewell)
        with _quietly():
            super().stop()
        self._turns.shutdown(wait=False, cancel_futures=True)

    def _note_page(self, client: viser.ClientHandle, what: str) -> None:
        self.note(f"a page was {what}", f"page {what}", client=f"page {client.client_id}")

    def _dismiss(self, why: str) -> None:
        """Closes all connections with a reason, which pages show; waits for nobody who is silent."""
        server = self._websock_server
        loop = server._background_event_loop
        if loop is None or not loop.is_running():
            return
        closing = [
            asyncio.run_coroutine_threadsafe(each.close(CloseCode.GOING_AWAY, why), loop)
            for each in tuple(server._live_connections.values())
        ]
        for late in wait(closing, DISMISSED_WITHIN).not_done:
            late.cancel()


class LoneServer(Server):
    """The only server behind a front of its own: every page is of its session."""

    def __init__(self, front: Front) -> None:
        super().__init__(front)
        front.open(OnePage(front.door, self.acceptor))

    def stop(self) -> None:
        self._front.close()
        super().stop()
        self.notices.tally()


def tell_mistake(client: viser.ClientHandle, error: Exception) -> None:
    """Logs our mistake and tells the page that it concerns."""
    assert isinstance(client._viser_server, Server)
    client._viser_server.mistake(error, client)


def open_server(
    host: str = "127.0.0.1",
    port: int = 8080,
    token: str | Secret | None = None,
    title: str = "modeviz",
    around: Surroundings = NOTHING_AROUND,
    is_framed: bool = False,
) -> Server:
    """A server of one session that only who has the token, or else who is on this machine, can reach.

    Args:
        host: the address to listen on.
        port: to listen on; 0 takes a free one.
        token: what a link must carry, `?token=…`; needed beyond this machine.
        title: of the page.
        around: it, see there.
        is_framed: whether notebooks may show it in a frame, and under any name of their server.

    Raises:
        ModevizError: as `open_front`.
    """
    front = open_front(host, port, token, title, around, is_framed)
    try:
        return LoneServer(front)
    except BaseException:
        front.close()
        raise


def open_front(
    host: str = "127.0.0.1",
    port: int = 8080,
    token: str | Secret | None = None,
    title: str = "modeviz",
    around: Surroundings = NOTHING_AROUND,
    is_framed: bool = False,
) -> Front:
    """Return a front that has its address and lets nobody in yet; arguments as of `open_server`.

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


@contextmanager
def _quietly() -> Iterator[None]:
    """While this lasts, viser says nothing; in a notebook rich shows it past what stdout is.

    By one thread at a time: of two that put an output of their own in place one would stay there.
    """
    with _one_is_quiet_at_a_time:
        console = rich.get_console()
        was_quiet, console.quiet = console.quiet, True
        try:
            with redirect_stdout(io.StringIO()):
                yield
        finally:
            console.quiet = was_quiet


def _let_leave_in_silence(connection: WebsockMessageHandler) -> None:
    """Has viser say nothing on the terminal of what is still said to a page that has left."""
    connection.get_message_buffer()._warned_push_after_done = True


@contextmanager
def _behind(front: Front, turns: Turns, acceptor: Acceptor) -> Iterator[None]:
    """While this lasts, a server that viser starts gets its websockets from a front, past its door."""
    house = front.house

    async def place(connection: PageConnection, request: Request) -> Response | None:
        return await front.door.place(connection, request)

    def inner_serve(handler: Handler, *args: Any, **options: Any):
        asyncio.get_running_loop().set_exception_handler(partial(report, house.notices))
        ours = {
            "process_request": front.door.guard(place),
            "create_connection": partial(PageConnection, house=house, turns=turns),
            "max_size": LARGEST_MESSAGE,
            "open_timeout": HANDSHAKE_S,
            "close_timeout": CLOSING_S,
            "logger": silent_logger(),
        }
        with acceptor.inside():
            return serve(_reported(handler, house.notices), *args, **{**options, **ours})

    with _one_server_at_a_time:
        websockets.asyncio.server.serve = inner_serve
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve


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
