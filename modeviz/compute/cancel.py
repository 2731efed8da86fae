"""Tokens by which somebody else holds, ends or follows a long computation."""

import threading


class CancelledError(Exception):
    """A computation was told to end."""


class CancelToken:
    """A switch for a computation in another thread, which asks `check` often."""

    def __init__(self) -> None:
        """Lets it run."""
        self._may_run = threading.Event()
        self._may_run.set()
        self._is_cancelled = False

    @property
    def is_cancelled(self) -> bool:
        return self._is_cancelled

    def pause(self) -> None:
        """Holds it at its next check."""
        self._may_run.clear()

    def resume(self) -> None:
        """Lets it go on."""
        self._may_run.set()

    def cancel(self) -> None:
        """Ends it at its next check, also while it is held."""
        self._is_cancelled = True
        self._may_run.set()

    def check(self) -> None:
        """Waits while it is held.

        Raises:
            CancelledError: it is to end.
        """
        self._may_run.wait()
        if self._is_cancelled:
            raise CancelledError
