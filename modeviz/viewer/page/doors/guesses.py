"""How often somebody may guess at a token."""

import threading
import time
from collections import OrderedDict
from collections.abc import Callable

FREE_GUESSES = 3
"""Answered at once: a link can be copied wrongly."""

DELAY = 1.0
"""s: how long each guess after these takes."""

MOST_GUESSES = 10
"""In a row, before whoever guesses is locked out."""

LOCKED_S = 300.0

MOST_CLIENTS = 1000
"""Whose guesses are remembered."""


class Guesses:
    """Counts the wrong tokens of each client, for as many threads as ask."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Starts with nobody having guessed; `clock` tells the time, s."""
        self._clock = clock
        self._lock = threading.Lock()
        self._wrong: OrderedDict[str, tuple[int, float]] = OrderedDict()
        """How many in a row, and until when that locks out."""

    def note(self, client: str) -> float:
        """Counts a wrong one, locks out who brought too many; gives how long the answer takes, s."""
        with self._lock:
            n_before = self._wrong.pop(client, (0, 0.0))[0]
            is_locked = n_before + 1 >= MOST_GUESSES
            self._wrong[client] = (0, self._clock() + LOCKED_S) if is_locked else (n_before + 1, 0.0)
            if len(self._wrong) > MOST_CLIENTS:
                self._wrong.popitem(last=False)
        return DELAY if n_before >= FREE_GUESSES else 0.0

    def forget(self, client: str) -> None:
        """Starts anew with who brought the right one."""
        with self._lock:
            self._wrong.pop(client, None)

    def locked(self, client: str) -> float:
        """Return the time for which a client is still locked out, s; 0 if it is not."""
        with self._lock:
            until = self._wrong.get(client, (0, 0.0))[1]
        return max(until - self._clock(), 0.0)
