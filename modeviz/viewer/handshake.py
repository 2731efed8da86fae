"""The handshake: what every request must pass before viser sees it, and the page it gets.

viser 1.1.1 answers everybody, accepts any Origin and obeys links that load other people's scenes.
"""

import gzip
import hmac
import http
import ipaddress
import re
import socket
from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass, field
from html import escape
from urllib.parse import parse_qsl, urlencode, urlsplit

from websockets import Headers
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

LOOPBACK = ("127.0.0.1", "localhost", "::1")
REFUSED_PARAMETERS = ("websocket", "playbackPath")
"""In a link they make the page load a scene, with its scripts, from somewhere else."""

HOST = re.compile(r"(?:\[([0-9a-f:.]+)\]|([\w.-]+))(?::\d+)?", re.ASCII | re.IGNORECASE)
"""A Host header: an IPv6 address in brackets or a name, and a port."""

ICON = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32">
<path d="M2 16c5-17 9-17 14 0s9 17 14 0" fill="none" stroke="#2b7cc4" stroke-width="4"/></svg>"""

ProcessRequest = Callable[[ServerConnection, Request], Response | None]


@dataclass
class Door:
    """What every request must pass before viser sees it."""

    host: str
    """The address the server is bound to."""
    token: str | None
    title: str
    is_hung: bool = False
    """Whether a server asks it."""
    is_open: bool = False
    """Nobody enters until messages are gated too."""
    pages: dict[bool, bytes] = field(default_factory=dict)
    """The first page with our title, plain and gzipped."""

    def guard(self, inner: ProcessRequest) -> ProcessRequest:
        """The handshake of a server, with this door before it."""
        self.is_hung = True

        def process_request(connection: ServerConnection, request: Request) -> Response | None:
            if not self.is_open:
                return _answer(503, "starting", Refresh="1")
            refusal = self.refusal(request) or self.token_answer(connection.local_address[1], request)
            if refusal or _is_websocket(request):
                return refusal or inner(connection, request)
            return self._page(inner, connection, request)

        return process_request

    def refusal(self, request: Request) -> Response | None:
        """The answer to a request from another site or for another site's scene, None to a good one."""
        hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
        if len(hosts) != 1 or not self._is_known(hosts[0]):
            return _answer(403, f"{', '.join(hosts)} is not a name of this server")
        if (origins or _is_websocket(request)) and not _is_same_site(origins, hosts[0]):
            return _answer(403, "a page of another site may not use this server")
        for name, _ in parse_qsl(urlsplit(request.path).query, keep_blank_values=True):
            if name in REFUSED_PARAMETERS:
                return _answer(403, f"the parameter {name!r} is refused")
        return None

    def token_answer(self, port: int, request: Request) -> Response | None:
        """The answer to who has no token, or brings it in the link and gets a cookie for it."""
        if self.token is None:
            return None
        cookie = f"modeviz{port}"  # cookies are shared by all ports of a host
        url = urlsplit(request.path)
        query = parse_qsl(url.query, keep_blank_values=True)
        if not _is_websocket(request) and _equal(dict(query).get("token", ""), self.token):
            rest = urlencode([pair for pair in query if pair[0] != "token"])
            return _answer(
                303,
                Location="/" + url.path.lstrip("/\\") + (f"?{rest}" if rest else ""),
                **{"Set-Cookie": f"{cookie}={self.token}; HttpOnly; SameSite=Strict; Path=/"},
            )
        if not _equal(_cookies(request).get(cookie, ""), self.token):
            return _answer(403, "open the whole link that modeviz printed, with its token")
        return None

    def _is_known(self, host: str) -> bool:
        """Whether a Host header names this server, so that no foreign name was pointed at it.

        An address cannot be pointed anywhere else, so any will do on a server that is open to others.
        """
        match = HOST.fullmatch(host)
        if match is None:
            return False
        name = (match[1] or match[2]).lower()
        if name in LOOPBACK or self.host in LOOPBACK:
            return name in LOOPBACK
        return name in (self.host, socket.gethostname().lower()) or _is_address(name)

    def _page(
        self, inner: ProcessRequest, connection: ServerConnection, request: Request
    ) -> Response | None:
        """What viser answers; the first page with our title and icon, all with our headers."""
        is_first_page = urlsplit(request.path).path in ("/", "/index.html")
        zipped = "gzip" in request.headers.get("Accept-Encoding", "")
        if is_first_page:
            _set(request.headers, "Accept-Encoding", "identity")
        response = inner(connection, request)
        if response is None or response.status_code != 200:
            return response
        if is_first_page:
            if not self.pages:
                page = named_page(response.body, self.title)
                self.pages = {False: page, True: gzip.compress(page, 6)}
            response.body = self.pages[zipped]
            _set(response.headers, "Content-Length", str(len(response.body)))
            _set(response.headers, "Content-Encoding", "gzip" if zipped else "identity")
        host = request.headers["Host"]
        response.headers["Content-Security-Policy"] = (
            f"frame-ancestors 'none'; connect-src 'self' ws://{host} wss://{host} data: blob:; "
            "object-src 'none'; base-uri 'none'"
        )
        return response


def named_page(page: bytes | bytearray, title: str) -> bytes:
    """Viser's page with another title and our icon."""
    icon = "data:image/svg+xml;base64," + b64encode(ICON.encode()).decode()
    html = page.decode().replace("<title>Viser</title>", f"<title>{escape(title)}</title>", 1)
    return re.sub(r'(<link\s+rel="icon"\s+href=)"[^"]*"', rf'\1"{icon}"', html, count=1).encode()


def _answer(status: int, text: str = "", **headers: str) -> Response:
    body = text.encode()
    common = {
        "Content-Type": "text/plain; charset=utf-8",
        "Content-Length": str(len(body)),
        "Connection": "close",
        "Referrer-Policy": "no-referrer",
    }
    return Response(status, http.HTTPStatus(status).phrase, Headers({**common, **headers}), body)


def _is_websocket(request: Request) -> bool:
    return request.headers.get("Upgrade", "").lower() == "websocket"


def _is_same_site(origins: list[str], host: str) -> bool:
    same = {f"{scheme}://{host.lower()}" for scheme in ("http", "https")}
    return len(origins) == 1 and origins[0].lower() in same


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _cookies(request: Request) -> dict[str, str]:
    pairs = (pair for line in request.headers.get_all("Cookie") for pair in line.split(";"))
    return {name: value for name, _, value in (pair.strip().partition("=") for pair in pairs)}


def _equal(given: str, token: str) -> bool:
    return hmac.compare_digest(given.encode(), token.encode())


def _set(headers: Headers, name: str, value: str) -> None:
    """Replaces a header, where assignment would add a second one."""
    if name in headers:
        del headers[name]
    headers[name] = value
