"""Writes that are in memory until a study file has them."""

from collections import Counter
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass
from sqlite3 import Connection
from typing import Any

Write = Callable[[Connection], object]

Rework = Callable[[Sequence[Any]], Sequence[tuple[Hashable, Write]]]

LARGEST = 64_000_000
"""Bytes of large things that wait while nothing can be written: the oldest is lost for one more."""


@dataclass(frozen=True, eq=False)
class Waiting:
    """A write that is in memory."""

    write: Write
    owner: str
    """Whose it is."""
    what: str = ""
    """What something large is called, such as "picture"; "" for what is never lost."""
    n_bytes: int = 0
    """That it takes in memory."""


class Queue:
    """Writes in their order, for one thread at a time.

    Those that are being written are in it until that is done, and stay as they are.
    """

    def __init__(self) -> None:
        """Has none."""
        self._waiting: dict[Hashable, Waiting] = {}
        self._taken: Mapping[Hashable, Waiting] = {}
        self._n_put = 0
        self.lost: Counter[str] = Counter()
        """How many large things were lost, by what they are called."""

    def __len__(self) -> int:
        return len(self._waiting)

    @property
    def is_done(self) -> bool:
        """Whether none waits, and none is being written."""
        return not (self._waiting or self._taken)

    def holds(self, owner: str) -> bool:
        """Whether something of an owner is in memory alone."""
        return any(each.owner == owner for each in self._waiting.values())

    def put(self, waiting: Waiting, key: Hashable = None) -> None:
        """Adds a write at the end, in place of one of its key, if it has one."""
        name = self._name(key)
        self._waiting.pop(name, None)
        self._waiting[name] = waiting

    def take(self, most: int) -> Sequence[Write]:
        """Return the first writes, which are being written from now on."""
        self._taken = dict(list(self._waiting.items())[:most])
        return [each.write for each in self._taken.values()]

    def settle(self, are_written: bool) -> None:
        """Forgets those that were taken if they are written; else they wait again."""
        for name, each in self._taken.items():
            if are_written and self._waiting.get(name) is each:
                del self._waiting[name]
        self._taken = {}

    def rework(self, owner: str, kind: type, rework: Rework) -> None:
        """Puts others in the place of an owner's writes of a class, where the first of them was.

        Args:
            owner: whose.
            kind: of writes.
            rework: makes writes of these, the first one first, that come to the same, with their keys.
        """
        found = {
            name: each.write
            for name, each in self._waiting.items()
            if each.owner == owner and isinstance(each.write, kind) and name not in self._taken
        }
        if not found:
            return
        first = next(iter(found))
        waiting: dict[Hashable, Waiting] = {}
        for name, each in self._waiting.items():
            if name == first:
                for key, write in rework(tuple(found.values())):
                    new = self._name(key)
                    waiting.pop(new, None)
                    waiting[new] = Waiting(write, owner)
            elif name not in found:
                waiting[name] = each
        self._waiting = waiting

    def lose_oldest(self) -> None:
        """Forgets the oldest large things while there are too many, but for the newest."""
        large = [(name, each) for name, each in self._waiting.items() if each.what]
        n_bytes = sum(each.n_bytes for _, each in large)
        for name, each in large[:-1]:
            if n_bytes > LARGEST and name not in self._taken:
                del self._waiting[name]
                n_bytes -= each.n_bytes
                self.lost[each.what] += 1

    def _name(self, key: Hashable) -> Hashable:
        self._n_put += 1
        return ("alone", self._n_put) if key is None else key
