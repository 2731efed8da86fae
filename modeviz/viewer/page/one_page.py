"""A front with nothing behind it but one page and its session."""

from urllib.parse import urlsplit

from websockets.http11 import Request, Response

from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.door import WHY, Door
from modeviz.viewer.page.doors.page_file import PageFile
from modeviz.viewer.page.wire.acceptor import Acceptor
from modeviz.viewer.page.wire.connection import PageConnection

PATHS = ("/", "/index.html")


class OnePage:
    """Sends everybody to the same page and the same server."""

    def __init__(self, door: Door, acceptor: Acceptor) -> None:
        """Reads nothing yet.

        Args:
            door: that lets people in.
            acceptor: serves the websockets of the page.
        """
        self._page, self._acceptor = PageFile(door, door.title), acceptor

    async def page(self, connection: PageConnection, request: Request) -> Response:
        """Return the page, or that there is none at that address."""
        path = urlsplit(request.path).path
        if path.endswith(f"/{WHY}"):
            return answer(200)
        is_page = path in PATHS
        return self._page.response(request) if is_page else answer(404, "there is no such page")

    async def acceptor(self, request: Request) -> Acceptor | None:
        """Return what serves its websocket."""
        return self._acceptor
