"""Left column: the folders of all pages that say who is there and who presents."""

import math
import threading
import time
from collections.abc import Callable
from functools import partial

import viser

from modeviz.viewer.page.server import Server
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.panels.review.card import ReviewCard
from modeviz.viewer.panels.review.presence import Presence
from modeviz.viewer.session.session_title import SessionTitle
from modeviz.viewer.session.worker import Worker


class ReviewPanel:
    """The folders of all pages."""

    def __init__(
        self, server: Server, follow: Callable[[int, str | None], None], title: SessionTitle
    ) -> None:
        """Builds one on every page that comes.

        Args:
            server: of the session.
            follow: lets the camera of a page follow who presents, or no longer; as `Following.switch`.
            title: of the session.
        """
        self._visitors, self._follow, self._title = server.visitors, follow, title
        self._lock = threading.RLock()
        self._cards: dict[int, ReviewCard] = {}
        self._pointed_out: dict[int, float] = {}
        self._teller: Worker[bool] = Worker(lambda _: self._show_all(), server.mistake)
        server.on_client_connect(self._add)
        server.on_client_disconnect(self._drop)
        self._visitors.on_change(lambda: self._teller.submit(True))
        title.on_change(lambda: self._teller.submit(True))
        self._visitors.on_refusal(self._point_out)
        self._server = server

    def close(self) -> None:
        """Tells nobody any more."""
        self._teller.close()

    def _add(self, client: viser.ClientHandle) -> None:
        page = client.client_id
        if self._visitors.of_page(page) is None:  # a browser of ours, which takes pictures
            return
        with self._lock:
            self._cards[page] = ReviewCard(
                client, self._visitors, self._title, partial(self._follow, page)
            )
            self._show(page)
        if self._visitors.of_page(page) is None:  # it has left meanwhile
            self._drop(client)

    def _drop(self, client: viser.ClientHandle) -> None:
        with self._lock:
            self._cards.pop(client.client_id, None)
            self._pointed_out.pop(client.client_id, None)

    def _show_all(self) -> None:
        with self._lock:
            for page in tuple(self._cards):
                self._show(page)

    def _show(self, page: int) -> None:
        visitors, you = self._visitors, self._visitors.of_page(page)
        if you is None or page not in self._cards:
            return
        has_control = visitors.has_control(page)
        self._cards[page].show(
            Presence(
                you,
                visitors.there,
                visitors.presenter,
                has_control,
                visitors.link,
                visitors.is_shared,
                visitors.can_share,
                self._title.text,
            )
        )

    def _point_out(self, page: int) -> None:
        """Points out on a page that it may not change anything, at most twice a second."""
        client, now = self._server.get_clients().get(page), time.monotonic()
        if client is not None and now - self._pointed_out.get(page, -math.inf) > 0.5:
            self._pointed_out[page] = now
            scripts.run(client.gui, "page/browser/refused.js")
