"""Files that pages ask for: made beside everything else, and downloaded when they are done."""

import threading
from collections.abc import Callable

import viser

from modeviz.viewer.page.server import Server
from modeviz.viewer.page.wire.house import MOST_PAGES
from modeviz.viewer.page.wire.limits import Places
from modeviz.viewer.tasks.page_jobs import Progress, run, turn

Maker = Callable[[viser.ClientHandle, Progress], tuple[str, bytes]]
"""Gives a file's name and its content."""


class Downloads:
    """Makes files for pages, one at a time for each; nobody's controls wait for it."""

    def __init__(self, server: Server, n_at_once: int) -> None:
        """Nothing is made yet.

        Args:
            server: whose pages ask.
            n_at_once: how many files are made at once, for all pages together.
        """
        self._server = server
        self._pages, self._jobs = Places(MOST_PAGES, 1), threading.Semaphore(n_at_once)

    def begin(self, client: viser.ClientHandle | None, title: str, make: Maker) -> None:
        """Begins to make a file for a page, unless it waits for another one.

        Args:
            client: the page.
            title: what is being made.
            make: makes it, and tells how far it is.
        """
        if client is not None and self._pages.take(str(client.client_id)):
            work = (client, title, make)
            threading.Thread(target=self._make, args=work, name="download", daemon=True).start()

    def _make(self, client: viser.ClientHandle, title: str, make: Maker) -> None:
        def work(tell: Progress) -> None:
            with turn(self._jobs, tell):
                name, content = make(client, tell)
            tell(1.0)  # the last moment to cancel
            client.send_file_download(name, content, save_immediately=True)

        def is_there() -> bool:
            return client.client_id in self._server.get_clients()

        try:
            run(client, title, work, is_there, self._server.note_mistake)
        finally:
            self._pages.leave(str(client.client_id))
