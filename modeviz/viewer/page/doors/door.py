"""The handshake: what every request must pass before viser sees it, and the page it gets.

viser 1.1.1 answers everybody, accepts any Origin and obeys links that load other people's scenes.
"""

from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from urllib.parse import urlsplit

import viser
from websockets import Headers
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.content_policy import content_policy
from modeviz.viewer.page.doors.cookies import give_cookie
from modeviz.viewer.page.doors.entry import Entry, missing, port_of
from modeviz.viewer.page.doors.origins import Origins
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import NOTHING_AROUND, Surroundings
from modeviz.viewer.page.wire.connection import PageConnection
from modeviz.viewer.page.wire.forwarded import Asked
from modeviz.viewer.page.wire.request_head import is_websocket, query_of

OTHER_VERSION = "this page is of another version of modeviz: load it again"
BUSY = "many pages are being opened: this one is tried again"
TOO_MANY_CONNECTIONS = "your address has more connections than it may"
TOO_MANY = "there are as many pages open as this server takes: close some"

ALIVE = "alive.svg"
"""A picture, by which a notebook finds out whether its browser reaches the server and keeps cookies."""

ICON = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32">
<path d="M2 16c5-17 9-17 14 0s9 17 14 0" fill="none" stroke="#2b7cc4" stroke-width="4"/></svg>"""

SUBPROTOCOL = f"viser-v{viser.__version__}"
"""What a websocket of our page says it speaks."""

WHY = "why-no-socket"
"""What a page asks for that cannot open its websocket."""

HEALTH = "/healthz"
"""What a probe asks for."""

ProcessRequest = Callable[[ServerConnection, Request], Awaitable[Response | None]]
Guarded = Callable[[PageConnection, Request], Awaitable[Response | None]]


@dataclass
class Door:
    """Checks every request before viser sees it."""

    host: str
    """The address the server is bound to."""
    secret: Secret | None
    """What opens it; without one whoever is on this machine gets in."""
    title: str
    around: Surroundings = NOTHING_AROUND
    is_framed: bool = False
    """Whether notebooks may show it in a frame, whatever name their server has; it has a token, without
    which a name that was pointed here gets nowhere."""
    health: Callable[[], Response] = lambda: answer(200)
    """Answers who asks how the server is: everybody who knows a name of it, and nothing private."""
    lets_look: Callable[[Request], bool] = lambda _: False
    """Whether a request brings the key of a review in place of the token, and asks for that alone."""
    _entry: Entry = field(init=False)

    def __post_init__(self) -> None:
        self._entry = Entry(self.secret, self._is_in_frames, lambda request: self.lets_look(request))

    @property
    def token(self) -> str | None:
        """That which a link must carry, if any."""
        return self.secret and self.secret.token

    @property
    def _origins(self) -> Origins:
        return Origins(self.host, self.around, self.is_framed and self.token is not None)

    @property
    def _is_in_frames(self) -> bool:
        return self.is_framed or bool(self.around.frames)

    def give_cookie(
        self, connection: PageConnection, response: Response, name: str, value: str, life: float
    ) -> None:
        """Has a browser keep a cookie for s, where it shows the page."""
        give_cookie(response, name, value, life, connection.is_secure, self._is_in_frames)

    def guard(self, inner: Guarded) -> ProcessRequest:
        """Return the handshake of a server, with this door before it."""

        async def process_request(connection: ServerConnection, request: Request) -> Response | None:
            assert isinstance(connection, PageConnection)
            try:
                response = self._seen_through(connection, request) or await self._response(
                    inner, connection, request
                )
                return self._at_home(response)
            except ValueError:  # of an address or a header that is none
                return answer(400, "this request cannot be read")

        return process_request

    def _at_home(self, response: Response | None) -> Response | None:
        """Return an answer that no page of another origin may take a picture or a script from."""
        if response is not None:
            _set(response.headers, "X-Content-Type-Options", "nosniff")
            if not self._is_in_frames:
                _set(response.headers, "Cross-Origin-Resource-Policy", "same-origin")
        return response

    def _seen_through(self, connection: PageConnection, request: Request) -> Response | None:
        """Makes of a request what it was before proxies; the answer if it can't stay at that."""
        asked, path = self._unwrapped(connection.remote_address[0], request)
        connection.is_secure = asked.is_secure
        if path is None:
            folder = self.around.prefix.rpartition("/")[2]
            return answer(303, Location=f"./{folder}/{request.path[len(self.around.prefix) :]}")
        request.path = path
        return None if connection.speak_for(asked.client) else answer(429, TOO_MANY_CONNECTIONS)

    def _unwrapped(self, address: str, request: Request) -> tuple[Asked, str | None]:
        """Gives a request its own Host; returns what else was asked, and the path in our folder."""
        asked = self.around.proxies.asked(address, request.headers)
        if asked.host is not None:
            _set(request.headers, "Host", asked.host)
        return asked, self.around.local_path(request.path)

    async def _response(
        self, inner: Guarded, connection: PageConnection, request: Request
    ) -> Response | None:
        """Return the answer to a request; None to a websocket that may open."""
        if urlsplit(request.path).path == HEALTH:
            return self.refusal(request) or self.health()
        if urlsplit(request.path).path.endswith(f"/{WHY}"):
            why = self.refusal(request) or self._why(connection, request)
            return why or await inner(connection, request)
        if refusal := self.refusal(request) or await self._entry.answer(connection, request):
            return refusal
        if urlsplit(request.path).path.endswith(f"/{ALIVE}"):
            return answer(200, ICON, **{"Content-Type": "image/svg+xml", "Cache-Control": "no-store"})
        response = await inner(connection, request)
        if is_websocket(request):
            return response or self._entry.admit(connection, request)
        return self._entry.renewed(response, connection, request)

    def refusal(self, request: Request) -> Response | None:
        """Return the answer to a request from another site, None to a good one."""
        why = self._origins.refusal(request)
        return None if why is None else answer(403, why)

    def admits(self, request: Request, address: str, port: int) -> bool:
        """Whether a request, from an address at a port, may get more than an answer from this door."""
        try:
            _, path = self._unwrapped(address, request)
            is_refused = path is None or self.refusal(request) is not None
        except ValueError:
            return False
        return not is_refused and self._entry.has_entered(Request(path or "", request.headers), port)

    def policy(self, request: Request) -> str:
        """Return what a page may do, and who may show it, as Content-Security-Policy says it."""
        return content_policy(request.headers["Host"], self.around, self.is_framed)

    async def place(self, connection: PageConnection, request: Request) -> Response | None:
        """Return the answer to a websocket of something else than our page, or of one too many."""
        if SUBPROTOCOL not in request.headers.get("Sec-WebSocket-Protocol", ""):
            return answer(400, OTHER_VERSION)
        if not connection.take_page():
            return answer(503, TOO_MANY)
        return None if await connection.wait_to_open() else answer(503, BUSY)

    def _why(self, connection: PageConnection, request: Request) -> Response | None:
        """Return why this door refuses a page's websocket, which says its address and language."""
        query = query_of(request)
        asked = Request(request.path, Headers(request.headers))
        _set(asked.headers, "Origin", query.get("origin", ""))
        _set(asked.headers, "Upgrade", "websocket")
        if refusal := self.refusal(asked):
            return answer(200, refusal.body.decode())
        if not self._entry.has_entered(request, port_of(connection)):
            return answer(200, missing(request))
        if query.get("subprotocol") != SUBPROTOCOL:
            return answer(200, OTHER_VERSION)
        if not connection.has_page_place():
            return answer(200, TOO_MANY)
        return answer(200, BUSY) if connection.must_wait() else None


def _set(headers: Headers, name: str, value: str) -> None:
    """Replaces a header, where assignment would add a second one."""
    if name in headers:
        del headers[name]
    headers[name] = value
