"""What the addresses of pages ask for, and which sessions a browser remembers."""

import secrets
from collections.abc import Mapping
from dataclasses import dataclass
from re import fullmatch
from urllib.parse import urlencode

from websockets.http11 import Request, Response

from modeviz.journal.keys import digest_of
from modeviz.journal.sessions import SessionId
from modeviz.viewer.page.doors.cookies import cookies
from modeviz.viewer.page.front import Front
from modeviz.viewer.page.wire.connection import PageConnection
from modeviz.viewer.serving.bench import Bench

KEPT = 365 * 86400
"""s for which a browser remembers its last sessions."""

MOST_LEFT = 6
"""Sessions of a vehicle that it remembers."""

Place = tuple[str, SessionId]
"""A session: its vehicle, as addresses call it, and what the study of that knows it as."""

KEY = r"[A-Za-z0-9_-]{22}"


@dataclass(frozen=True)
class Visit:
    """What a page's address asks for."""

    vehicle: str
    session: SessionId
    key: str
    """Of the session; "" to who comes with that of a review."""
    view: str | None
    """What a new session is to show, as a link says it."""

    @property
    def place(self) -> Place:
        """The session; the same key is another's of another vehicle."""
        return self.vehicle, self.session


class Addresses:
    """The addresses of a server's vehicles, sessions and reviews."""

    def __init__(self, front: Front, benches: Mapping[str, Bench]) -> None:
        """Knows no session.

        Args:
            front: where pages come in.
            benches: the vehicles, by what addresses call them.
        """
        self._front, self._benches = front, benches

    def vehicle(self, query: Mapping[str, str]) -> str | None:
        """Return the name of the vehicle an address asks for, the only one if it says none."""
        only = next(iter(self._benches)) if len(self._benches) == 1 else ""
        name = query.get("vehicle", only)
        return name if name in self._benches else None

    def visit(self, query: Mapping[str, str]) -> Visit | None:
        """Return what an address asks for; None if there is no such session."""
        name = self.vehicle(query)
        key, review = query.get("session", ""), query.get("review", "")
        if name is None:
            return None
        if fullmatch(KEY, review) and not key:
            session = self._benches[name].reviewed(review)
            return Visit(name, session, "", None) if session else None
        return Visit(name, digest_of(key), key, query.get("view")) if fullmatch(KEY, key) else None

    def address(self, vehicle: str, kind: str, key: str) -> str:
        """Return what an address says of a session or a review."""
        several = {"vehicle": vehicle} if len(self._benches) > 1 else {}
        return urlencode({**several, kind: key})

    def way(self, request: Request, vehicle: str, query: Mapping[str, str]) -> str:
        """Return the way to the last session of a browser, or to a new one if it has or wants one."""
        known = self._keys(request, vehicle)
        wants_new = {"new", "view"} & query.keys()
        key = known[0] if known and not wants_new else secrets.token_urlsafe(16)
        rest = {name: value for name, value in query.items() if name not in ("new", "vehicle")}
        address = self.address(vehicle, "session", key)
        return f"./?{address}{'&' * bool(rest)}{urlencode(rest)}"

    def left(self, request: Request) -> dict[str, list[str]]:
        """Return the keys of the sessions that a browser left, by vehicle."""
        return {vehicle: self._keys(request, vehicle) for vehicle in self._benches}

    def remember(
        self,
        connection: PageConnection,
        request: Request,
        response: Response,
        vehicle: str,
        key: str,
    ) -> None:
        """Has a browser remember the session that it is given the page of."""
        others = [each for each in self._keys(request, vehicle) if each != key]
        keys = ".".join([key, *others][:MOST_LEFT])
        self._front.door.give_cookie(connection, response, self._cookie(vehicle), keys, KEPT)

    def _keys(self, request: Request, vehicle: str) -> list[str]:
        """Return the keys of the sessions of a vehicle that a browser left, the last one first."""
        given = cookies(request).get(self._cookie(vehicle), "").split(".")
        return [key for key in given[:MOST_LEFT] if fullmatch(KEY, key)]

    def _cookie(self, vehicle: str) -> str:
        """Return the name of the cookie that holds the last sessions of a vehicle."""
        number = list(self._benches).index(vehicle)
        return f"modeviz{self._front.get_port()}session{number}"
