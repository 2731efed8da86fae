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
from typing import Protocol

import viser
from viser.infra import WebsockClientConnection
from websockets.frames import CloseCode

from modeviz.errors import ModevizError
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.acquaintances import Acquaintances, Visitor
from modeviz.viewer.page.connection import PageConnection, connection_of
from modeviz.viewer.page.introductions import introduction, is_review, person_name
from modeviz.viewer.page.turns import page_heard
from modeviz.viewer.session.author import OWNER, Author

ENDED = "the review has ended: ask for another link"

FAREWELL_S = 0.3
"""s that a page which is put out has to say so."""

GRACE_S = 8.0
"""How long who presents may be away, such as while a page is loaded again, and stays in control."""

Changed = Callable[[], None]


class Sharing(Protocol):
    """What makes the link of a review."""

    def share(self, author: str) -> str:
        """Makes the link, or gives the one there is: whole, or from the page such as "./?review=…".

        Args:
            author: who shares the session.
        """
        ...

    def stop(self) -> None:
        """Makes the link open nothing any more."""
        ...


class Visitors:
    """Who looks at a session now, and which of them changes it; all threads may ask."""

    def __init__(self, server: viser.ViserServer) -> None:
        """Watches the pages of a server, which is that of one session."""
        self._server = server
        self._lock = threading.RLock()
        self._known = Acquaintances()
        self._pages: dict[int, str] = {}
        """The keys of who looks, by page."""
        self._presenter = ""
        """The key of the visitor who is in control; "" while the owner is."""
        self._own_key = secrets.token_urlsafe()
        self._sharing: Sharing | None = None
        self._link, self._is_shared = "", False
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
        return self._sharing is not None

    @property
    def is_shared(self) -> bool:
        """Whether who has the link of a review may look."""
        return self._is_shared

    @property
    def link(self) -> str:
        """That of the review, if it was made since the session was opened; else ""."""
        return self._link

    @property
    def there(self) -> Sequence[Visitor]:
        """Who looks now, the owner first, then as they came."""
        with self._lock:
            present = {v.number: v for key in self._pages.values() if (v := self._known.get(key))}
        return sorted(present.values(), key=lambda each: (not each.is_owner, each.number))

    @property
    def presenter(self) -> Visitor | None:
        """The visitor who was handed control; None: the owner has it."""
        with self._lock:
            return self._known.get(self._presenter)

    def of_page(self, client_id: int) -> Visitor | None:
        """Return who looks at a page, if it is open."""
        with self._lock:
            return self._known.get(self._pages.get(client_id, ""))

    def has_control(self, client_id: int) -> bool:
        """Whether a page may change the session."""
        with self._lock:
            visitor = self.of_page(client_id)
            return visitor is not None and self._is_in_control(visitor)

    def acting(self) -> Author:
        """Return who asks for what is being done in this thread; the owner where nobody does."""
        page = page_heard.get()
        with self._lock:
            visitor = self._known.get(page.visitor) if isinstance(page, PageConnection) else None
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
            named = self._known.rename(self._pages.get(client_id, ""), person_name(name), self.there)
        self._tell()
        return named

    def hand_over(self, by: int, number: int) -> Visitor | None:
        """Puts somebody who is there in control, if who looks at the page `by` may do that.

        The owner may, and who is in control; the owner's number gives control back.

        Returns:
            Who is in control now; None if nothing came of it.
        """
        with self._lock:
            giver = self.of_page(by)
            taker = next((each for each in self.there if each.number == number), None)
            if giver is None or taker is None:
                return None
            if not (giver.is_owner or self._is_in_control(giver)):
                return None
            self._presenter = "" if taker.is_owner else self._key(taker)
        self._tell()
        return taker

    def offer(self, sharing: Sharing, is_shared: bool = False) -> None:
        """Lets the owner share the session.

        Args:
            sharing: makes the link.
            is_shared: whether somebody has a link already that still counts.
        """
        self._sharing, self._is_shared = sharing, is_shared
        self._tell()

    def share(self) -> str:
        """Lets in who has the link of the review, and gives it.

        Raises:
            ModevizError: nothing is offered to share.
        """
        if self._sharing is None:
            raise ModevizError("this page cannot be shared")
        self._link, self._is_shared = self._sharing.share(self.acting().name), True
        self._tell()
        return self._link

    def stop_sharing(self) -> None:
        """Tells visitors that the review has ended, puts them out, and lets no more in."""
        if self._sharing is not None:
            self._sharing.stop()
        with self._lock:
            self._link = self._presenter = ""
            self._is_shared = False
            guests = [page for page in self._pages if not self._is_owners(page)]
        for page in guests:
            self._put_out(page)
        self._tell()

    def _key(self, visitor: Visitor) -> str:
        """Return the key of somebody who is there."""
        return next(key for page, key in self._pages.items() if self.of_page(page) == visitor)

    def _is_owners(self, page: int) -> bool:
        visitor = self.of_page(page)
        return visitor is not None and visitor.is_owner

    def _is_in_control(self, visitor: Visitor) -> bool:
        presenter = self._known.get(self._presenter)
        return visitor.is_owner if presenter is None else visitor.number == presenter.number

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
            if may_look := is_owner or self._is_shared:
                key = f"{'owner' if is_owner else 'visitor'} {said.key}"
                self._known.meet(key, said.name, is_owner, self.there)
                connection.visitor = self._pages[page.client_id] = key
                self._known.forget({*self._pages.values(), self._presenter})
        if may_look:
            self._tell()
        else:
            await connection.close(CloseCode.POLICY_VIOLATION, ENDED)

    def _leave(self, page: WebsockClientConnection) -> None:
        with self._lock:
            key = self._pages.pop(page.client_id, None)
            if key is None:
                return
            is_gone = key == self._presenter and key not in self._pages.values()
        if is_gone:
            loop = self._server.get_event_loop()
            loop.call_later(GRACE_S, partial(self._take_back_from, key))
        self._tell()

    def _take_back_from(self, key: str) -> None:
        """Puts the owner in control unless a visitor has come back."""
        with self._lock:
            if key != self._presenter or key in self._pages.values():
                return
            self._presenter = ""
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
