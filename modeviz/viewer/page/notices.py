"""What the terminal says of pages that go too far: a line for each kind and client, and counted."""

import sys
import threading
import traceback
from collections import Counter
from collections.abc import Callable

MOST_LINES = 100
"""Different ones; what comes after is counted together."""

LONGEST = 4000
"""Characters of one: an error can quote what a page sent."""

OTHERS = "others", "went too far in other ways"


class Notices:
    """Says each thing once; `tally` says how often it has happened."""

    def __init__(self, write: Callable[[str], None] | None = None) -> None:
        """Starts with nothing said.

        Args:
            write: takes a text that ends in no newline; to the standard error output, if not given.
        """
        self._write = write or _to_terminal
        self._lock = threading.Lock()
        self._counts: Counter[tuple[str, str]] = Counter()

    def note(self, who: str, what: str) -> None:
        """Says that a client did something, in our own words, if that was not said before."""
        if self._is_first((who, what)):
            self._write(f"modeviz: {who} {what}")

    def mistake(self, error: BaseException) -> None:
        """Says where we went wrong, once for each place."""
        frames = traceback.extract_tb(error.__traceback__)
        place = f"{frames[-1].filename}:{frames[-1].lineno}" if frames else "nowhere"
        if self._is_first((place, type(error).__name__)):
            text = "".join(traceback.format_exception(error)).rstrip()
            self._write(
                text if len(text) <= LONGEST else f"{text[: LONGEST // 2]}\n…\n{text[-LONGEST // 2 :]}"
            )

    def tally(self) -> None:
        """Says how often each thing has happened, if more than once, and starts anew."""
        with self._lock:
            counts, self._counts = self._counts, Counter()
        for (who, what), count in counts.items():
            if count > 1:
                self._write(f"modeviz: {who} {what}: {count} times in all")

    def _is_first(self, key: tuple[str, str]) -> bool:
        with self._lock:
            if key not in self._counts and len(self._counts) >= MOST_LINES:
                key = OTHERS
            self._counts[key] += 1
            return self._counts[key] == 1


def _to_terminal(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
