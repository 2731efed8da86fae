"""One connection of a client: counted from its first byte, read no faster than it may speak."""

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

import viser
from viser.infra import ClientId
from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode

from modeviz.viewer.page.wire.decoding import LARGEST_MESSAGE, MessageError, TooMuchError, checked
from modeviz.viewer.page.wire.house import House
from modeviz.viewer.page.wire.limits import Places, client_of
from modeviz.viewer.page.wire.pace import HurryError, Pace
from modeviz.viewer.page.wire.slow_readers import ReadingWatch, hold_little
from modeviz.viewer.page.wire.turns import MOST_WAITING, Turns, page_heard

LONGEST_WAIT = 8.0
"""s for a place among them, before a client would give up."""

MOST_WRONG = 100
"""Messages that no page sends, after which one is closed."""

CLOSING_S = 2.0
"""s: how long a client may take to close."""

SILENT = 30.0
"""s: a page tells of its camera as soon as it is connected."""

SOON = 0.02
"""s between two looks whether a page has less to do."""


class PageConnection(ServerConnection):
    """A connection to viser's server: of few from one client, its messages whole and in fair number."""

    def __init__(
        self, *arguments: Any, house: House, turns: Turns | None = None, **options: Any
    ) -> None:
        """As websockets does, in a house that has places for it or none; calls take their turns."""
        super().__init__(*arguments, **options)
        self._house, self._turns = house, turns
        self.client: str = "a client"
        """Who it is, see `client_of`."""
        self.is_secure: bool = False
        """Whether it came by TLS, to a proxy."""
        self.visitor: str = ""
        """Who looks at the page, see `Visitors`; "" before that is known."""
        self._places: list[Places] = []
        self._pace = Pace()
        self._reading = ReadingWatch(self._end_slow)
        self._n_wrong = 0
        self._is_heard = self._is_ending = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Begins a connection, or ends it where there is no place for it."""
        peer = transport.get_extra_info("peername")
        self.client = client_of(peer[0]) if peer else "a client"
        is_proxy = peer is not None and self._house.proxies.trusts(peer[0])
        if self._take(self._house.connections, is_one=not is_proxy):
            hold_little(transport)
            super().connection_made(transport)
        else:
            self._note("opened more connections than it may: the last are refused")
            assert isinstance(transport, asyncio.Transport)
            transport.abort()

    def data_received(self, data: bytes) -> None:
        """Reads what came; a client that is told to close has little time to do so."""
        super().data_received(data)
        if self.protocol.close_expected() and not self._is_ending:
            self._is_ending = True
            self.loop.call_later(CLOSING_S, self.transport.abort)

    def pause_writing(self) -> None:
        """Waits with what is to be sent, but not for ever for somebody who does not read it."""
        super().pause_writing()
        self._reading.begin(self.transport)

    def resume_writing(self) -> None:
        """Goes on: so much has been read."""
        super().resume_writing()
        self._reading.end()

    def connection_lost(self, exc: Exception | None) -> None:
        """Gives its places back."""
        self._reading.end()
        if self._places:
            super().connection_lost(exc)
        for places in self._places:
            places.leave(self.client)
        self._places.clear()

    def speak_for(self, address: str) -> bool:
        """Counts it as one of who asked a proxy; whether that one may have it."""
        client = client_of(address)
        if client == self.client:
            return True
        if not self._house.connections.take(client):
            return False
        self._house.connections.leave(self.client)
        self.client = client
        return True

    def take_page(self) -> bool:
        """Takes a place for a page; whether there is one."""
        taken = self._take(self._house.pages)
        if not taken:
            self._note("opened more pages than it may: the last are refused")
        return taken

    def has_page_place(self) -> bool:
        """Whether a page would get one."""
        return self._house.pages.is_free(self.client)

    def must_wait(self) -> bool:
        """Whether so many pages are being opened that another would have to wait."""
        return self._house.openings.take(0.0) > 0.0

    def throw_out(self) -> None:
        """Ends the connection at once; from any thread."""
        with suppress(RuntimeError):  # its loop has ended
            self.loop.call_soon_threadsafe(self.transport.abort)

    def ask(self, n_bytes: int | None) -> None:
        """Lets the page send messages that are as large as what it is asked for, or no longer."""
        self._pace.is_asked = n_bytes is not None
        self.protocol.max_message_size = max(n_bytes or 0, LARGEST_MESSAGE)

    def expect(self, n_bytes: int) -> None:
        """Lets the page send so much more: a file of which it told, and which is taken."""
        self._pace.expect(n_bytes)

    async def wait_to_open(self) -> bool:
        """Waits until another page may be sent all there is; whether that is soon enough."""
        wait = self._house.openings.take()
        if wait > LONGEST_WAIT:
            self._house.openings.take(-1.0)
            return False
        await asyncio.sleep(wait)
        return True

    async def recv(self, decode: bool | None = None) -> Any:
        """The next message that viser may read, when it is this page's turn.

        Raises:
            ConnectionClosed: the page has left, or was closed because it went too far.
        """
        page_heard.set(self)
        while True:
            raw = await self._next()
            try:
                await self._turn(len(raw))
                message = checked(raw)
            except TooMuchError:
                await self._end("sent a message that is too large or too deep")
            except MessageError:
                self._n_wrong += 1
                self._note("sent messages that no page sends: they are left out")
                if self._n_wrong > MOST_WRONG:
                    await self._end(f"sent {MOST_WRONG} messages that no page sends")
            else:
                return message

    async def _next(self) -> bytes | str:
        """Return the next message; the first must not take long."""
        try:
            async with asyncio.timeout(None if self._is_heard else SILENT):
                raw = await super().recv()
        except TimeoutError:
            await self._end(f"said nothing for {SILENT:.0f} s")
        except ConnectionClosed as closed:
            if closed.sent and closed.sent.code == CloseCode.MESSAGE_TOO_BIG:
                self._note("sent a message that is too large: its page is closed")
            raise
        self._is_heard = True
        return raw

    async def _turn(self, n_bytes: int) -> None:
        """Waits until this page may be heard, as it has said so much."""
        try:
            wait = self._pace.take(n_bytes)
        except HurryError as hurry:
            await self._end(str(hurry))
        await asyncio.sleep(wait)
        while self._turns and self._turns.n_waiting(self) > MOST_WAITING:
            await asyncio.sleep(SOON)

    async def _end(self, why: str) -> NoReturn:
        """Closes the connection, says why, and raises as a closed one does."""
        self._note(f"{why}: its page is closed")
        await self.close(CloseCode.POLICY_VIOLATION, f"This page {why}.")
        raise self.protocol.close_exc

    def _end_slow(self) -> None:
        """Ends a page that hardly reads; it comes again."""
        self._note("reads too slowly: its page is closed, and comes again by itself")
        self.transport.abort()

    def _note(self, what: str) -> None:
        self._house.notices.note(self.client, what)

    def _take(self, places: Places, is_one: bool = True) -> bool:
        if not places.take(self.client, is_one):
            return False
        self._places.append(places)
        return True


@contextmanager
def asked(client: viser.ClientHandle, n_bytes: int) -> Iterator[None]:
    """While this lasts, a page may send as much at once as what it is asked for."""
    connection = connection_of(client._viser_server, client.client_id)
    if connection is None:
        yield
        return
    connection.ask(n_bytes)
    try:
        yield
    finally:
        connection.ask(None)


def expect(server: viser.ViserServer, client_id: ClientId, n_bytes: int) -> None:
    """Lets a page send a file of so many bytes beyond what it may send otherwise."""
    connection = connection_of(server, client_id)
    if connection is not None:
        connection.expect(n_bytes)


def connection_of(server: viser.ViserServer, client_id: int) -> PageConnection | None:
    """Return the connection of a page; None if it has left, or is none of ours."""
    connection = server._websock_server._live_connections.get(ClientId(client_id))
    return connection if isinstance(connection, PageConnection) else None
