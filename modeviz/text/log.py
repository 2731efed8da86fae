"""What a running program says of itself: lines for people, objects for machines that collect them.

Everything goes through Python's logger "modeviz"; beside its text a record may have the fields
`event`, `id`, `session` and `client`. Keys and tokens of links are never written.
"""

import json
import logging
import re
import sys
from datetime import UTC, datetime
from typing import TextIO

LOG = logging.getLogger("modeviz")

FIELDS = ("event", "id", "session", "client")
"""Of a record, beside its time, level and text."""

SECRET = re.compile(
    r"(\w*(?:token|session|review|cookie)\d*|modeviz\d+)(['\"]?\s*[=:]\s*['\"]?)[^\s&;'\"]+",
    re.IGNORECASE,
)


class TerminalHandler(logging.StreamHandler[TextIO]):
    """Says on the standard error output, whatever that is at the time, what people should know."""

    def __init__(self) -> None:
        super().__init__(sys.stderr)
        self.setLevel(logging.WARNING)
        self.setFormatter(LineFormatter("modeviz: %(message)s"))

    def emit(self, record: logging.LogRecord) -> None:
        self.stream = sys.stderr
        super().emit(record)


class LineFormatter(logging.Formatter):
    """Text for people, without secrets."""

    def format(self, record: logging.LogRecord) -> str:
        return redacted(super().format(record))


class JsonFormatter(logging.Formatter):
    """One JSON object a line: time (UTC), level, event, text with where it went wrong, and more."""

    def format(self, record: logging.LogRecord) -> str:
        said = {name: vars(record)[name] for name in FIELDS if vars(record).get(name) is not None}
        time = datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds")
        text = redacted(super().format(record))
        content = {
            "time": time,
            "level": record.levelname.lower(),
            "event": "said",
            **said,
            "message": text,
        }
        return json.dumps(content, ensure_ascii=False)


def file_formatter(is_json: bool) -> logging.Formatter:
    """Return how a log file's lines are written: as JSON, or with time and level in front."""
    return JsonFormatter() if is_json else LineFormatter("%(asctime)s %(levelname)s %(message)s")


def redacted(text: str) -> str:
    """Return a text without what links and cookies keep secret: "token=…"."""
    return SECRET.sub(r"\1\2…", text)


def our_mistake(number: str) -> str:
    """Return a sentence for people on a mistake that is logged under a number."""
    return f"This is our mistake: the log has more of it under the number {number}."


def say_on_terminal() -> None:
    """Has the terminal told, unless somebody has said where else what is logged should go."""
    if not LOG.handlers:
        LOG.addHandler(TerminalHandler())
