"""What was decided before, and what was undone."""

import time
from collections.abc import Hashable
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TypeVar

from modeviz.viewer.session.state import State

Value = TypeVar("Value")

MERGE_WITHIN = 1.0
"""s: changes of one step that follow so closely, such as a drag, are undone together."""

LONGEST = 500


@dataclass(frozen=True)
class Change:
    """A state before and after something was decided."""

    before: State
    after: State


class History:
    """The newest state, and the changes of its design that led there.

    How one looks at a design is not gone back over, but for what was changed by deciding.
    """

    def __init__(self, state: State) -> None:
        """Starts with a state that cannot be undone."""
        self._past: list[Change] = []
        self._future: list[Change] = []
        self.state: State = state
        self._step: Hashable = None
        self._changed_at = 0.0

    def put(self, state: State, step: Hashable = None, within: float = MERGE_WITHIN) -> None:
        """Goes on to a state; if it has another design, what was undone is gone.

        Args:
            state: the new one.
            step: what the change is a part of, if many are to be undone as one; None if not.
            within: s, how closely they have to follow.
        """
        before, self.state = self.state, state
        if state.design == before.design:
            self._look(before, state)
            return
        now = time.monotonic()
        goes_on = step is not None and step == self._step and now - self._changed_at < within
        first = self._past.pop().before if goes_on and self._past else before
        self._past = [*self._past[1 - LONGEST :], Change(first, state)]
        self._future.clear()
        self._step, self._changed_at = step, now
        if first.design == state.design:  # all the way back is no step
            self._past.pop()
            self._step = None

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
        change = self._past.pop()
        self._future.append(change)
        self._go(change.after, change.before)
        return True

    def redo(self) -> bool:
        """Goes forward again; whether there was anything undone."""
        if not self._future:
            return False
        change = self._future.pop()
        self._past.append(change)
        self._go(change.before, change.after)
        return True

    def _go(self, old: State, new: State) -> None:
        self.state, self._step = merged(self.state, old, new), None

    def _look(self, old: State, new: State) -> None:
        """Takes a look into the last change, which may go on: it is no part of it."""
        if self._past:
            last = self._past[-1]
            self._past[-1] = Change(merged(last.before, old, new), merged(last.after, old, new))


def merged(value: Value, old: Value, new: Value) -> Value:
    """Return a value with what differs between an old and a new one, where it is still the old."""
    if old == new:
        return value
    if value == old:
        return new
    if not is_dataclass(value) or isinstance(value, type):
        return value
    names = [field.name for field in fields(value)]
    parts = {n: merged(getattr(value, n), getattr(old, n), getattr(new, n)) for n in names}
    return replace(value, **parts)
