"""What was decided before, and what was undone."""

import time
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from itertools import takewhile
from typing import Literal, Protocol, TypeVar

from modeviz.journal.changes import LONGEST
from modeviz.viewer.session.author import OWNER, Author
from modeviz.viewer.session.design import Design
from modeviz.viewer.session.state import State

Value = TypeVar("Value")

MERGE_WITHIN = 1.0
"""s: changes of one step that follow so closely, such as a drag, are undone together."""


class Step(Protocol):
    """A state before and after something was decided."""

    @property
    def before(self) -> State: ...

    @property
    def after(self) -> State: ...

    @property
    def author(self) -> Author: ...


@dataclass(frozen=True)
class Change:
    """A step whose states are at hand."""

    before: State
    after: State
    author: Author = OWNER


Kind = Literal["step", "longer", "back", "undo", "redo", "look"]
"""A "step" can be undone; a "longer" one is the last step that goes on, as while dragging; one that
leads "back" to where that began leaves no step. A "look" decides nothing."""


@dataclass(frozen=True)
class Accepted:
    """What became of the newest state."""

    kind: Kind
    change: Step
    """The states around the step that it is, or is part of; of a look those before and after it."""

    @property
    def state(self) -> State:
        """The newest one."""
        return self.change.before if self.kind in ("undo", "back") else self.change.after


@dataclass(frozen=True)
class Moment:
    """A state with what led there and what was undone: where `History` can be put back to."""

    state: State
    past: tuple[Step, ...]
    future: tuple[Step, ...]
    step: Hashable
    """What the last change was a part of."""
    changed_at: float


class History:
    """The newest state, and the changes of its design that led there.

    How one looks at a design is not gone back over, but for what was changed by deciding and was not
    changed again since.
    """

    def __init__(
        self,
        state: State,
        settled: Callable[[Design, State], State] = lambda _, state: state,
        past: Sequence[Step] = (),
        future: Sequence[Step] = (),
    ) -> None:
        """Starts with a state.

        Args:
            state: the first one.
            settled: makes looks fit the design of a state that was gone to, given the design before.
            past: what can be undone, the next one last.
            future: what can be redone, the next one last.
        """
        self._settled = settled
        self._past: list[Step] = [*past]
        self._future: list[Step] = [*future]
        self.state: State = state
        self._step: Hashable = None
        self._changed_at = 0.0

    def put(
        self,
        state: State,
        step: Hashable = None,
        within: float = MERGE_WITHIN,
        author: Author = OWNER,
    ) -> Accepted:
        """Goes on to a state; if it has another design, what was undone is gone.

        Args:
            state: the new one.
            step: what the change is a part of, if many are to be undone as one; None if not.
            within: s, how closely they have to follow.
            author: who changes it; one step is of one author.
        """
        before, self.state = self.state, state
        if state.design == before.design:
            return Accepted("look", Change(before, state, author))
        now = time.monotonic()
        goes_on = step is not None and step == self._step and now - self._changed_at < within
        first, kind = before, "step"
        if goes_on and self._past and self._past[-1].author == author:
            change = self._past.pop()  # looks since then are no part of it
            first, kind = merged(change.before, change.after, before), "longer"
        self._past = [*self._past[1 - LONGEST :], Change(first, state, author)]
        self._future.clear()
        self._step, self._changed_at = step, now
        if first.design == state.design:  # all the way back is no step
            self._past.pop()
            self._step = None
            return Accepted("back", Change(state, before, author))
        return Accepted(kind, self._past[-1])

    @property
    def moment(self) -> Moment:
        """The present one."""
        return Moment(self.state, tuple(self._past), tuple(self._future), self._step, self._changed_at)

    def put_back(self, moment: Moment) -> tuple[Accepted, ...]:
        """Goes to a moment before, as if nothing had happened since.

        Returns:
            What leads there for those who follow the changes one by one, with all that can be undone
            and redone then.
        """
        n_kept = _n_same(self._past, moment.past)
        gone, again = self._past[n_kept:], moment.past[n_kept:]
        told = (
            *(Accepted("back", change) for change in reversed(gone)),
            *(Accepted("step", change) for change in again),
        )
        n_undone = len(moment.future)
        is_same = len(self._future) == n_undone == _n_same(self._future, moment.future)
        if not is_same or (again and n_undone):
            told = (*self._without_future(), *told, *_undone(moment.future))
        told = (*told, Accepted("look", Change(self.state, moment.state)))
        self.state, self._past, self._future = moment.state, [*moment.past], [*moment.future]
        self._step, self._changed_at = moment.step, moment.changed_at
        return told

    @property
    def can_undo(self) -> bool:
        return bool(self._past)

    @property
    def can_redo(self) -> bool:
        return bool(self._future)

    @property
    def undone_next(self) -> Step | None:
        """What `undo` takes back."""
        return self._past[-1] if self._past else None

    @property
    def redone_next(self) -> Step | None:
        """What `redo` makes again."""
        return self._future[-1] if self._future else None

    def undo(self) -> Accepted | None:
        """Goes back; None if there was nothing to go back to.

        Raises:
            ModevizError: what was there before cannot be read.
        """
        if not self._past:
            return None
        change, after = self._past[-1], self.state
        self._go(change.after, change.before)
        self._past.pop()
        self._future.append(Change(self.state, after, change.author))
        return Accepted("undo", self._future[-1])

    def redo(self) -> Accepted | None:
        """Goes forward again; None if nothing was undone.

        Raises:
            ModevizError: what was undone cannot be read.
        """
        if not self._future:
            return None
        change, before = self._future[-1], self.state
        self._go(change.before, change.after)
        self._future.pop()
        self._past.append(Change(before, self.state, change.author))
        return Accepted("redo", self._past[-1])

    def _without_future(self) -> tuple[Accepted, ...]:
        """A step that leads nowhere and is taken back: after it nothing can be redone."""
        nowhere = Change(self.state, self.state)
        return Accepted("step", nowhere), Accepted("back", nowhere)

    def _go(self, old: State, new: State) -> None:
        self.state, self._step = self._settled(self.state.design, merged(self.state, old, new)), None


def _undone(future: Sequence[Step]) -> tuple[Accepted, ...]:
    """Steps that are made and undone again, so that they can be redone, the last one first."""
    return (
        *(Accepted("step", change) for change in reversed(future)),
        *(Accepted("undo", change) for change in future),
    )


def _n_same(some: Sequence[Step], others: Sequence[Step]) -> int:
    """With how many of the same steps two rows of them begin."""
    pairs = zip(some, others, strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] is pair[1], pairs))


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
