"""Matrices in Matrix Market's exchange format, which SciPy, MATLAB and many solvers write.

After R. F. Boisvert, R. Pozo and K. A. Remington, "The Matrix Market Exchange Formats", 1996. SciPy's
own reader is not used: some damaged files make it write beyond its memory.
"""

import warnings
from collections.abc import Iterator
from io import TextIOWrapper
from pathlib import Path
from typing import TextIO

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, cut, located, quoted
from modeviz.files.disk import opened
from modeviz.files.limits import check_size
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.matrices.lines import LONGEST_LINE
from modeviz.formats.named_matrices import MOST_DOFS, MOST_ENTRIES, NamedMatrix, from_entries
from modeviz.vehicle.arrays import Array, Floats

BEGINNING = b"%%MatrixMarket"

SIZES = {"coordinate": 3, "array": 2}
"""Numbers in the line with the size of each kind of matrix."""

SYMMETRIES = ("general", "symmetric")


def read_market(path: Path) -> list[NamedMatrix]:
    """Return the matrix of a file, called as the file is.

    Raises:
        VehicleError: the file is damaged, cut, or has other numbers than it says.
    """
    with opened(path, LARGEST_FILE) as file, located(path):
        lines = TextIOWrapper(file, "latin-1")
        kind, symmetry = _kind(lines)
        n_rows, n_columns, *entries = _size(lines, SIZES[kind])
        check_size("degrees of freedom in a matrix", max(n_rows, n_columns), MOST_DOFS)
        if entries:
            check_size("entries in a matrix", entries[0], MOST_ENTRIES)
            matrix = _sparse(_table(lines, entries[0], 3), (n_rows, n_columns))
        else:
            matrix = _full(lines, n_rows, n_columns, symmetry)
        return [NamedMatrix(path.stem, _mirrored(matrix) if symmetry == "symmetric" else matrix)]


def _kind(lines: TextIO) -> tuple[str, str]:
    """Whether a matrix is written by entries or in full, and whether half of it is."""
    words = lines.readline(LONGEST_LINE).lower().split()[1:]
    if len(words) != 4 or words[0] != "matrix" or words[1] not in SIZES:
        raise VehicleError(f"found a header of {quoted(' '.join(words))}, expected that of a matrix")
    if words[2] not in ("real", "integer", "double") or words[3] not in SYMMETRIES:
        raise VehicleError(
            f"found a {words[3]} matrix of {words[2]} numbers, expected a general or a symmetric one "
            "of real numbers"
        )
    return words[1], words[3]


def _size(lines: TextIO, count: int) -> list[int]:
    """The numbers of the first line that is no comment."""
    line = next(_data(lines), "")
    try:
        sizes = [int(word) for word in line.split()]
    except ValueError:
        sizes = []
    if len(sizes) != count or min(sizes) < 0:
        raise VehicleError(f"found {quoted(line.strip())}, expected {count} whole numbers of its size")
    return sizes


def _data(lines: TextIO) -> Iterator[str]:
    while line := lines.readline(LONGEST_LINE):
        if line.strip() and not line.startswith("%"):
            yield line


def _table(lines: TextIO, n_lines: int, n_columns: int) -> Floats:
    """The numbers of the lines that follow, (n_lines, n_columns)."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of no lines
            table = np.loadtxt(lines, comments="%", ndmin=2, max_rows=n_lines + 1)
    except (ValueError, OverflowError) as error:
        raise VehicleError(f"found no table of numbers ({cut(str(error), 200)})") from None
    if not n_lines and not table.size:
        return np.zeros((0, n_columns))
    if table.shape != (n_lines, n_columns):
        found = "more" if len(table) > n_lines else str(len(table))
        raise VehicleError(
            f"found {found} lines of {table.shape[1]} numbers, expected {n_lines} of {n_columns}: it "
            "is cut or damaged"
        )
    return table


def _sparse(table: Floats, shape: tuple[int, int]) -> sp.csc_array:
    return from_entries(_whole(table[:, 0]) - 1, _whole(table[:, 1]) - 1, table[:, 2], shape)


def _whole(values: Floats) -> Array:
    if not (np.isfinite(values).all() and (values == np.round(values)).all()):
        raise VehicleError("found places in the matrix that are no whole numbers")
    return np.clip(values, -1, 2**53).astype(np.int64)


def _full(lines: TextIO, n_rows: int, n_columns: int, symmetry: str) -> sp.csc_array:
    """A matrix column by column, of which the lower half is written if it is symmetric."""
    half = symmetry == "symmetric"
    if half and n_rows != n_columns:
        raise VehicleError(f"found {n_rows} rows and {n_columns} columns of a symmetric matrix")
    count = n_rows * (n_rows + 1) // 2 if half else n_rows * n_columns
    check_size("entries in a matrix", count, MOST_ENTRIES)
    numbers = _table(lines, count, 1)[:, 0]
    if not half:
        return sp.csc_array(numbers.reshape(n_columns, n_rows).T)
    upper = np.zeros((n_rows, n_rows))
    upper[np.triu_indices(n_rows)] = numbers
    return sp.csc_array(upper.T)


def _mirrored(matrix: sp.csc_array) -> sp.csc_array:
    return sp.csc_array(matrix + sp.tril(matrix, -1).T + sp.triu(matrix, 1).T)
