"""The folder that a vehicle is read from, and what there is to say about it."""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Self, TypeVar

from modeviz.files.disk import inside
from modeviz.files.limits import check_size, most_allowed
from modeviz.files.schema.conventions import Conventions
from modeviz.vehicle.bodies import Body

LARGEST_ARRAYS = 256_000_000
"""Bytes of the modes of all bodies, which take some times as much while they are read."""

MOST_LINES = 300_000
"""Of the spectra of all loads together."""

MOST_NOTES = 20
"""Nobody reads more."""


T = TypeVar("T")


@dataclass(frozen=True)
class Source:
    """A vehicle folder that is being read."""

    folder: Path
    conventions: Conventions = field(default_factory=Conventions)
    """Of the files in it."""
    stand_ins: tuple[Body, ...] = ()
    """Bodies beside those of the folder, for those that cannot be read."""
    _reserved: list[int] = field(default_factory=list)
    """Bytes of each file of modes."""
    _lines: list[int] = field(default_factory=list)
    """Of each load's spectrum."""
    _known: dict[Hashable, Any] = field(default_factory=dict)
    """What was read, by file and kind."""
    _notes: list[str] = field(default_factory=list)
    """Grows while the folder is read."""

    @property
    def notes(self) -> tuple[str, ...]:
        """The notes made so far, see `Vehicle.notes`; of very many the first `MOST_NOTES`."""
        more = len(self._notes) - MOST_NOTES
        rest = (f"{more} more notes of this kind",) if more > 0 else ()
        return (*self._notes[:MOST_NOTES], *rest)

    @property
    def every_note(self) -> tuple[str, ...]:
        """All notes made so far, however many."""
        return tuple(self._notes)

    def path(self, name: str) -> Path:
        """The path of a file of the folder.

        Raises:
            VehicleError: the name leads out of the folder.
        """
        return inside(self.folder, name)

    def reserve(self, n_bytes: int) -> None:
        """Counts the bytes of an array file before it is unpacked.

        Raises:
            VehicleError: with those before it they are too many.
        """
        self._reserved.append(n_bytes)
        check_size("bytes of modes", sum(self._reserved), LARGEST_ARRAYS)

    def once(self, what: Hashable, read: Callable[[], T]) -> T:
        """The content of a file, which is read once however often it is named.

        Args:
            what: file and kind of content.
            read: gives the content.
        """
        if what not in self._known:
            self._known[what] = read()
        return self._known[what]

    def count_lines(self, n_lines: int) -> bool:
        """Counts the lines of a load's spectrum; whether it and those before it pass `check_lines`."""
        self._lines.append(n_lines)
        return sum(self._lines) <= most_allowed(MOST_LINES)

    def check_lines(self) -> None:
        """Checks the lines of all loads together.

        Raises:
            VehicleError: they are too many.
        """
        check_size(f"lines in the spectra of {len(self._lines):,} loads", sum(self._lines), MOST_LINES)

    def note(self, sentence: str) -> None:
        """Notes what was taken otherwise than it stands, or is likely wrong, with what it is about."""
        if sentence not in self._notes:
            self._notes.append(sentence)

    def again(self, stand_ins: tuple[Body, ...] = ()) -> Self:
        """The same folder to be read once more: what is known of it stays, lines count from zero."""
        return replace(self, stand_ins=stand_ins, _lines=[])
