"""How a server is, for probes: good or not, and a few counts that tell nothing of anybody."""

import json
from dataclasses import asdict, dataclass
from http import HTTPStatus
from importlib.metadata import version

from websockets.http11 import Response

from modeviz.viewer.page.doors.answers import answer


@dataclass(frozen=True)
class Health:
    """The counts of a server."""

    vehicles: int
    prepared: int
    """Vehicles that are ready."""
    sessions: int
    """In memory."""
    pages: int
    stuck: int
    """Sessions that do not go on: as many of their solves hang as may be left behind."""
    unsaved: int
    """Studies that cannot be written now."""
    is_stopping: bool = False

    @property
    def status(self) -> str:
        """The state in a word: "ok", or what is wrong, "stopping", "stuck" or "unsaved"."""
        if self.is_stopping:
            return "stopping"
        if self.stuck:
            return "stuck"
        return "unsaved" if self.unsaved else "ok"

    def response(self) -> Response:
        """Return the answer to a probe: 200 if all is well, else 503."""
        is_good = self.status == "ok"
        counts = {name: value for name, value in asdict(self).items() if name != "is_stopping"}
        text = json.dumps({"status": self.status, "version": version("modeviz"), **counts})
        code = HTTPStatus.OK if is_good else HTTPStatus.SERVICE_UNAVAILABLE
        return answer(code, text, **{"Content-Type": "application/json", "Cache-Control": "no-store"})
