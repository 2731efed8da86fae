"""Modes of an OP2 file.

After MSC Nastran's DMAP Programmer's Guide, "Data Blocks": OUG and LAMA. Tables whose names
begin with B have their motions in the basic system, the others in the systems of the grids' CD.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.component import check_range
from modeviz.formats.nastran.op2_records import Table
from modeviz.vehicle.arrays import Array, Floats

SHAPES = ("OUGV1", "OUG1", "OUGV2", "OUG2", "OPHIG", "BOUGV1", "BOPHIG", "OUGV1PAT")
"""Tables that can have shapes, the first that has any is taken."""

EIGENVALUES = ("LAMA", "BLAMA", "LAMAS", "LAMAF", "CLAMA")

NORMAL, COMPLEX = 2, 9
"""Kinds of analysis that have modes."""

GRID_POINT = 1
"""What a row of a shape is that is no scalar point."""


@dataclass(frozen=True, eq=False)
class Shape:
    """A mode as the file has it."""

    subcase: int
    mode: int
    eigenvalue: complex
    """ω² of a normal mode, s of a complex one."""
    ids: Array
    """(n,), of the grids."""
    motions: Array
    """(n, 6)."""
    is_complex: bool


@dataclass(frozen=True, eq=False)
class Shapes:
    """The modes of a file, of its first subcase that has any."""

    modes: list[Shape]
    is_basic: bool
    """Whether motions are in the basic system."""
    n_scalar: int
    """How many scalar points there are, which no one can see move."""
    n_other: int
    """How many modes other subcases have."""


def read_shapes(tables: Sequence[Table], path: Path) -> Shapes | None:
    """Return the modes of a file; None if it has none.

    Raises:
        VehicleError: a table is damaged.
    """
    for name in SHAPES:
        found: list[tuple[Shape, int]] = []
        for table in tables:
            if table.name == name:
                with located(f"{path}: table {name}"):
                    found += _shapes(table)
        if found:
            first = found[0][0].subcase
            chosen = [shape for shape, _ in found if shape.subcase == first]
            return Shapes(chosen, name.startswith("B"), found[0][1], len(found) - len(chosen))
    return None


def _shapes(table: Table) -> Iterator[tuple[Shape, int]]:
    """The modes of a table, each with how many scalar points it leaves out."""
    for number in range(1, len(table.records) - 1, 2):
        whole, real = table.whole(number), table.real(number)
        if len(whole) < 10:
            return
        analysis, sort = int(whole[0]) // 10, int(whole[1]) // 1000
        if analysis not in (NORMAL, COMPLEX):
            continue
        if sort >= 2:
            raise VehicleError(
                "its modes are sorted by grid (SORT2), expected by mode; write them with SORT1"
            )
        yield _shape(table, number + 1, whole, real)


def _shape(table: Table, number: int, whole: Array, real: Floats) -> tuple[Shape, int]:
    """The mode whose header is in those words, and the number of scalar points in it."""
    is_complex = int(whole[0]) // 10 == COMPLEX
    width = int(whole[9])
    if width != (14 if is_complex else 8):
        raise VehicleError(f"found {width} words for each grid of a mode, expected 8, or 14 if complex")
    rows = table.whole(number)
    if len(rows) % width:
        raise VehicleError(f"found {len(rows)} words in a mode, expected a multiple of {width}")
    rows, values = rows.reshape(-1, width), table.real(number).reshape(-1, width)[:, 2:]
    is_grid = rows[:, 1] == GRID_POINT
    motions = values if is_grid.all() else values[is_grid]
    if is_complex:
        motions = _complex(motions[:, :6], motions[:, 6:], int(whole[8]))
    check_range(f"the motions of mode {whole[4]}", motions)
    eigenvalue = complex(real[5], real[6] if is_complex else 0.0)
    if not np.isfinite(eigenvalue):
        raise VehicleError(f"mode {whole[4]} has an eigenvalue that is no finite number")
    ids = rows[is_grid, 0].astype(np.int64) // 10
    shape = Shape(int(whole[3]), int(whole[4]), eigenvalue, ids, motions, is_complex)
    return shape, int(np.sum(~is_grid))


def _complex(first: Floats, second: Floats, form: int) -> Array:
    """Complex numbers of their parts, or of magnitude and phase in degrees."""
    if form == 3:
        return first * np.exp(1j * np.radians(second))
    return first + 1j * second


def modal_masses(tables: Sequence[Table], modes: Sequence[Shape], path: Path) -> Floats:
    """Return the generalised mass of each mode, (n_modes,); not a number where no table says it.

    Rows of tables of eigenvalues belong to the mode of the same number and eigenvalue; what they say of
    hertz is not asked for.
    """
    known: dict[int, list[tuple[float, float]]] = {}
    for table in tables:
        if table.name not in EIGENVALUES:
            continue
        with located(f"{path}: table {table.name}"):
            for number in range(2, len(table.records), 2):
                whole, real = table.whole(number), table.real(number)
                n_rows = len(whole) // 7
                columns = real[: 7 * n_rows].reshape(-1, 7)
                for mode, row in zip(whole[: 7 * n_rows : 7].tolist(), columns, strict=True):
                    known.setdefault(mode, []).append((float(row[2]), float(row[5])))
    masses = np.full(len(modes), np.nan)
    for i, shape in enumerate(modes):
        scale = abs(shape.eigenvalue)
        for eigenvalue, mass in known.get(shape.mode, []):
            is_same = abs(eigenvalue - shape.eigenvalue) <= 1e-5 * max(scale, 1e-3)
            if is_same and not shape.is_complex and np.isfinite(mass) and mass > 0:
                masses[i] = mass
    return masses
