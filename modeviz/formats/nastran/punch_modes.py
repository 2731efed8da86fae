"""Modes of a punch file (.pch), as DISPLACEMENT(PUNCH) or VECTOR(PUNCH) writes them.

After MSC Nastran's Quick Reference Guide and files that it wrote: lines of headings begin with "$";
below them each point has lines of three numbers, 18 columns each; the last eight columns count lines.
"""

import re
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import read_bytes
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.nastran.op2_modes import MAGNITUDE_AND_PHASE, complex_motions
from modeviz.formats.nastran.shapes import Shape, Shapes, assembled
from modeviz.vehicle.arrays import Array

PUNCH = ".pch"

MODES = b"$EIGENVECTOR"
"""The heading of a table of modes."""

BY_POINT = b"$POINT ID"
"""The heading of what one point does."""

HEADINGS = re.compile(rb"(?:^\$.*(?:\n|\Z))+", re.MULTILINE)
NUMBER = rb"([-+.\dE]+)"
EIGENVALUE = re.compile(
    rb"^\$EIGENVALUE = *\(? *%b(?:, *%b)?.*MODE = *(\d{1,9})" % (NUMBER, NUMBER), re.M
)
SUBCASE = re.compile(rb"^\$SUBCASE ID = *(\d{1,9})", re.MULTILINE)

FIRST, WIDTH = 18, 18
"""Columns of the first number of a line, and of each."""


def has_punched_modes(path: Path) -> bool:
    """Return whether a path is that of a punch file with modes; others have matrices, or cards."""
    return path.suffix.lower() == PUNCH and MODES in read_bytes(path, LARGEST_FILE)


def read_punch_shapes(path: Path) -> Shapes | None:
    """Return the modes of a file; None if it has none.

    Raises:
        VehicleError: it is damaged, or cut.
    """
    with located(path):
        found = list(_shapes(read_bytes(path, LARGEST_FILE)))
        return assembled(found, is_basic=False) if found else None


def _shapes(content: bytes) -> Iterator[Shape]:
    """The modes of a file, each below its headings."""
    headings = list(HEADINGS.finditer(content))
    starts = [*(heading.start() for heading in headings), len(content)]
    for heading, end in zip(headings, starts[1:], strict=True):
        said = heading[0]
        if MODES not in said:
            continue
        value, subcase = EIGENVALUE.search(said), SUBCASE.search(said)
        if value is None and BY_POINT in said:
            raise VehicleError("its modes are sorted by grid (SORT2); write them with SORT1")
        if value is None:
            raise VehicleError("found headings of a mode without its eigenvalue; is the file cut?")
        lines = content[heading.end() : end].splitlines()
        n_lines = 2 if b"REAL OUTPUT" in said else 4
        form = MAGNITUDE_AND_PHASE if b"MAGNITUDE-PHASE" in said else 1
        with located(f"mode {int(value[3])}"):
            ids, is_grid = _points(lines, n_lines)
            yield Shape(
                int(subcase[1]) if subcase else 0,
                int(value[3]),
                complex(_number(value[1]), _number(value[2] or b"0")),
                ids[is_grid],
                partial(_motions, lines, n_lines, is_grid, form),
                n_scalar=int(np.sum(~is_grid)),
            )


def _points(lines: Sequence[bytes], n_lines: int) -> tuple[Array, Array]:
    """Numbers of the points that lines are of, and which are grids."""
    if len(lines) % n_lines:
        raise VehicleError(f"found {len(lines)} lines, expected {n_lines} for each point; is it cut?")
    first = [line.split(None, 2)[:2] for line in lines[::n_lines]]
    if wrong := [w for w in first if len(w) < 2 or not (w[0].isdigit() and w[1].isalpha())]:
        raise VehicleError(f"found {b' '.join(wrong[0])[:40]!r}, expected a point and its kind")
    ids = [int(number) for number, _ in first]
    if max(ids, default=0) >= 2**53:
        raise VehicleError(f"found a point {max(ids)}, which is no number of one")
    return np.array(ids, np.int64), np.array([kind == b"G" for _, kind in first], bool)


def _motions(lines: Sequence[bytes], n_lines: int, is_grid: Array, form: int) -> Array:
    """The motions of grids, (n, 6)."""
    texts = [line[FIRST : FIRST + 3 * WIDTH].ljust(3 * WIDTH) for line in lines]
    try:
        numbers = np.array(texts, f"S{3 * WIDTH}").view(f"S{WIDTH}").astype(float)
    except ValueError:
        raise VehicleError(f"found no numbers in columns of {WIDTH}, as it has them") from None
    values = numbers.reshape(-1, 3 * n_lines)[is_grid]
    return values if n_lines == 2 else complex_motions(values, form)


def _number(text: bytes) -> float:
    try:
        return float(text)
    except ValueError:
        raise VehicleError(f"found the eigenvalue {text.decode('latin-1')[:40]!r}") from None
