"""Modes that a Nastran run printed (.f06), with seven digits.

After files that MSC and NX Nastran wrote: a mode goes on over pages, each of which repeats its
eigenvalue and its number above the rows of points; the table of eigenvalues has generalised masses.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import read_bytes
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.nastran.shapes import Shape, Shapes, assembled
from modeviz.vehicle.arrays import Floats

PRINTED = ".f06"

EIGENVALUE = re.compile(rb"^ *EIGENVALUE = *([-+.\dE]+)")
MODE = re.compile(rb"R E A L   E I G E N V E C T O R   N O \. *(\d{1,9}) *$")
SUBCASE = re.compile(rb"^0 .*SUBCASE +(\d{1,9})")
COMPLEX = b"C O M P L E X   E I G E N V E C T O R"
TABLE = b"R E A L   E I G E N V A L U E S"
BUCKLING = re.compile(rb"^ *SOL +(?:105|SEBUCKL|BUCKLING)\b", re.MULTILINE | re.IGNORECASE)

END = b"END OF JOB"

PAGE = b"1"
"""How the first line of a page begins."""


@dataclass
class _Mode:
    """A mode as its pages are read."""

    eigenvalue: float
    rows: list[tuple[int, list[float]]] = field(default_factory=list)
    n_scalar: int = 0


def read_printed_shapes(path: Path) -> tuple[Shapes | None, Floats]:
    """Return the modes of a file, None if it has none, and its table of eigenvalues.

    The table is (n, 4): number of a mode, eigenvalue, generalised mass, zero.

    Raises:
        VehicleError: it is damaged or cut, or its modes are complex.
    """
    with located(path):
        content = read_bytes(path, LARGEST_FILE)
        if BUCKLING.search(content):
            return None, np.zeros((0, 4))
        found = list(_shapes(content))
        if not found and COMPLEX in content:
            raise VehicleError("its modes are complex, which are read from an OP2 file only")
        table = _eigenvalue_rows(content)
        _check_end(content, found, table)
        return (assembled(found, is_basic=False) if found else None), table


def _check_end(content: bytes, found: Sequence[Shape], table: Floats) -> None:
    """Raises VehicleError if a file ends before all modes of its table are printed.

    Of one that has its end others than these may not have been asked for.
    """
    missing = {int(mode) for mode in table[:, 0]} - {shape.mode for shape in found}
    if found and missing and END not in content:
        raise VehicleError(
            f"mode {min(missing)} of its table of eigenvalues is not there, and no line "
            f"{END.decode()}: the file is cut"
        )


def _shapes(content: bytes) -> Iterator[Shape]:
    """The modes of a file, in the systems of the grids' CD."""
    for (subcase, number), mode in _modes(content).items():
        with located(f"mode {number}"):
            if not mode.rows:
                raise VehicleError("has no grids; is the file cut?")
            ids = np.array([grid for grid, _ in mode.rows], np.int64)
            motions = partial(np.array, [row for _, row in mode.rows])
            yield Shape(subcase, number, complex(mode.eigenvalue), ids, motions, mode.n_scalar)


def _modes(content: bytes) -> dict[tuple[int, int], _Mode]:
    """All modes by subcase and number."""
    modes: dict[tuple[int, int], _Mode] = {}
    subcase, eigenvalue, current = 1, 0.0, None
    for line in content.splitlines():
        if line.startswith(PAGE):
            current = None
        elif found := EIGENVALUE.match(line):
            eigenvalue = _numbers([found[1]])[0]
        elif found := SUBCASE.match(line):
            subcase = int(found[1])
        elif found := MODE.search(line):
            current = modes.setdefault((subcase, int(found[1])), _Mode(eigenvalue))
        elif current:
            _add_row(current, line.split())
    return modes


def _add_row(mode: _Mode, words: list[bytes]) -> None:
    """Takes in a row of a grid, or of scalar points of which it has up to six."""
    if len(words) < 3 or not words[0].isdigit() or len(words[0]) > 15:
        return
    if words[1] == b"S":
        mode.n_scalar += len(words) - 2
    elif words[1] == b"G":
        motion = _numbers(words[2:])
        if len(motion) not in (3, 6):
            raise VehicleError(f"grid {int(words[0])}: found {len(motion)} numbers, expected 3 or 6")
        mode.rows.append((int(words[0]), [*motion, 0.0, 0.0, 0.0][:6]))


def _eigenvalue_rows(content: bytes) -> Floats:
    rows = []
    for page in content.split(TABLE)[1:]:
        for line in page.partition(b"\n" + PAGE)[0].splitlines():
            words = line.split()
            if len(words) == 7 and words[0].isdigit() and words[1].isdigit():
                mode, _, eigenvalue, _, _, mass, _ = _numbers(words)
                rows.append((mode, eigenvalue, mass, 0.0))
    return np.array(rows).reshape(-1, 4)


def _numbers(words: list[bytes]) -> list[float]:
    try:
        return [float(word) for word in words]
    except ValueError:
        raise VehicleError(f"found {b' '.join(words)[:60]!r}, expected numbers") from None
