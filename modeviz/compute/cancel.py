"""Tokens by which somebody else holds, ends or follows a long computation."""

import threading
import time


class CancelledError(Exception):
    """A computation was told to end."""


class CancelToken:
    """A switch for a computation in another thread, which asks `check` often."""

    def __init__(self) -> None:
        """Lets it run."""
        self._may_run = threading.Event()
        self._may_run.set()
        self._is_cancelled = False
        self._asked = time.monotonic()

    @property
    def silence(self) -> float:
        """The time since it was last asked, s; none while the computation is held."""
        return time.monotonic() - self._asked if self._may_run.is_set() else 0.0

    @property
    def is_cancelled(self) -> bool:
        return self._is_cancelled

    def pause(self) -> None:
        """Holds it at its next check."""
        self._may_run.clear()

    def resume(self) -> None:
        """Lets it go on."""
        self._let_run()

    def cancel(self) -> None:
        """Ends it at its next check, also while it is held."""
        self._is_cancelled = True
        self._let_run()

    def check(self) -> None:
        """Waits while it is held.

        Raises:
            CancelledError: it is to end.
        """
        self._may_run.wait()
        self._asked = time.monotonic()
        if self._is_cancelled:
            raise CancelledError

    def _let_run(self) -> None:
        self._asked = time.monotonic()
        self._may_run.set()
