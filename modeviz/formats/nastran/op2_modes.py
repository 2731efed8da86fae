"""Modes of an OP2 file.

After MSC Nastran's DMAP Programmer's Guide, "Data Blocks": OUG and LAMA. Tables whose names
begin with B have their motions in the basic system, the others in the systems of the grids' CD.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.nastran.op2_records import Table
from modeviz.formats.nastran.op2_sort2 import by_mode
from modeviz.formats.nastran.shapes import Shape, Shapes, assembled
from modeviz.vehicle.arrays import Array, Floats

SHAPES = ("OUGV1", "OUG1", "OUGV2", "OUG2", "OPHIG", "BOUGV1", "BOPHIG", "OUGV1PAT")
"""Tables that can have shapes, the first that has any is taken."""

EIGENVALUES = ("LAMA", "BLAMA", "LAMAS", "LAMAF", "CLAMA")

NORMAL, COMPLEX = 2, 9
"""Kinds of analysis that have modes."""

MAGNITUDE_AND_PHASE = 3
"""What complex numbers are written as, if not as real and imaginary parts."""

GRID_POINT = 1
"""What a row of a shape is that is no scalar point."""


def read_shapes(tables: Sequence[Table], path: Path) -> Shapes | None:
    """Return the modes of a file; None if it has none.

    Raises:
        VehicleError: a table is damaged.
    """
    for name in SHAPES:
        found: list[Shape] = []
        for table in tables:
            if table.name == name:
                with located(f"{path}: table {name}"):
                    found += _shapes(table, tables)
        if found:
            with located(f"{path}: table {name}"):
                return assembled(found, name.startswith("B"))
    return None


def eigenvalue_rows(tables: Sequence[Table]) -> Floats:
    """Return number, eigenvalue, generalised mass and RESFLG of rows of tables of eigenvalues, (n, 4).

    What they say of hertz is not asked for; RESFLG is that of their table.
    """
    parts = [np.zeros((0, 4))]
    for table in tables:
        for number in range(2, len(table.records), 2) if table.name in EIGENVALUES else ():
            whole, real = table.whole(number), table.real(number).astype(float)
            last = len(whole) // 7 * 7
            flag = np.full(last // 7, (table.whole(number - 1)[10:11].tolist() or [0])[0])
            parts.append(np.column_stack([whole[:last:7], real[2:last:7], real[5:last:7], flag]))
    return np.concatenate(parts)


def _shapes(table: Table, tables: Sequence[Table]) -> Iterator[Shape]:
    """The modes of a table."""
    by_grid = []
    for number in range(1, len(table.records) - 1, 2):
        whole, real = table.whole(number), table.real(number)
        if len(whole) < 10:
            break
        analysis, sort = int(whole[0]) // 10, int(whole[1]) // 1000
        if analysis not in (NORMAL, COMPLEX):
            continue
        is_complex = analysis == COMPLEX
        width = int(whole[9])
        if width != (14 if is_complex else 8):
            raise VehicleError(
                f"found {width} words for each grid of a mode, expected 8, or 14 if complex"
            )
        if len(table.whole(number + 1)) % width:
            raise VehicleError(
                f"found {len(table.whole(number + 1))} words in a mode, expected a multiple of {width}"
            )
        if sort >= 2:
            by_grid.append(number)
            continue
        yield _shape(table, number + 1, whole, real)
    yield from by_mode(table, by_grid, eigenvalue_rows(tables))


def _shape(table: Table, number: int, whole: Array, real: Floats) -> Shape:
    """The mode whose header is in those words."""
    is_complex = int(whole[0]) // 10 == COMPLEX
    rows = table.whole(number).reshape(-1, int(whole[9]))
    is_grid = rows[:, 1] == GRID_POINT
    return Shape(
        int(whole[3]),
        int(whole[4]),
        complex(real[5], real[6] if is_complex else 0.0),
        rows[is_grid, 0].astype(np.int64) // 10,
        partial(_motions, table, number, int(whole[9]), int(whole[8])),
        n_scalar=int(np.sum(~is_grid)),
    )


def _motions(table: Table, number: int, width: int, form: int) -> Array:
    """The motions of grids in a record, (n, 6)."""
    is_grid = table.whole(number).reshape(-1, width)[:, 1] == GRID_POINT
    values = table.real(number).reshape(-1, width)[:, 2:]
    motions = values if is_grid.all() else values[is_grid]
    return motions if width == 8 else complex_motions(motions, form)


def complex_motions(values: Floats, form: int) -> Array:
    """Return complex numbers, (n, 6), of their parts or of magnitude and phase in degrees, (n, 12)."""
    first, second = values[:, :6], values[:, 6:]
    with np.errstate(invalid="ignore"):  # of what is no number, which is refused with all shapes
        if form == MAGNITUDE_AND_PHASE:
            return first * np.exp(1j * np.radians(second))
        return first + 1j * second
