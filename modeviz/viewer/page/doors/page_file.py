"""The page itself: viser's, under our name, with headers that keep other sites out."""

import gzip
import json
import re
from base64 import b64encode
from functools import cached_property
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Literal

import viser
from websockets import Headers
from websockets.http11 import Request, Response

from modeviz.viewer.page.doors.door import ICON, SUBPROTOCOL, WHY, Door

PAGE = Path(viser.__file__).parent / "client" / "build" / "index.html"
CONNECTING = "page/browser/connecting.js"

Scheme = Literal["light", "dark", "light dark"]


class PageFile:
    """One page, plain and gzipped, as it is given to whoever may have it."""

    def __init__(self, door: Door, title: str, scheme: Scheme = "light dark") -> None:
        """Reads nothing yet.

        Args:
            door: who says where the page may be framed and under which names it is known.
            title: of the page.
            scheme: its colours until it is connected; "light dark": those of the browser's system.
        """
        self._door, self._title = door, title
        self._scheme: Scheme = scheme

    def response(self, request: Request) -> Response:
        """Return the page, zipped for who can read that."""
        is_zipped = "gzip" in request.headers.get("Accept-Encoding", "")
        body = self._zipped if is_zipped else self._plain
        headers = {
            "Content-Type": "text/html; charset=utf-8",
            "Content-Length": str(len(body)),
            "Content-Encoding": "gzip" if is_zipped else "identity",
            "Content-Security-Policy": self._door.policy(request),
        }
        return Response(200, "OK", Headers(headers), body)

    @cached_property
    def _plain(self) -> bytes:
        return _explained(named_page(PAGE.read_bytes(), self._title), self._scheme)

    @cached_property
    def _zipped(self) -> bytes:
        return gzip.compress(self._plain, 6)


def named_page(page: bytes | bytearray, title: str) -> bytes:
    """Return viser's page with another title and our icon."""
    icon = "data:image/svg+xml;base64," + b64encode(ICON.encode()).decode()
    html = page.decode().replace("<title>Viser</title>", f"<title>{escape(title)}</title>", 1)
    return re.sub(r'(<link\s+rel="icon"\s+href=)"[^"]*"', rf'\1"{icon}"', html, count=1).encode()


def _explained(page: bytes, scheme: Scheme) -> bytes:
    """Return a page that says what is wrong while its websocket is not open."""
    function = files("modeviz.viewer").joinpath(CONNECTING).read_text("utf-8").rstrip()
    given = ", ".join(map(json.dumps, (WHY, SUBPROTOCOL, scheme)))
    script = f"<script>({function})({given});</script>"
    before, head, after = page.partition(b"<head>")
    return before + head + script.encode() + after
