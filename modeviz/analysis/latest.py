"""What was computed last, for who asks for the same again."""

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

V = TypeVar("V")


class Latest(Generic[V]):
    """The value for the key that was asked for last; any thread may ask."""

    def __init__(self) -> None:
        self._kept: tuple[Hashable, V] | None = None

    def get(self, key: Hashable, compute: Callable[[], V]) -> V:
        """The value for a key, computed if the last one was another; by two threads perhaps twice."""
        kept = self._kept
        if kept is None or kept[0] != key:
            self._kept = kept = key, compute()
        return kept[1]
