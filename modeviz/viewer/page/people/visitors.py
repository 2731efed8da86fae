"""Who is there, and who of them is in control: the owner of a session, or who was handed it.

Pages that came by a session's own address are its owner's, however many there are; those that came by
the link of a review are visitors', told apart by what their browsers remember. Whoever is not known has
no control.
"""

import asyncio
import secrets
import threading
from collections.abc import Callable, Sequence
from functools import partial

import viser
from viser.infra import WebsockClientConnection
from websockets.frames import CloseCode

from modeviz.text.wording import sentence_case
from modeviz.viewer.page.people.acquaintances import Visitor
from modeviz.viewer.page.people.attendance import Attendance
from modeviz.viewer.page.people.introductions import introduction, is_review, person_name
from modeviz.viewer.page.people.sharing import Share, Sharing
from modeviz.viewer.page.wire.connection import PageConnection, connection_of
from modeviz.viewer.page.wire.turns import page_heard
from modeviz.viewer.session.author import OWNER, Author

ENDED = "the review has ended: ask for another link"

FAREWELL_S = 0.3
"""s that a page which is put out has to say so."""

GRACE_S = 8.0
"""How long who presents may be away, such as while a page is loaded again, and stays in control."""

Changed = Callable[[], None]


class Visitors:
    """Who looks at a session now, and which of them changes it; all threads may ask."""

    def __init__(self, server: viser.ViserServer) -> None:
        """Watches the pages of a server, which is that of one session."""
        self._server = server
        self._lock = threading.RLock()
        self._attendance = Attendance()
        self._share = Share()
        self._own_key = secrets.token_urlsafe()
        self._listeners: list[Changed] = []
        self._on_refusal: Callable[[int], None] = lambda _: None
        server._websock_server.on_client_connect(self._enter)
        server._websock_server.on_client_disconnect(self._leave)

    @property
    def own_key(self) -> str:
        """What a browser of ours, which takes pictures, says it is: it is nobody who looks."""
        return self._own_key

    @property
    def can_share(self) -> bool:
        """Whether the owner can share the session."""
        return self._share.is_offered

    @property
    def is_shared(self) -> bool:
        """Whether who has the link of a review may look."""
        return self._share.is_open

    @property
    def link(self) -> str:
        """That of the review, if it was made since the session was opened; else ""."""
        return self._share.link

    @property
    def there(self) -> Sequence[Visitor]:
        """Who looks now, the owner first, then as they came."""
        with self._lock:
            return self._attendance.there

    @property
    def presenter(self) -> Visitor | None:
        """The visitor who was handed control; None: the owner has it."""
        with self._lock:
            return self._attendance.presenter

    def of_page(self, client_id: int) -> Visitor | None:
        """Return who looks at a page, if it is open."""
        with self._lock:
            return self._attendance.of_page(client_id)

    def has_control(self, client_id: int) -> bool:
        """Whether a page may change the session."""
        with self._lock:
            return self._attendance.has_control(client_id)

    def acting(self) -> Author:
        """Return who asks for what is being done in this thread; the owner where nobody does."""
        page = page_heard.get()
        with self._lock:
            is_page = isinstance(page, PageConnection)
            visitor = self._attendance.of_key(page.visitor) if is_page else None
        return visitor.author if visitor else OWNER

    def on_change(self, listener: Changed) -> None:
        """Has something called, in any thread, when people come, leave, are renamed or take control."""
        self._listeners.append(listener)

    def on_refusal(self, listener: Callable[[int], None]) -> None:
        """Has something called, in the server's loop, with a page that asked for what it may not."""
        self._on_refusal = listener

    def refuse(self, client_id: int) -> None:
        """Tells on that a page without control asked for something."""
        self._on_refusal(client_id)

    def rename(self, client_id: int, name: str) -> Visitor | None:
        """Gives who looks at a page another name, or one like it that is free; "" gives none."""
        with self._lock:
            named = self._attendance.rename(client_id, person_name(name))
        self._tell()
        return named

    def hand_over(self, by: int, number: int) -> Visitor | None:
        """Puts somebody who is there in control, if who looks at the page `by` may do that.

        The owner may, and who is in control; the owner's number gives control back.

        Returns:
            Who is in control now; None if nothing came of it.
        """
        with self._lock:
            taker = self._attendance.hand_over(by, number)
        if taker is not None:
            self._tell()
        return taker

    def offer(self, sharing: Sharing, is_shared: bool = False) -> None:
        """Lets the owner share the session.

        Args:
            sharing: makes the link.
            is_shared: whether somebody has a link already that still counts.
        """
        self._share.offer(sharing, is_shared)
        self._tell()

    def share(self) -> str:
        """Lets in who has the link of the review, and gives it.

        Raises:
            ModevizError: nothing is offered to share.
        """
        link = self._share.start(self.acting().name)
        self._tell()
        return link

    def stop_sharing(self) -> None:
        """Tells visitors that the review has ended, puts them out, and lets no more in."""
        self._share.stop()
        with self._lock:
            self._attendance.take_back()
            guests = self._attendance.guest_pages
        for page in guests:
            self._put_out(page)
        self._tell()

    async def _enter(self, page: WebsockClientConnection) -> None:
        """Notes who has opened a page, before it is sent anything; sends away who may not look."""
        connection = connection_of(self._server, page.client_id)
        if connection is None or connection.request is None:
            return
        said = introduction(connection.request)
        is_owner = not is_review(connection.request)
        if said.key == self._own_key:
            return
        with self._lock:
            if may_look := is_owner or self._share.is_open:
                key = f"{'owner' if is_owner else 'visitor'} {said.key}"
                connection.visitor = key
                self._attendance.enter(page.client_id, key, said.name, is_owner)
        if may_look:
            self._tell()
        else:
            await connection.close(CloseCode.POLICY_VIOLATION, ENDED)

    def _leave(self, page: WebsockClientConnection) -> None:
        with self._lock:
            key = self._attendance.leave(page.client_id)
            if key is None:
                return
            is_gone = self._attendance.is_away(key)
        if is_gone:
            loop = self._server.get_event_loop()
            loop.call_later(GRACE_S, partial(self._take_back_from, key))
        self._tell()

    def _take_back_from(self, key: str) -> None:
        """Puts the owner in control unless a visitor has come back."""
        with self._lock:
            if not self._attendance.is_away(key):
                return
            self._attendance.take_back()
        self._tell()

    def _put_out(self, page: int) -> None:
        """Says goodbye to a page, and closes it a moment later."""
        connection, client = connection_of(self._server, page), self._server.get_clients().get(page)
        if client is not None:
            client.add_notification("Goodbye", f"{sentence_case(ENDED)}.", color="orange")
            client.flush()
        if connection is not None:
            self._server.get_event_loop().call_soon_threadsafe(_close_soon, connection)

    def _tell(self) -> None:
        for listener in self._listeners:
            listener()


def _close_soon(connection: PageConnection) -> None:
    """Closes a page once it has had the time to say why; called in the loop of its server."""
    loop = asyncio.get_running_loop()
    closing = partial(connection.close, CloseCode.POLICY_VIOLATION, ENDED)
    loop.call_later(FAREWELL_S, lambda: loop.create_task(closing()))
