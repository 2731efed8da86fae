"""What OUTPUT4 files in text and in binary have in common: matrices of columns of strings."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.limits import check_size
from modeviz.formats.named_matrices import MOST_DOFS, MOST_ENTRIES, NamedMatrix, from_entries
from modeviz.vehicle.arrays import Array

SHIFT = 16
"""A word of a string without BIGMAT holds its row, and above these bits how many words it has."""

MOST_ROWS = 1 << SHIFT
"""Matrices with so many rows have strings with words of their own, whatever the sign says."""

MOST_MATRICES = 1000


@dataclass(frozen=True)
class Header:
    """What stands before a matrix."""

    n_columns: int
    n_rows: int
    is_wide: bool
    """Whether strings have their length and their row in two words."""
    kind: int
    """1 and 2 of real numbers in single and double precision, 3 and 4 of complex ones."""
    name: str

    @property
    def is_wanted(self) -> bool:
        """Whether it is that of a square matrix of real numbers."""
        return self.n_rows == self.n_columns > 0 and self.kind < 3

    @classmethod
    def of(cls, n_columns: int, n_rows: int, kind: int, name: str) -> "Header":
        """Return the header of numbers as the file has them.

        Raises:
            VehicleError: they are none of a matrix.
        """
        name = name.replace("\0", " ").strip()
        if n_columns < 0 or kind not in (1, 2, 3, 4):
            raise VehicleError(
                f"matrix {quoted(name)}: found {n_columns} columns of numbers of type {kind}, expected "
                "a matrix of type 1 to 4"
            )
        check_size("columns or rows of a matrix", max(n_columns, abs(n_rows)), MOST_DOFS)
        return cls(n_columns, abs(n_rows), n_rows < 0 or n_rows >= MOST_ROWS, kind, name)


class Op4Reader(ABC):
    """A file whose matrices are read one after the other."""

    @abstractmethod
    def header(self) -> Header | None:
        """Return what stands before the next matrix; None at the end of the file."""

    @abstractmethod
    def column(self, header: Header) -> tuple[int, int, int]:
        """Return the number of the next column, its first row or zero, and how many words follow."""

    @abstractmethod
    def string_start(self, header: Header) -> tuple[int, int]:
        """Return how many words a string has, with those before it, and its first row."""

    @abstractmethod
    def values(self, header: Header, n_words: int) -> Array:
        """Return the numbers of that many words, of a string."""

    @abstractmethod
    def full_values(self, header: Header, n_words: int) -> Array:
        """Return those of a full column, which text files count otherwise."""

    @abstractmethod
    def end_column(self) -> None:
        """Goes to what follows a column."""

    @abstractmethod
    def end_matrix(self) -> None:
        """Goes to what follows a matrix, behind a number that stands for a last column."""

    def matrices(self) -> Iterator[NamedMatrix]:
        """Yield the matrices that are square and real, one after the other."""
        for _ in range(MOST_MATRICES):
            header = self.header()
            if header is None:
                return
            with located(f"matrix {header.name}"):
                strings = list(self._strings(header))
                if not header.is_wanted:
                    continue
                yield NamedMatrix(header.name, _assembled(strings, header))
        raise VehicleError(f"found more than {MOST_MATRICES} matrices")

    def _strings(self, header: Header) -> Iterator[tuple[int, int, Array]]:
        """The column, the first row and the numbers of each string of a matrix."""
        before = 0
        while True:
            column, row, n_words = self.column(header)
            if column > header.n_columns:
                self.end_matrix()
                return
            if column <= before:
                raise VehicleError(f"found column {column} after column {before}")
            before = column
            if row > 0:
                yield column, row, self.full_values(header, n_words)
            else:
                yield from self._column_strings(header, column, n_words)
            self.end_column()

    def _column_strings(
        self, header: Header, column: int, n_words: int
    ) -> Iterator[tuple[int, int, Array]]:
        n_before = 2 if header.is_wide else 1
        while n_words > 0:
            length, row = self.string_start(header)
            n_words -= length + n_before - 1
            if length < 2 or n_words < 0:
                raise VehicleError(f"column {column}: found a string of {length - 1} words")
            yield column, row, self.values(header, length - 1)


def _assembled(strings: list[tuple[int, int, Array]], header: Header) -> sp.csc_array:
    counts = np.array([len(values) for _, _, values in strings], np.int64)
    check_size("entries in a matrix", int(counts.sum()), MOST_ENTRIES)
    columns = np.repeat(np.array([column for column, _, _ in strings], np.int64), counts)
    starts = np.repeat(np.array([row for _, row, _ in strings], np.int64), counts)
    within = np.arange(len(columns)) - np.repeat(np.cumsum(counts) - counts, counts)
    values = np.concatenate([np.zeros(0), *(values for _, _, values in strings)])
    shape = (header.n_rows, header.n_columns)
    return from_entries(starts + within - 1, columns - 1, values.astype(float), shape)


def apart(word: int) -> tuple[int, int]:
    """Return the length and the first row of a string that are in one word."""
    return word >> SHIFT, word & (MOST_ROWS - 1)
