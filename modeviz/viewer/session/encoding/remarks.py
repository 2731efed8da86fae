"""What of a state does not fit a vehicle: put right and told, once each."""

from collections.abc import Collection, Iterable
from typing import TypeVar

from modeviz.errors import ModevizError, quoted, unknown

Name = TypeVar("Name", bound=str)


class Remarks:
    """Collects sentences, without their stops, on what was not taken over as it was."""

    def __init__(self) -> None:
        """Nothing is said yet."""
        self._said: dict[str, None] = {}

    @property
    def sentences(self) -> tuple[str, ...]:
        """All that was said, in its order."""
        return tuple(self._said)

    def say(self, sentence: str | ModevizError) -> None:
        """Takes a sentence, unless it was said."""
        self._said[str(sentence)] = None

    def one(self, kind: str, name: str, known: Collection[str], usual: str) -> str:
        """Return a name if it is known, else the usual one.

        Args:
            kind: of what has the name, "mount group".
            name: that is asked for.
            known: those there are.
            usual: what is taken otherwise.
        """
        if name in known:
            return name
        self.say(unknown(kind, name, known))
        return usual

    def some(self, kind: str, names: Iterable[str], known: Collection[str]) -> list[str]:
        """Return those of some names that are known."""
        return [name for name in names if self.one(kind, name, known, usual="")]

    def within(self, what: str, value: float, low: float, high: float) -> float:
        """Return a number if it is within limits, else the nearer one."""
        if low <= value <= high:
            return value
        self.say(f"{what}: found {value:g}, expected {low:g} to {high:g}")
        return min(max(value, low), high)

    def few(self, what: str, found: Collection[object], most: int) -> bool:
        """Return whether there is not too much of something."""
        if len(found) > most:
            self.say(f"found {len(found):,} {what}, expected at most {most:,}")
        return len(found) <= most

    def short(self, what: str, name: str, longest: int) -> bool:
        """Return whether a name is there and not too long."""
        if 0 < len(name) <= longest:
            return True
        self.say(f"{what} {quoted(name)}: found {len(name)} letters, expected 1 to {longest}")
        return False
