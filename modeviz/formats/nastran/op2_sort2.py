"""Modes that an OP2 file has sorted by grid (SORT2), taken by mode.

After MSC Nastran's DMAP Programmer's Guide, "Data Blocks", OUG: the header is that of a grid, whose
number stands where otherwise that of the mode does, and each row begins with the number of a mode.
"""

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.limits import check_shapes
from modeviz.formats.nastran.op2_records import Table
from modeviz.formats.nastran.shapes import Shape
from modeviz.vehicle.arrays import Floats

NORMAL = 2
GRID_POINT = 1

WIDTH = 8
"""Words of a row."""


def by_mode(table: Table, numbers: Sequence[int], eigenvalues: Floats) -> Iterator[Shape]:
    """Yield the normal modes of a table.

    Args:
        table: that has them.
        numbers: of the records that are headers of its grids.
        eigenvalues: (n, 4), rows of the tables of eigenvalues, since this one has none.

    Raises:
        VehicleError: grids have different modes, they are complex, or a mode's eigenvalue is unknown.
    """
    known = {int(number): value for number, value in eigenvalues[:, :2].tolist()}
    subcases: dict[int, list[int]] = {}
    for number in numbers:
        header = table.whole(number)
        if int(header[0]) // 10 != NORMAL:
            raise VehicleError(
                "its modes are complex and sorted by grid (SORT2); write them with SORT1"
            )
        subcases.setdefault(int(header[3]), []).append(number)
    for subcase, headers in subcases.items():
        yield from _subcase(table, subcase, headers, known)


def _subcase(
    table: Table, subcase: int, headers: Sequence[int], known: dict[int, float]
) -> Iterator[Shape]:
    """The modes of a subcase."""
    modes = table.whole(headers[0] + 1).reshape(-1, WIDTH)[:, 0]
    check_shapes(len(headers), len(modes))
    ids, motions, n_scalar = [], [], 0
    for header in headers:
        rows = table.whole(header + 1).reshape(-1, WIDTH)
        grid = int(table.whole(header)[4]) // 10
        if not np.array_equal(rows[:, 0], modes):
            raise VehicleError(f"grid {grid} has other modes than the first")
        if not len(rows) or rows[0, 1] != GRID_POINT:
            n_scalar += 1
            continue
        ids.append(grid)
        motions.append(table.real(header + 1).reshape(-1, WIDTH)[:, 2:])
    if not ids:
        return
    every = np.stack(motions, axis=1)
    for column, mode in enumerate(modes.tolist()):
        if mode not in known:
            raise VehicleError(
                f"mode {mode} is sorted by grid (SORT2) and its eigenvalue is in no table (LAMA); "
                "write the modes with SORT1"
            )
        read = partial(every.__getitem__, column)
        yield Shape(subcase, mode, known[mode], np.array(ids), read, n_scalar)
