"""What the log says of pages that go too far and of our mistakes: each once, and counted."""

import logging
import threading
import traceback
import zlib
from collections import Counter
from pathlib import PurePath

from modeviz.text.log import LOG, say_on_terminal

MOST_LINES = 100
"""Different ones of clients, and of mistakes; what comes after is counted together."""

LONGEST = 4000
"""Characters of one: an error can quote what a page sent."""

OTHERS = "others", "went too far in other ways"
OTHER_MISTAKES = "mistakes", "happened in other places"


class Notices:
    """Says each thing once; `tally` says how often it has happened."""

    def __init__(self, log: logging.Logger | None = None) -> None:
        """Starts with nothing said.

        Args:
            log: takes what is said; if not given, modeviz's own.
        """
        if log is None:
            say_on_terminal()
        self._log = log or LOG
        self._lock = threading.Lock()
        self._counts: Counter[tuple[str, str]] = Counter()
        self._mistakes: Counter[tuple[str, str]] = Counter()

    def note(self, who: str, what: str) -> None:
        """Says that a client did something, in our own words, if that was not said before."""
        if self._is_first(self._counts, (who, what), OTHERS):
            self._say(logging.WARNING, f"{who} {what}", "noticed", client=who)

    def tell(self, what: str, event: str, **fields: str | None) -> None:
        """Says what happens as it should, for those who keep the log; `fields` as of `text.log`."""
        self._say(logging.INFO, what, event, **fields)

    def mistake(self, error: BaseException, session: str | None = None) -> str:
        """Says where we went wrong, once for each place; returns the number it is said under.

        Args:
            error: what was raised.
            session: in which, by a name that opens nothing.
        """
        number = mistake_number(error)
        if self._is_first(self._mistakes, (f"mistake {number}", "happened"), OTHER_MISTAKES):
            text = "".join(traceback.format_exception(error)).rstrip()
            if len(text) > LONGEST:
                text = f"{text[: LONGEST // 2]}\n…\n{text[-LONGEST // 2 :]}"
            self._say(logging.ERROR, f"mistake {number}\n{text}", "mistake", id=number, session=session)
        return number

    def tally(self) -> None:
        """Says how often each thing has happened, if more than once, and starts anew."""
        with self._lock:
            counts = self._counts + self._mistakes
            self._counts.clear()
            self._mistakes.clear()
        for (who, what), count in counts.items():
            if count > 1:
                self._say(logging.WARNING, f"{who} {what}: {count} times in all", "tally")

    def _is_first(
        self, counts: Counter[tuple[str, str]], key: tuple[str, str], others: tuple[str, str]
    ) -> bool:
        with self._lock:
            if key not in counts and len(counts) >= MOST_LINES:
                key = others
            counts[key] += 1
            return counts[key] == 1

    def _say(self, level: int, text: str, event: str, **fields: str | None) -> None:
        self._log.log(level, "%s", text, extra={"event": event, **fields})


def mistake_number(error: BaseException) -> str:
    """Return six digits for the place where something went wrong, in every run the same."""
    frames = traceback.extract_tb(error.__traceback__)
    places = dict.fromkeys(f"{PurePath(f.filename).name}:{f.name}:{f.lineno}" for f in frames)
    return f"{zlib.crc32(' '.join([*places, type(error).__name__]).encode()):08x}"[-6:]
