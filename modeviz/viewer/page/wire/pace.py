"""How much a page may say: messages and bytes a second, and files that it was asked for or told of."""

import time

from modeviz.viewer.page.wire.limits import Allowance

MESSAGES_PER_S, MOST_MESSAGES = 100.0, 300.0
"""A page sends at most 20 a second for a widget and 50 for its camera."""

BYTES_PER_S, MOST_BYTES = 1e6, 8e6

LONGEST_HURRY = 20.0
"""s that a page may say more than it is heard."""


class HurryError(Exception):
    """A page says more than it may; what it did follows "This page"."""


class Pace:
    """What one page has said of late."""

    def __init__(self) -> None:
        """It has said nothing yet."""
        self.is_asked: bool = False
        """Whether it was asked for something that may be large."""
        self._messages = Allowance(MESSAGES_PER_S, MOST_MESSAGES)
        self._bytes = Allowance(BYTES_PER_S, MOST_BYTES)
        self._n_expected = 0
        """Bytes of files that may come beyond the fair number."""
        self._hurried_since: float | None = None

    def expect(self, n_bytes: int) -> None:
        """Lets it say so much more: a file of which it told, and which is taken."""
        self._n_expected += n_bytes

    def take(self, n_bytes: int) -> float:
        """Counts a message; returns how long it waits until it may be heard, s.

        Raises:
            HurryError: it is too much at once, or for too long.
        """
        self._take_bytes(n_bytes)
        wait = self._messages.take()
        if self._messages.is_plenty:
            self._hurried_since = None
        elif self._hurried_since is None:
            self._hurried_since = time.monotonic()
        elif wait and time.monotonic() - self._hurried_since > LONGEST_HURRY:
            raise HurryError(f"sent more than {MESSAGES_PER_S:.0f} messages a second")
        return wait

    def _take_bytes(self, n_bytes: int) -> None:
        expected = min(n_bytes, self._n_expected)
        self._n_expected -= expected
        if not self.is_asked and self._bytes.take(n_bytes - expected):
            raise HurryError(f"sent more than {MOST_BYTES / 1e6:.0f} MB at once")
