"""Nastran's OUTPUT4 files, DMIG cards and external superelements, after its manuals."""

import struct
from collections.abc import Mapping

import numpy as np


def strings(column):
    """First rows and values of the non-zeros of a column that stand together."""
    filled = np.flatnonzero(column)
    for together in np.split(filled, np.flatnonzero(np.diff(filled) > 1) + 1):
        if len(together):
            yield int(together[0]) + 1, column[together]


def op4_binary(
    matrices: Mapping[str, np.ndarray], form="full", order="<", word=4, single=False
) -> bytes:
    """Fortran records of words with 4 or 8 bytes; the form is full, strings or wide (BIGMAT)."""
    integer, real = ("i", "q")[word == 8], "f" if single and word == 4 else "d"
    width = struct.calcsize(real) // word or 1
    content = b""

    def record(payload):
        marker = struct.pack(order + "i", len(payload))
        return marker + payload + marker

    def whole(*numbers):
        return struct.pack(f"{order}{len(numbers)}{integer}", *numbers)

    def reals(values):
        return struct.pack(f"{order}{len(values)}{real}", *values)

    for name, A in matrices.items():
        n_rows, n_columns = A.shape
        rows = -n_rows if form == "wide" else n_rows
        header = whole(n_columns, rows, 6, 1 if single else 2)
        content += record(header + name.ljust(2 * word).encode())
        for number, column in enumerate(A.T, start=1):
            filled = np.flatnonzero(column)
            if not len(filled):
                continue
            if form == "full":
                values = column[filled[0] : filled[-1] + 1]
                content += record(whole(number, filled[0] + 1, len(values) * width) + reals(values))
                continue
            body, n_words = b"", 0
            for row, values in strings(column):
                length = len(values) * width + 1
                mark = whole(length, row) if form == "wide" else whole(row + 65536 * length)
                body += mark + reals(values)
                n_words += length + (form == "wide")
            content += record(whole(number, 0, n_words) + body)
        content += record(whole(n_columns + 1, 1, width) + reals([1.0]))
    return content


def op4_text(matrices: Mapping[str, np.ndarray], form="full", single=False, letter="E") -> bytes:
    """Lines of three numbers with 16 digits; words count twice in strings of double precision."""
    width = 1 if single else 2
    lines = []

    def write(values):
        numbers = [f"{value:23.16E}".replace("E", letter) for value in values]
        lines.extend("".join(numbers[i : i + 3]) for i in range(0, len(numbers), 3))

    for name, A in matrices.items():
        n_rows, n_columns = A.shape
        rows = -n_rows if form == "wide" else n_rows
        kind = 1 if single else 2
        lines.append(f"{n_columns:8d}{rows:8d}{6:8d}{kind:8d}{name:8s}1P,3{letter}23.16")
        for number, column in enumerate(A.T, start=1):
            filled = np.flatnonzero(column)
            if not len(filled):
                continue
            if form == "full":
                values = column[filled[0] : filled[-1] + 1]
                lines.append(f"{number:8d}{filled[0] + 1:8d}{len(values):8d}")
                write(values)
                continue
            found = [(row, len(values) * width + 1, values) for row, values in strings(column)]
            n_words = sum(length + (form == "wide") for _, length, _ in found)
            lines.append(f"{number:8d}{0:8d}{n_words:8d}")
            for row, length, values in found:
                lines.append(
                    f"{length:8d}{row:8d}" if form == "wide" else f"{row + 65536 * length:12d}"
                )
                write(values)
        lines.append(f"{n_columns + 1:8d}{1:8d}{1:8d}")
        write([1.0])
    return "\n".join([*lines, ""]).encode()


def dmig(name: str, A: np.ndarray, labels: np.ndarray, form=6) -> str:
    """Cards of a matrix in large fields, as Nastran punches them: of a symmetric one the lower half."""
    lines = [f"{'DMIG':8s}{name:8s}{0:8d}{form:8d}{2:8d}{0:8d}"]
    for j, (grid, direction) in enumerate(labels):
        rows = np.flatnonzero(A[:, j])
        rows = rows[rows >= j] if form == 6 else rows
        if len(rows):
            lines.append(f"{'DMIG*':8s}{name:16s}{grid:16d}{direction:16d}")
        for i in rows:
            value = f"{A[i, j]:.9E}".replace("E", "D")
            lines.append(f"{'*':8s}{labels[i][0]:16d}{labels[i][1]:16d}{value:>16s}")
    return "\n".join([*lines, ""])
