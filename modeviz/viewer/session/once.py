"""What is computed once for all who ask, as long as that does not take long."""

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Thing = TypeVar("Thing")

WAITS = 1.0
"""s for which others wait while somebody computes the same."""


class Once(Generic[Thing]):
    """Keeps a thing that whoever asks first computes; any thread may ask.

    Nobody waits longer than `WAITS` for somebody else, who may hang: then each computes it alone, and
    that is not kept. As long as that goes on nobody else waits at all. What fails is not kept either.
    """

    def __init__(self) -> None:
        """Nothing is known yet."""
        self._known: Thing | None = None
        self._lock = threading.Lock()
        self._is_late = False
        """Whether somebody has waited in vain for who computes it now."""

    @property
    def known(self) -> Thing | None:
        """What is kept, if anything is by now."""
        return self._known

    def get(self, compute: Callable[[], Thing]) -> Thing:
        """Return what is kept, or what `compute` gives; raises as that."""
        if self._known is not None:
            return self._known
        if not self._lock.acquire(timeout=0.0 if self._is_late else WAITS):
            self._is_late = True
            return compute()
        try:
            if self._known is None:
                self._known = compute()
            return self._known
        finally:
            self._is_late = False
            self._lock.release()
