"""The server of one session: viser's, behind our handshake, limits and message filter, and silent."""

import asyncio
import warnings
from collections.abc import Callable, Hashable
from concurrent.futures import wait
from typing import ParamSpec

import viser
from viser import _messages
from viser.infra import ClientId
from websockets.frames import CloseCode

from modeviz.text.log import our_mistake
from modeviz.viewer.page.front import Front, open_front
from modeviz.viewer.page.message_filter import gate_messages
from modeviz.viewer.page.one_page import OnePage
from modeviz.viewer.page.people.visitors import Visitors
from modeviz.viewer.page.viser_start import behind, let_leave_in_silence, quietly
from modeviz.viewer.page.widgets.alerts import alert
from modeviz.viewer.page.wire.acceptor import Acceptor
from modeviz.viewer.page.wire.notices import Notices
from modeviz.viewer.page.wire.turns import Turns

Options = ParamSpec("Options")

STOPPED = "modeviz was stopped, and this page goes on once it runs again"
STOPPED_KEPT = "modeviz was stopped: what you did is kept, and this page goes on once it runs again"
"""Pages show one of both; at most 123 bytes go with the end of a connection."""

DISMISSED_WITHIN = 1.0
"""s that pages have to answer that they close."""

LEFT_ALREADY = r"Queued a \w+ on a closed connection"
"""What viser warns of whenever a page leaves while it is being drawn."""


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
        with behind(front, self._turns, self.acceptor), quietly():
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
        let_leave_in_silence(self._websock_server)
        self._websock_server.on_client_connect(let_leave_in_silence)
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
        with quietly():
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


def _with_server(opened: Callable[Options, Front]) -> Callable[Options, Server]:
    """Return what opens a front as `opened` does, and gives the only server behind it."""

    def open_server(*arguments: Options.args, **options: Options.kwargs) -> Server:
        front = opened(*arguments, **options)
        try:
            return LoneServer(front)
        except BaseException:
            front.close()
            raise

    return open_server


open_server = _with_server(open_front)
"""Return a server of one session; arguments and errors as of `open_front`."""
