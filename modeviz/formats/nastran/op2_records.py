"""The tables of an OP2 file as records of words, wherever their bytes are.

A file is a chain of Fortran records, each between two counts of its bytes. One of a single word is a
key: above zero it says how many words the next one has, which belong to a table's record; below zero it
ends that record, and zero ends the table. After MSC Nastran's OUTPUT2, as PARAM,POST,-1 writes it; big
and little-endian, with words of four and of eight bytes.
"""

import mmap
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.disk import opened
from modeviz.formats.limits import LARGEST_FILE
from modeviz.vehicle.arrays import Array

Span = tuple[int, int]
"""Of bytes in the file: where they begin, and how many."""


@dataclass(frozen=True, eq=False)
class Table:
    """A table of the file."""

    name: str
    records: list[list[Span]]
    """What each of its records is put together of; the first is the table's own header."""
    words: "Words"

    def whole(self, number: int) -> Array:
        """Return a record as whole numbers."""
        return self.words.read(self.records[number], "i")

    def real(self, number: int) -> Array:
        """Return a record as real numbers."""
        return self.words.read(self.records[number], "f")


@dataclass(frozen=True, eq=False)
class Words:
    """The words of a file."""

    content: memoryview
    order: str
    """Of their bytes: "<" or ">"."""
    size: int
    """4 or 8 bytes."""
    label: str = ""
    """Who wrote the file, if it says so."""

    def read(self, spans: list[Span], kind: str) -> Array:
        """Return the words of a record, of kind "i" or "f"."""
        dtype = np.dtype(f"{self.order}{kind}{self.size}")
        parts = [
            np.frombuffer(self.content, dtype, n_bytes // self.size, start) for start, n_bytes in spans
        ]
        return parts[0] if len(parts) == 1 else np.concatenate([np.zeros(0, dtype), *parts])

    def letters(self, text: str) -> bytes:
        """Return the bytes of words that have a text, four letters each."""
        raw = text.encode()
        return b"".join(raw[i : i + 4].ljust(self.size) for i in range(0, len(raw), 4))


def read_tables(path: Path) -> list[Table]:
    """Return the tables of an OP2 file; their words are read when they are asked for.

    Raises:
        VehicleError: it is no OP2 file, damaged, or cut.
    """
    with opened(path, LARGEST_FILE) as file:
        try:
            content = memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
        except ValueError:
            raise VehicleError(f"{path}: the file is empty") from None
    chain = _Chain(_words(content, path), path)
    return list(_tables(chain, replace(chain.words, label=_label(chain))))


def _words(content: memoryview, path: Path) -> Words:
    """How a file's words are written, as its first count says: that of a key."""
    for order in "<>":
        for size in (4, 8):
            ends = [_count(content, order, at) for at in (0, 4 + size)]
            if len(content) >= 8 + size and ends == [size, size]:
                return Words(content, order, size)
    raise VehicleError(
        f"{path}: does not begin as an OP2 file; is it one, of binary form, and was it copied as such?"
    )


def _count(content: memoryview, order: str, at: int) -> int:
    return int.from_bytes(content[at : at + 4], "little" if order == "<" else "big", signed=True)


@dataclass(eq=False)
class _Chain:
    """The file's Fortran records, one after the other."""

    words: Words
    path: Path
    at: int = 0
    """The byte at which the next begins."""
    table: str = ""
    """That it is in."""

    @property
    def is_at_end(self) -> bool:
        return self.at == len(self.words.content)

    def next(self) -> Span:
        """Return the next record's bytes.

        Raises:
            VehicleError: it is cut or damaged.
        """
        content, order = self.words.content, self.words.order
        start = self.at + 4
        if start + 4 > len(content):
            raise VehicleError(f"{self.path}: {self._cut()}")
        n_bytes = _count(content, order, self.at)
        end = start + n_bytes
        if n_bytes < 0 or n_bytes % self.words.size:
            raise VehicleError(f"{self.path}: {self._damaged()}")
        if end + 4 > len(content):
            raise VehicleError(f"{self.path}: {self._cut()}")
        if _count(content, order, end) != n_bytes:
            raise VehicleError(f"{self.path}: {self._damaged()}")
        self.at = end + 4
        return start, n_bytes

    def key(self) -> int:
        """Return the next record, which is a key."""
        before = self.at
        span = self.next()
        if span[1] != self.words.size:
            self.at = before
            raise VehicleError(f"{self.path}: {self._damaged()}")
        return int(self.words.read([span], "i")[0])

    def chunk(self, n_words: int, is_matrix: bool = False) -> Span:
        """Return the bytes of so many words, of a column of a matrix those of a number for each."""
        before = self.at
        span = self.next()
        if span[1] != n_words * self.words.size and not is_matrix:
            self.at = before
            raise VehicleError(f"{self.path}: {self._damaged()}")
        return span

    def _cut(self) -> str:
        return f"the file ends {self._within()}, at byte {len(self.words.content):,}: it is cut"

    def _damaged(self) -> str:
        return f"the file is damaged {self._within()}, at byte {self.at:,}"

    def _within(self) -> str:
        return f"within the table {quoted(self.table)}" if self.table else "between two tables"


def _tables(chain: _Chain, words: Words) -> Iterator[Table]:
    while not chain.is_at_end:
        chain.table = ""
        key = chain.key()
        if key == 0:  # the end of the file, or of what one step of the solver wrote
            continue
        if key < 0:
            raise VehicleError(f"{chain.path}: {chain._damaged()}")
        start, n_bytes = chain.chunk(key)
        chain.table = _text(words, start, n_bytes)
        yield Table(chain.table, list(_records(chain)), words)


def _label(chain: _Chain) -> str:
    """The label that a file may begin with, after a date; goes over both."""
    before = chain.at
    if chain.key() != 3:
        chain.at = before
        return ""
    chain.chunk(3)
    label = ""
    while (key := chain.key()) > 0:
        label = _text(chain.words, *chain.chunk(key))
    while chain.key() != 0:
        pass
    return label


def _records(chain: _Chain) -> Iterator[list[Span]]:
    """Yield the records of a table that has begun; those of a matrix are gone over.

    After the name and the trailer each begins with a word, zero for a table and above it for a column.
    """
    number, is_matrix = 0, False
    spans: list[Span] = []
    while (key := chain.key()) != 0:
        if key > 0:
            spans.append(chain.chunk(key, is_matrix))
            if number >= 2 and len(spans) == 1:
                is_matrix = chain.words.read(spans, "i")[0] > 0
            continue
        if number >= 2 and not is_matrix:
            yield spans[1:]
        number += 1
        spans, is_matrix = [], False


def _text(words: Words, start: int, n_bytes: int) -> str:
    """A name of letters, four to a word; some files have eight in words of eight bytes."""
    raw = bytes(words.content[start : start + n_bytes])
    text = raw.replace(b"\0", b" ").decode("latin-1")
    return "".join(text[i : i + words.size].rstrip() for i in range(0, len(text), words.size)).strip()
