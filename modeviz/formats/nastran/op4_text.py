"""OUTPUT4 files in text."""

import re
from itertools import pairwise

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.formats.nastran.op4_columns import Header, Op4Reader, apart
from modeviz.vehicle.arrays import Array

FORMAT = re.compile(r"\s*(?:1P,?)?\s*(\d+)\s*[ED](\d+)\.\d+", re.IGNORECASE)
"""How many numbers a line has, and how many letters each: 1P,3E23.16."""

USUAL_FORMAT = "5E16.9"


class TextReader(Op4Reader):
    """Lines of whole numbers in fields of 8 letters, and of reals in those of a format."""

    def __init__(self, content: bytes) -> None:
        self.lines: list[str] = content.decode("latin-1").splitlines()
        self.place: int = 0
        self.per_line: int = 5
        self.width: int = 16

    def header(self) -> Header | None:
        while self.place < len(self.lines) and not self.lines[self.place].strip():
            self.place += 1
        if self.place == len(self.lines):
            return None
        line = self._line()
        wide = 16 if line.rstrip().endswith("|I16") else 8
        ends = np.cumsum([0, wide, wide, 8, 8, 8])
        n_columns, n_rows, _, kind = (self._whole(line[a:b]) for a, b in pairwise(ends[:5]))
        found = FORMAT.match(line[ends[5] :].strip() or USUAL_FORMAT)
        if not found:
            raise VehicleError(
                f"line {self.place}: found {quoted(line)}, expected a format such as 1P,3E23.16"
            )
        self.per_line, self.width = max(1, int(found[1])), max(1, int(found[2]))
        return Header.of(n_columns, n_rows, kind, line[ends[4] : ends[5]])

    def column(self, header: Header) -> tuple[int, int, int]:
        column, row, n_words = self._wholes(3)
        return column, row, n_words

    def string_start(self, header: Header) -> tuple[int, int]:
        if header.is_wide:
            length, row = self._wholes(2)
            return length, row
        return apart(self._whole(self._line()))

    def values(self, header: Header, n_words: int) -> Array:
        return self._numbers(n_words if header.kind % 2 else n_words // 2)

    def full_values(self, header: Header, n_words: int) -> Array:
        return self._numbers(n_words)

    def _numbers(self, count: int) -> Array:
        if count < 0:
            raise VehicleError(f"line {self.place}: found {count} numbers to come")
        lines = [self._line() for _ in range(min(-(-count // self.per_line), len(self.lines)))]
        text = "".join(line[: self.per_line * self.width] for line in lines)[: count * self.width]
        try:
            if len(text) < (count - 1) * self.width:
                raise ValueError(f"{len(text)} letters of {count} numbers")
            content = text.upper().replace("D", "E").ljust(count * self.width).encode()
            return np.frombuffer(content, f"S{self.width}").astype(float)
        except ValueError as error:
            raise VehicleError(f"line {self.place}: found no numbers ({error})") from None

    def end_column(self) -> None:
        pass

    def end_matrix(self) -> None:
        self._line()

    def _line(self) -> str:
        if self.place >= len(self.lines):
            raise VehicleError("the file is cut: it ends within a matrix")
        self.place += 1
        return self.lines[self.place - 1]

    def _wholes(self, number: int) -> tuple[int, ...]:
        line = self._line()
        return tuple(self._whole(line[8 * i : 8 * i + 8]) for i in range(number))

    def _whole(self, text: str) -> int:
        try:
            return int(text)
        except ValueError:
            raise VehicleError(
                f"line {self.place}: found {quoted(text)}, expected a whole number"
            ) from None
