"""Who gets in: whoever brings the token in a link, and is known by a cookie from then on."""

import asyncio
import re
import threading
from collections.abc import Callable
from urllib.parse import parse_qsl, quote, urlencode, urlsplit
from weakref import WeakSet

from websockets.http11 import Request, Response

from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.cookies import cookies, give_cookie
from modeviz.viewer.page.doors.guesses import Guesses
from modeviz.viewer.page.doors.kept_tokens import LIFE_S, RENEWED_S
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.wire.connection import PageConnection
from modeviz.viewer.page.wire.request_head import is_websocket, query_of

NO_TOKEN = "open the whole link that modeviz printed, with its token"
NO_REVIEW = "this review has ended: ask who shared it for a new link"


class Entry:
    """Lets in who has the token, and puts all out once it changes; without one it is open."""

    def __init__(
        self, secret: Secret | None, is_in_frames: bool, lets_look: Callable[[Request], bool]
    ) -> None:
        """Has let in nobody yet.

        Args:
            secret: what opens it, if it is not open.
            is_in_frames: whether pages of other sites may show ours in a frame.
            lets_look: whether a request brings the key of a review in place of the token.
        """
        self._secret, self._is_in_frames, self._lets_look = secret, is_in_frames, lets_look
        self._guesses = Guesses()
        self._inside: WeakSet[PageConnection] = WeakSet()
        """Websockets that may have opened."""
        self._lock = threading.Lock()
        """Of these."""
        if secret is not None:
            secret.listen(self._throw_out)

    async def answer(self, connection: PageConnection, request: Request) -> Response | None:
        """Return the answer to who has no token, or brings it in the link and gets a cookie for it.

        Who guesses waits longer and longer; who has entered is not asked again.
        """
        if self._secret is None:
            return None
        client, has_entered = connection.client, self.has_entered(request, port_of(connection))
        given = query_of(request).get("token")
        if not given or is_websocket(request):
            return None if has_entered else answer(403, missing(request))
        if not has_entered and (left := self._guesses.locked(client)):
            return answer(
                429, "too many wrong tokens from your address", **{"Retry-After": f"{left:.0f}"}
            )
        if not self._secret.is_token(given):
            await asyncio.sleep(self._guesses.note(client))
            return answer(403, NO_TOKEN)
        self._guesses.forget(client)
        entered = answer(303, Location=_without_token(request.path))
        self._give_entry(self._secret, connection, entered)
        return entered

    def has_entered(self, request: Request, port: int) -> bool:
        """Return whether a request has the cookie of who has brought the token, or needs none."""
        has_cookie = self._secret is None or self._age(request, port) is not None
        return has_cookie or self._lets_look(request)

    def renewed(
        self, response: Response | None, connection: PageConnection, request: Request
    ) -> Response | None:
        """Return an answer with a new cookie, if that of the request is a day old."""
        if response and self._secret and (self._age(request, port_of(connection)) or 0.0) > RENEWED_S:
            self._give_entry(self._secret, connection, response)
        return response

    def admit(self, connection: PageConnection, request: Request) -> Response | None:
        """Remembers a websocket that opens; the answer if the token has changed meanwhile."""
        with self._lock:
            self._inside.add(connection)
        return None if self.has_entered(request, port_of(connection)) else answer(403, missing(request))

    def _give_entry(self, secret: Secret, connection: PageConnection, response: Response) -> None:
        name = _cookie_name(port_of(connection))
        give_cookie(response, name, secret.cookie(), LIFE_S, connection.is_secure, self._is_in_frames)

    def _age(self, request: Request, port: int) -> float | None:
        """Return the time since a request's cookie was given out, s; None if it has none that holds."""
        given = cookies(request).get(_cookie_name(port), "")
        return self._secret and self._secret.age(given)

    def _throw_out(self) -> None:
        """Ends all websockets, as the token has changed: who has brought the new one comes back."""
        with self._lock:
            inside = list(self._inside)
        for connection in inside:
            connection.throw_out()


def port_of(connection: PageConnection) -> int:
    """Return the port at which a connection came in."""
    return connection.local_address[1]


def _cookie_name(port: int) -> str:
    """The name of the cookie: they are shared by all ports of a host."""
    return f"modeviz{port}"


def missing(request: Request) -> str:
    """Return what somebody is told who may not enter."""
    return NO_REVIEW if "review" in query_of(request) else NO_TOKEN


def _without_token(path: str) -> str:
    """The same page without the token, from where the browser is: a proxy may have a longer path."""
    url = urlsplit(path)
    pairs = parse_qsl(url.query, keep_blank_values=True)
    rest = urlencode([pair for pair in pairs if pair[0] != "token"])
    name = quote(re.split(r"[/\\]", url.path)[-1], safe="%")
    return f"./{name}" + (f"?{rest}" if rest else "")
