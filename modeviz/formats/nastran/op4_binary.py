"""OUTPUT4 files in binary."""

from typing import Literal

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.nastran.op4_columns import Header, Op4Reader, apart
from modeviz.vehicle.arrays import Array


class BinaryReader(Op4Reader):
    """Fortran records, big or little-endian, of words with 4 or 8 bytes."""

    def __init__(self, content: bytes) -> None:
        self.content = content
        self.place: int = 0
        self.end: int = 0
        self.endian: Literal["little", "big"] = "big" if content[:1] == b"\0" else "little"
        self.word: int = {24: 4, 48: 8}.get(int.from_bytes(content[:4], self.endian), 0)
        if not self.word:
            raise VehicleError("is no OUTPUT4 file: begins with neither such text nor such a record")
        self.order: str = {"little": "<", "big": ">"}[self.endian]

    def header(self) -> Header | None:
        if self.place == len(self.content):
            return None
        self._begin_record()
        numbers = self._words(4)
        name = self._take(2 * self.word).decode("latin-1")
        self.end_column()
        return Header.of(int(numbers[0]), int(numbers[1]), int(numbers[3]), name)

    def column(self, header: Header) -> tuple[int, int, int]:
        self._begin_record()
        column, row, n_words = self._words(3).tolist()
        return column, row, n_words

    def string_start(self, header: Header) -> tuple[int, int]:
        if header.is_wide:
            length, row = self._words(2).tolist()
            return length, row
        return apart(int(self._words(1)[0]))

    def values(self, header: Header, n_words: int) -> Array:
        width = 8 if header.kind in (2, 4) else self.word
        content = self._take(n_words * self.word)
        return np.frombuffer(content[: len(content) // width * width], f"{self.order}f{width}")

    def full_values(self, header: Header, n_words: int) -> Array:
        return self.values(header, n_words)

    def end_column(self) -> None:
        self.place = self.end + 4

    def end_matrix(self) -> None:
        self.end_column()

    def _begin_record(self) -> None:
        length = int.from_bytes(self.content[self.place : self.place + 4], self.endian)
        self.place += 4
        self.end = self.place + length
        if self.end + 4 > len(self.content):
            raise VehicleError("the file is cut: its last record ends beyond it")
        if self.content[self.place - 4 : self.place] != self.content[self.end : self.end + 4]:
            raise VehicleError("a record has other lengths at its ends: the file is damaged")

    def _words(self, number: int) -> Array:
        return np.frombuffer(self._take(number * self.word), f"{self.order}i{self.word}")

    def _take(self, n_bytes: int) -> bytes:
        if not 0 <= n_bytes <= self.end - self.place:
            raise VehicleError("a record is shorter than it says")
        self.place += n_bytes
        return self.content[self.place - n_bytes : self.place]
