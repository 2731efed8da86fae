"""Who has looked at a session, known again by what a browser remembers."""

from collections import OrderedDict
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

from modeviz.journal.keys import digest_of
from modeviz.text.wording import free_name
from modeviz.viewer.session.author import OWNER, Author

MOST = 500
"""Visitors who are remembered: who was longest away is forgotten first."""


@dataclass(frozen=True)
class Visitor:
    """Somebody who looks at a session in one browser, in any number of its tabs."""

    number: int
    """Its own in the session, while that is open."""
    name: str
    is_owner: bool
    id: str = ""
    """See `Author.id`."""

    @property
    def author(self) -> Author:
        """As who makes changes."""
        return Author(self.name, OWNER.id if self.is_owner else self.id)


class Acquaintances:
    """Visitors by their keys, for one thread at a time; no two who are there have the same name."""

    def __init__(self) -> None:
        """Knows nobody."""
        self._known: OrderedDict[str, Visitor] = OrderedDict()
        self._n_met = 0

    def get(self, key: str) -> Visitor | None:
        """Return the visitor of a key, if that is known."""
        return self._known.get(key)

    def meet(self, key: str, name: str, is_owner: bool, there: Sequence[Visitor]) -> None:
        """Knows somebody from now on, or again, by the name of before.

        Args:
            key: of the visitor.
            name: that a newcomer would like; "" for none.
            is_owner: whether the session is the visitor's own.
            there: who else is there.
        """
        visitor = self._known.get(key)
        if visitor is None:
            self._n_met += 1
            visitor = Visitor(self._n_met, name, is_owner, digest_of(key))
        self._name(key, visitor, visitor.name, there)
        self._known.move_to_end(key)

    def rename(self, key: str, name: str, there: Sequence[Visitor]) -> Visitor | None:
        """Gives somebody who is known another name, or one like it that is free; "" gives none."""
        visitor = self._known.get(key)
        return visitor and self._name(key, visitor, name, there)

    def forget(self, kept: Collection[str]) -> None:
        """Forgets who was longest away, while there are too many; the keys that are kept stay."""
        away = [key for key in self._known if key not in kept]
        for key in away[: max(len(self._known) - MOST, 0)]:
            del self._known[key]

    def _name(self, key: str, visitor: Visitor, name: str, there: Sequence[Visitor]) -> Visitor:
        taken = {each.name for each in there if each.number != visitor.number}
        usual = OWNER.name if visitor.is_owner else f"Guest {visitor.number}"
        named = replace(visitor, name=free_name(name or usual, taken))
        self._known[key] = named
        return named
