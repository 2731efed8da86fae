"""Which work goes first where many share the processors: answers that somebody waits for."""

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

LONGEST = 1.0
"""s for which what is at work, answers or a step, keeps the next step waiting."""

LOOKS_EVERY = 0.1
"""s between two looks whether a step that waits is still wanted."""


@dataclass(eq=False)
class _Place:
    """A step's place in the queue."""

    turn: threading.Condition
    until: float = math.inf
    """The first one waits at most until then, or keeps the next one waiting."""
    is_at_work: bool = False


class Precedence:
    """Lets background work go on step by step: one at a time, and while nobody waits for an answer.

    Steps have their turns in the order in which they ask. The first in the queue waits for answers at
    most `LONGEST`, and one that takes longer than that, which may hang, keeps no other waiting: with n
    before it a step goes on after 2 n + 1 times that, and as many looks, at the latest. An answer that
    takes longer counts no more, either. Who is alone never waits.
    """

    def __init__(self, longest: float = LONGEST) -> None:
        """Nobody is at work.

        Args:
            longest: s in place of `LONGEST`.
        """
        self._longest = longest
        self._lock = threading.Lock()
        self._answering: dict[object, float] = {}
        """Until when each answer that is being made counts."""
        self._queue: deque[_Place] = deque()

    @property
    def is_contended(self) -> bool:
        """Whether more than one waits for an answer."""
        with self._lock:
            now = time.monotonic()
            return sum(until > now for until in self._answering.values()) > 1

    @contextmanager
    def answer(self) -> Iterator[None]:
        """While somebody waits for what is done within."""
        with self._lock:
            self._answering[mine := object()] = time.monotonic() + self._longest
        try:
            yield
        finally:
            with self._lock:
                del self._answering[mine]
                self._call_next()

    @contextmanager
    def step(self, is_wanted: Callable[[], bool] = lambda: True) -> Iterator[bool]:
        """Waits for one's turn to do a step of background work within; gives whether it has come.

        Args:
            is_wanted: asked now and then; once it is not, there is no more waiting and no turn. What it
                raises ends the waiting too, and holds nobody up.
        """
        mine = _Place(threading.Condition(self._lock))
        try:
            yield self._has_come(mine, is_wanted)
        finally:
            with self._lock:
                if mine in self._queue:
                    self._queue.remove(mine)
                self._call_next()

    def _has_come(self, mine: _Place, is_wanted: Callable[[], bool]) -> bool:
        """Queues until one may go; whether that is still wanted then."""
        with self._lock:
            self._queue.append(mine)
            while (wanted := is_wanted()) and not self._may_go(mine):
                mine.turn.wait(min(LOOKS_EVERY, self._longest))
            mine.is_at_work, mine.until = wanted, time.monotonic() + self._longest
            return wanted

    def _may_go(self, place: _Place) -> bool:
        now = time.monotonic()
        if self._queue[0].is_at_work and now > self._queue[0].until:
            self._queue.popleft()
        if self._queue[0] is not place:
            return False
        place.until = min(place.until, now + self._longest)
        return now >= place.until or all(until <= now for until in self._answering.values())

    def _call_next(self) -> None:
        if self._queue:
            self._queue[0].turn.notify()
