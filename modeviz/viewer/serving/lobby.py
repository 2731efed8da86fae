"""The way in to a server of several vehicles: the start page, its pictures, and who may see which."""

import io
import time
from collections.abc import Mapping, Sequence
from threading import Lock
from urllib.parse import urlencode
from weakref import ref

from PIL import Image, ImageOps
from websockets import Headers
from websockets.http11 import Request, Response

from modeviz.errors import ModevizError
from modeviz.journal.keys import digest_of
from modeviz.journal.sessions import SessionId, SessionLine
from modeviz.text.wording import ago
from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.doors.door import Door
from modeviz.viewer.pictures.still import still, still_at_rest
from modeviz.viewer.serving.addresses import Place
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.open_sessions import OpenSessions
from modeviz.viewer.serving.start_page import Left, Shown, start_page
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.design import variant_name

SIZE = 640, 400
"""Pixels of a picture."""

MOST_KEPT = 200
"""Pictures of sessions that are kept in memory."""

Keys = Mapping[str, Sequence[str]]
"""The keys of the sessions that a browser left, by vehicle, the last one first."""


class Lobby:
    """Shows a browser the vehicles, and the sessions that it left itself: nobody else's."""

    def __init__(
        self,
        door: Door,
        benches: Mapping[str, Bench],
        dark: bool,
        sessions: OpenSessions,
    ) -> None:
        """Draws nothing yet.

        Args:
            door: says where the page may be framed.
            benches: the vehicles, by what addresses call them.
            dark: whether the page is.
            sessions: those in memory, whose answers go before pictures.
        """
        self._door, self._benches, self._dark, self._open = door, benches, dark, sessions
        self._lock = Lock()
        self._vehicles: dict[str, bytes] = {}
        self._sessions: dict[Place, tuple[ref[Solved], bytes]] = {}
        """The answers that were drawn, which are large and go with their sessions, and the pictures."""

    def page(self, request: Request, keys: Keys) -> Response:
        """Return the start page for a browser that has left sessions."""
        shown = [self._shown(name, keys.get(name, ())) for name in self._benches]
        body = start_page(shown, self._dark).encode()
        ancestors = self._door.policy(request).partition(";")[0]
        headers = {
            "Content-Type": "text/html; charset=utf-8",
            "Content-Length": str(len(body)),
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "Content-Security-Policy": f"default-src 'none'; style-src 'unsafe-inline'; "
            f"img-src 'self' data:; base-uri 'none'; form-action 'none'; {ancestors}",
        }
        return Response(200, "OK", Headers(headers), body)

    def picture(self, query: Mapping[str, str], keys: Keys) -> Response:
        """Return the picture of a vehicle, or of one of the sessions that this browser left of it.

        Args:
            query: of the address: the `vehicle`, and which `left` session, 0 the last one.
            keys: of this browser.
        """
        name = query.get("vehicle", "")
        if name not in self._benches:
            return answer(404, "there is no such vehicle here")
        left = dict(enumerate(keys.get(name, ())))
        key = left.get(int(query["left"])) if query.get("left", "").isdecimal() else None
        png = self._of_session(name, digest_of(key)) if key else None
        png = png or self._of_vehicle(name)
        headers = {
            "Content-Type": "image/png",
            "Content-Length": str(len(png)),
            "Cache-Control": "no-store" if key else "private, max-age=600",
        }
        return Response(200, "OK", Headers(headers), png)

    def _shown(self, name: str, keys: Sequence[str]) -> Shown:
        bench, vehicle = self._benches[name], {"vehicle": name}
        lines = _lines(bench)
        known = [self._left(name, i, key, lines) for i, key in enumerate(keys)]
        return Shown(
            name=bench.vehicle.name,
            about=_about(bench),
            address=f"./?{urlencode(vehicle)}",
            new=f"./?{urlencode(vehicle)}&new",
            picture=f"./picture?{urlencode(vehicle)}",
            left=[left for left in known if left],
        )

    def _left(
        self, name: str, number: int, key: str, lines: Mapping[SessionId, SessionLine]
    ) -> Left | None:
        """Return a session that a browser left, if anybody still knows it."""
        session = digest_of(key)
        opened, line = self._open.get((name, session)), lines.get(session)
        if opened is None and line is None:
            return None
        title = line.title if line else ""
        if opened is not None:
            title = title or variant_name(self._benches[name].vehicle, opened.app.session.state.design)
        if line is not None:
            title = title or next(reversed(line.variants), f"Session {line.number}")
        return Left(
            title=title,
            about=_when(line) if line else "open",
            address=f"./?{urlencode({'vehicle': name, 'session': key})}",
            picture=f"./picture?{urlencode({'vehicle': name, 'left': number})}",
        )

    def _of_vehicle(self, name: str) -> bytes:
        with self._lock:
            if name not in self._vehicles:
                with self._open.precedence.step():
                    image = still_at_rest(self._benches[name].vehicle, self._dark, *SIZE)
                    self._vehicles[name] = _png(image)
            return self._vehicles[name]

    def _of_session(self, name: str, session: SessionId) -> bytes | None:
        """Return what moves in a session that is open, or else its newest picture, if any."""
        opened = self._open.get((name, session))
        solved = opened and opened.app.session.answer
        if solved is None:
            return self._kept_picture(self._benches[name], session)
        with self._lock:
            last = self._sessions.pop((name, session), None)
            kept = last if last and last[0]() is solved else (ref(solved), self._drawn(solved))
            self._sessions[name, session] = kept
            if len(self._sessions) > MOST_KEPT:
                self._sessions.pop(next(iter(self._sessions)))
            return kept[1]

    def _drawn(self, solved: Solved) -> bytes:
        with self._open.precedence.step():
            return _png(still(solved, self._dark, *SIZE))

    def _kept_picture(self, bench: Bench, session: SessionId) -> bytes | None:
        try:
            lines = bench.study.pictures(session) if bench.study else ()
            png = bench.study.picture(session, lines[-1].token) if bench.study and lines else None
        except ModevizError:
            return None
        if png is None:
            return None
        with Image.open(io.BytesIO(png)) as image:
            return _png(ImageOps.fit(image.convert("RGB"), SIZE))


def _about(bench: Bench) -> str:
    """Return what a vehicle has, in a line."""
    vehicle = bench.vehicle
    counts = (
        (len(vehicle.bodies), "body", "bodies"),
        (len(vehicle.mount_groups), "mount group", "mount groups"),
        (len(vehicle.roads), "road", "roads"),
    )
    said = [f"{n} {one if n == 1 else many}" for n, one, many in counts if n]
    return " · ".join([*said, "ready" if bench.is_prepared else "made ready when it is opened"])


def _when(line: SessionLine) -> str:
    """Return how much was done in a session, and when last: "2 changes, 5 min ago"."""
    n = line.n_changes
    changes = f"{n} change{'s' * (n != 1)}, " if n else ""
    return f"{changes}{ago(time.time() - line.used)}"


def _lines(bench: Bench) -> dict[SessionId, SessionLine]:
    """Return the sessions that a study remembers; none if it cannot be read."""
    try:
        return {line.id: line for line in bench.study.sessions()} if bench.study else {}
    except ModevizError:
        return {}


def _png(image: Image.Image) -> bytes:
    file = io.BytesIO()
    image.save(file, "PNG", optimize=True)
    return file.getvalue()
