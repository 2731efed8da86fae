"""The data sets of a universal file, and the numbers of their lines."""

import re
import warnings
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.formats.component import check_range
from modeviz.vehicle.arrays import Floats

DELIMITER = re.compile(rb"^ *-1[ \t\r]*$", re.MULTILINE)
"""Before and after each data set."""

BINARY_END = re.compile(rb"[ \t\r\n]*-1[ \t\r]*$", re.MULTILINE)
"""The same after bytes that need not end a line."""

MOST_BINARY_LINES = 100
"""Of text before the bytes of a binary data set; there are eleven."""

GLUED = re.compile(rb"(?<=[0-9.])(?=[-+][0-9.])")
"""Between numbers that fill their columns."""


@dataclass(frozen=True)
class Block:
    """A data set."""

    kind: str
    """Its number, such as "2411"; with a letter behind it for binary ones."""
    line: int
    """Where in the file its content begins, from 1."""
    content: bytes
    """All lines after that of its number."""

    def split(self, n_lines: int) -> tuple[list[str], bytes]:
        """Return the first lines as text, and what follows them.

        Raises:
            VehicleError: there are fewer.
        """
        *first, rest = self.content.split(b"\n", n_lines) if self.content else [b""]
        if len(first) < n_lines:
            raise VehicleError(f"found {len(first)} lines, expected at least {n_lines}")
        return [line.decode("latin-1").rstrip() for line in first], rest

    @property
    def where(self) -> str:
        """What to call it in a sentence."""
        return f"data set {self.kind} at line {self.line}"


def blocks(content: bytes) -> Iterator[Block]:
    """Yield the data sets of a file.

    Raises:
        VehicleError: it is no universal file, or is cut within a data set.
    """
    mark = DELIMITER.search(content)
    if not mark:
        raise VehicleError("found no data set, each of which a universal file has between lines of -1")
    line, last = 1, 0
    while mark:
        begin = mark.end() + 1
        first, _, _ = content[begin : begin + 81].partition(b"\n")
        line += content.count(b"\n", last, begin)
        last = begin
        end = _end(content, begin, first)
        if end is None:
            if first.strip():
                raise VehicleError(
                    f"the file ends within data set {quoted(first.decode('latin-1').strip()[:6])}, "
                    f"which begins at line {line}: expected a line of -1 after it; the file is cut"
                )
            return
        inside = content[begin : end.start()]
        yield Block(_kind(first, line), line + 1, inside.partition(b"\n")[2])
        mark = DELIMITER.search(content, end.end())


def _end(content: bytes, begin: int, first: bytes) -> re.Match[bytes] | None:
    """The line of -1 after a data set; a binary one's first line says how many bytes it has."""
    words = first.split()
    if not (words and words[0].endswith(b"b")):
        return DELIMITER.search(content, begin)
    n_lines, n_bytes = (int(word) if word.isdigit() else 0 for word in [*words, *[b""] * 4][3:5])
    for _ in range(min(n_lines, MOST_BINARY_LINES) + 1):
        begin = content.find(b"\n", begin) + 1 or len(content)
    return BINARY_END.match(content, min(begin + n_bytes, len(content)))


def _kind(line: bytes, number: int) -> str:
    words = line.decode("latin-1").split()
    if not words or not re.fullmatch(r"\d+b?", words[0]):
        raise VehicleError(
            f"line {number}: found {quoted(' '.join(words))}, expected the number of a data set"
        )
    return words[0]


def whole_numbers(line: str, least: int) -> list[int]:
    """Return the whole numbers of a line.

    Raises:
        VehicleError: there are fewer than `least`, or other things.
    """
    try:
        numbers = [int(word) for word in line.split()]
    except ValueError:
        raise VehicleError(f"found {quoted(line.strip())}, expected whole numbers") from None
    if len(numbers) < least:
        raise VehicleError(f"found {quoted(line.strip())}, expected {least} whole numbers")
    return numbers


def numbers(text: bytes | str) -> Floats:
    """Return all numbers of some lines, (n,); exponents may be written with E or D.

    Raises:
        VehicleError: something there is no number.
    """
    plain = text.encode("latin-1") if isinstance(text, str) else text
    plain = GLUED.sub(b" ", plain.replace(b"D", b"E").replace(b"d", b"e"))
    if not plain.strip():
        return np.zeros(0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return np.fromstring(plain.decode("latin-1"), sep=" ")
        except (DeprecationWarning, ValueError):
            odd = next((word for word in plain.split() if not _is_number(word)), b"")
            raise VehicleError(f"found {quoted(odd.decode('latin-1'))}, expected a number") from None


def table(text: bytes, n_columns: int, what: str) -> Floats:
    """Return the numbers of some lines as rows of so many, (n, n_columns).

    Args:
        text: the lines; where they end does not matter.
        n_columns: of each row.
        what: a row is, in the singular.

    Raises:
        VehicleError: the last row is not whole, or something is no number.
    """
    found = numbers(text)
    if len(found) % n_columns:
        raise VehicleError(
            f"found {len(found)} numbers, expected {n_columns} for each {what}; is the file cut?"
        )
    rows = found.reshape(-1, n_columns)
    check_range(f"the numbers of a {what}", rows)
    return rows


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def ids(column: Floats, what: str) -> np.ndarray:
    """Return a column of numbers that name things, as whole numbers.

    Raises:
        VehicleError: one is not whole, or not of a size that a file can have.
    """
    whole = np.rint(column)
    wrong = (whole != column) | (np.abs(column) > 2**53)
    if wrong.any():
        raise VehicleError(f"found {column[wrong][0]:g}, expected the number of a {what}")
    return whole.astype(np.int64)
