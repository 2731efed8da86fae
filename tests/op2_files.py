"""OP2 files written word by word after their specification."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

MODES, COMPLEX_MODES = 2, 9


@dataclass(frozen=True)
class Op2:
    """How words are written."""

    order: str = "<"
    size: int = 4
    most: int = 10_000
    """Words between two keys, so that long records are in several parts."""

    def words(self, *values: float | int | str) -> bytes:
        """Whole numbers, real ones, and names of which four letters make a word."""
        parts = []
        for value in values:
            if isinstance(value, str):
                raw = value.encode()
                parts += [raw[i : i + 4].ljust(self.size) for i in range(0, len(raw), 4)]
            else:
                kind = "i" if isinstance(value, int | np.integer) else "f"
                parts.append(np.array(value, f"{self.order}{kind}{self.size}").tobytes())
        return b"".join(parts)

    def fortran(self, content: bytes) -> bytes:
        count = np.array(len(content), f"{self.order}i4").tobytes()
        return count + content + count

    def key(self, number: int) -> bytes:
        return self.fortran(self.words(number))

    def record(self, content: bytes) -> bytes:
        step = self.most * self.size
        parts = [content[i : i + step] for i in range(0, len(content), step)]
        return b"".join(self.key(len(part) // self.size) + self.fortran(part) for part in parts)

    def table(self, name: str, *records: bytes) -> bytes:
        head = [self.words(name.ljust(8)), self.words(101, *[0] * 6)]
        text = b"".join(self.record(one) + self.key(-i) for i, one in enumerate(head, 1))
        every = [self.words(name.ljust(8)), *records]
        for number, one in enumerate(every, 3):
            text += self.record(self.words(0)) + self.record(one) + self.key(-number)
        return text + self.record(self.words(0)) + self.key(0)

    def file(self, *tables: bytes, label: str = "XXXXXXXX") -> bytes:
        head = self.key(3) + self.fortran(self.words(11, 29, 26))
        head += self.key(7) + self.fortran(self.words("NASTRAN FORT TAPE ID CODE - "))
        head += self.key(2) + self.fortran(self.words(label)) + self.key(-1) + self.key(0)
        return head + b"".join(tables) + self.key(0)

    def grids(self, rows: Sequence[tuple]) -> bytes:
        """Of id, CP, three coordinates and CD."""
        return self.words(4501, 45, 1) + b"".join(
            self.words(i, cp, *map(float, place), cd, 0, 0) for i, cp, place, cd in rows
        )

    def grids_in_double_precision(self, rows: Sequence[tuple]) -> bytes:
        text = self.words(4501, 45, 1120001)
        for i, cp, place, cd in rows:
            doubles = np.array(place, f"{self.order}f8").tobytes()
            text += self.words(i, cp) + doubles + self.words(cd, 0, 0)
        return text

    def frame(self, kind: str, number: int, points, reference: int = 0) -> bytes:
        key, code = {"R": ((2101, 21, 8), 1), "C": ((2001, 20, 9), 2), "S": ((2201, 22, 10), 3)}[kind]
        return self.words(*key, number, code, 2, reference, *map(float, np.ravel(points)))

    def frame_in_double_precision(self, number: int, points) -> bytes:
        doubles = np.array(points, f"{self.order}f8").tobytes()
        return self.words(2101, 21, 2220008, number, 1, 2, 0) + doubles

    def header(
        self, analysis: int, mode: int, eigenvalue: complex, subcase=1, width=8, hertz=0.0, sort=0
    ):
        second = eigenvalue.imag if analysis == COMPLEX_MODES else hertz
        words = [10 * analysis + 2, 1000 * sort + 7, 0, subcase, mode, eigenvalue.real, second, 0, 1]
        return self.words(*words, width, *[0] * 136)

    def shape(self, ids, motions, kinds=None) -> bytes:
        kinds = [1] * len(ids) if kinds is None else kinds
        return b"".join(
            self.words(10 * int(i) + 2, kind, *map(float, row))
            for i, kind, row in zip(ids, kinds, motions, strict=True)
        )

    def eigenvalues(self, *rows: tuple[int, float, float, float], residual_flag=0) -> list[bytes]:
        """Records of LAMA, of mode, eigenvalue, what is called hertz, and generalised mass."""
        values = b"".join(
            self.words(mode, mode, w2, float(np.sqrt(abs(w2))), hertz, mass, mass * w2)
            for mode, w2, hertz, mass in rows
        )
        return [self.words(21, 6, *[0] * 7, 7, residual_flag, *[0] * 39, *[0] * 96), values]
