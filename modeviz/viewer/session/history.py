"""What was before, and what was undone."""

import time
from collections.abc import Hashable
from typing import Generic, TypeVar

Value = TypeVar("Value")

MERGE_WITHIN = 1.0
"""s: changes of one kind that follow so closely, such as a drag, are undone together."""

LONGEST = 500


class History(Generic[Value]):
    """The values that something had, the newest of them the present one."""

    def __init__(self, value: Value) -> None:
        """Starts with a value that cannot be undone."""
        self._past: list[Value] = []
        self._future: list[Value] = []
        self.value: Value = value
        self._kind: Hashable = None
        self._changed_at = 0.0

    def put(self, value: Value, kind: Hashable = None, within: float = MERGE_WITHIN) -> None:
        """Goes on to a value; what was undone is gone.

        Args:
            value: the new one.
            kind: what was changed, if many such changes are to be one; None if not.
            within: s, how closely they have to follow.
        """
        if value == self.value:
            return
        now = time.monotonic()
        is_more_of_the_same = (
            kind is not None and kind == self._kind and now - self._changed_at < within
        )
        if not is_more_of_the_same or not self._past:
            self._past = [*self._past[1 - LONGEST :], self.value]
        self._future.clear()
        self.value, self._kind, self._changed_at = value, kind, now
        if self._past[-1] == value:  # all the way back is no step
            self._past.pop()
            self._kind = None

    @property
    def can_undo(self) -> bool:
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        return bool(self._future)

    def undo(self) -> bool:
        """Goes back; whether there was anything to go back to."""
        if not self._past:
            return False
        self._future.append(self.value)
        self.value, self._kind = self._past.pop(), None
        return True

    def redo(self) -> bool:
        """Goes forward again; whether there was anything undone."""
        if not self._future:
            return False
        self._past.append(self.value)
        self.value, self._kind = self._future.pop(), None
        return True
