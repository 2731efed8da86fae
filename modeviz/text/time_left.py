"""Estimates of the time that something still takes, by how fast it went so far."""

import time
from collections.abc import Callable

SURE = 1.0
"""s: before, nobody can tell."""

WORTHWHILE = 2.0
"""s: less is not worth a word."""

MINUTES = 90.0
"""s: from here on in minutes."""


class TimeLeft:
    """The time left of one thing, told from when it was first asked for."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Nothing is known yet.

        Args:
            clock: gives seconds.
        """
        self._clock = clock
        self._first: tuple[float, float] | None = None

    def words(self, done: float) -> str:
        """Words like "12 s left"; none while nobody can tell, or where it is soon over.

        Args:
            done: the fraction that is done.
        """
        now = self._clock()
        begin, before = self._first = self._first or (now, done)
        if done <= before or now - begin < SURE:
            return ""
        seconds = (now - begin) * (1 - done) / (done - before)
        if seconds < WORTHWHILE:
            return ""
        return f"{seconds:.0f} s left" if seconds < MINUTES else f"{seconds / 60:.0f} min left"
