"""Geometry of an OP2 file.

After MSC Nastran's DMAP Programmer's Guide, "Data Blocks": GEOM1 and GEOM2, whose records begin with a
key of three numbers.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.component import CORNERS, ElementKind
from modeviz.formats.frames import FrameKind
from modeviz.formats.nastran.model import (
    CORNERS_OF,
    FrameCard,
    Model,
    grouped,
    sorted_grids,
    unread_note,
)
from modeviz.formats.nastran.op2_points import read_points
from modeviz.formats.nastran.op2_records import Table
from modeviz.formats.nastran.op2_sets import read_sets
from modeviz.vehicle.arrays import Array, Floats

GRID_KEY = (4501, 45)
DOUBLE = 1_000_000
"""The third number of a record's key is above this if its real numbers take two words of four bytes."""
FRAME_KEYS: dict[tuple[int, int], tuple[FrameKind, bool]] = {
    (1701, 17): ("cylindrical", False), (1801, 18): ("rectangular", False),
    (1901, 19): ("spherical", False), (2001, 20): ("cylindrical", True),
    (2101, 21): ("rectangular", True), (2201, 22): ("spherical", True),
}  # fmt: skip
"""Of CORD1 and CORD2 cards: the kind, and whether it is given by points."""

ELEMENT_KEYS: dict[tuple[int, int], tuple[str, tuple[int, ...]]] = {
    (3001, 30): ("CROD", (4,)), (1601, 16): ("CONROD", (8,)), (3701, 37): ("CTUBE", (4,)),
    (2408, 24): ("CBAR", (16,)), (5408, 54): ("CBEAM", (18, 19)), (2608, 26): ("CBUSH", (14,)),
    (5201, 52): ("PLOTEL", (3,)), (5959, 59): ("CTRIA3", (13, 14)), (4801, 48): ("CTRIA6", (13, 14)),
    (9200, 92): ("CTRIAR", (13, 14)), (2958, 51): ("CQUAD4", (14, 15)),
    (4701, 47): ("CQUAD8", (16, 17, 18)), (8009, 80): ("CQUADR", (14, 15)),
    (3101, 31): ("CSHEAR", (6,)), (5508, 55): ("CTETRA", (12,)),
    (17200, 172): ("CPYRAM", (15, 16)), (4108, 41): ("CPENTA", (17,)), (7308, 73): ("CHEXA", (22,)),
    (4601, 46): ("CBEND", (13,)), (15301, 153): ("CTRIAR", (13, 14)),
    (15401, 154): ("CQUADR", (14, 15)),
    (15801, 158): ("CTRIA6", (13, 14)), (15901, 159): ("CQUAD8", (16, 17, 18)),
    (7409, 74): ("CHEXA", (22,)), (7509, 75): ("CPENTA", (17,)), (7609, 76): ("CTETRA", (12,)),
    (7909, 79): ("CPYRAM", (15, 16)), (3901, 39): ("CVISC", (4,)), (5608, 56): ("CBUSH1D", (8,)),
    (15418, 154): ("CBEAM3", (27,)), (7708, 77): ("CHEXAL", (23,)), (7108, 71): ("CPENTAL", (18,)),
    (14000, 140): ("CHEXA", (22,)), (16300, 163): ("CHEXA", (22,)),
    (16000, 160): ("CPENTA", (17,)), (16500, 165): ("CPENTA", (17,)),
    (16100, 161): ("CTETRA", (12,)), (16600, 166): ("CTETRA", (12,)),
    (16200, 162): ("CTRIA3", (8,)), (16700, 167): ("CTRIA6", (8,)),
    (13900, 139): ("CQUAD4", (11,)), (16400, 164): ("CQUAD", (11,)),
    (1701, 17): ("CPLSTN3", (16,)), (5701, 57): ("CPLSTN4", (16,)),
    (5801, 58): ("CPLSTN6", (16,)), (7201, 72): ("CPLSTN8", (16,)),
    (8801, 88): ("CPLSTS3", (16,)), (8401, 84): ("CPLSTS4", (16,)),
    (1801, 18): ("CPLSTS6", (16,)), (3601, 36): ("CPLSTS8", (24,)),
}  # fmt: skip
"""The element of each record of GEOM2, and how many words one may have, by version.

Some have a second record for a variant, such as of solids as pressure, of layers, of hyperelastic and
other nonlinear materials."""

FIRST_GRID = {"CONROD": 1, "PLOTEL": 1, "CHEXAL": 3, "CPENTAL": 3}
"""At which word an element's grids begin, if not after its property."""


def read_model(tables: Sequence[Table], path: Path) -> Model | None:
    """Return the geometry of a file; None if it has none.

    Raises:
        VehicleError: a table is damaged.
    """
    grids: list[tuple[Array, Array, Floats]] = []
    frames: dict[int, FrameCard] = {}
    for table in tables:
        if table.name in ("GEOM1", "GEOM1S"):
            with located(f"{path}: table {table.name}"):
                own, own_frames = _geometry(table)
                grids += [sorted_grids(*own)] if own else []
                frames = own_frames | frames
    if not grids:
        with located(path):
            points = read_points(tables)
        if points is None:
            return None
        grids, frames = [sorted_grids(*points[0])], points[1]
    ids, systems, coordinates = _together(grids)
    lots: dict[ElementKind, list[Array]] = {}
    notes: list[str] = []
    of_elements = [table for table in tables if table.name in ("GEOM2", "GEOM2S")]
    for table in of_elements:
        with located(f"{path}: table {table.name}"):
            notes += _add_elements(lots, table, ids)
    if len(of_elements) > 1:  # some files have all of them twice
        lots = {kind: [np.unique(np.concatenate(rows), axis=0)] for kind, rows in lots.items()}
    return Model(
        ids,
        systems,
        coordinates,
        frames,
        grouped(lots),
        notes=tuple(dict.fromkeys(notes)),
        node_sets=read_sets(tables),
    )


def _together(tables: Sequence[tuple[Array, Array, Floats]]) -> tuple[Array, Array, Floats]:
    """The grids of several tables, as superelements have them; of those with one id the first."""
    ids, systems, coordinates = (np.concatenate(parts) for parts in zip(*tables, strict=True))
    unique, first = np.unique(ids, return_index=True)
    return unique, systems[first], coordinates[first]


def _geometry(
    table: Table,
) -> tuple[tuple[Array, Array, Floats] | None, dict[int, FrameCard]]:
    """The grids of a table, if it has any, and its coordinate systems."""
    grids: list[tuple[Array, Array, Floats]] = []
    frames: dict[int, FrameCard] = {}
    for number in range(1, len(table.records)):
        whole, real = table.whole(number), table.real(number)
        if len(whole) <= 3:
            continue
        key = int(whole[0]), int(whole[1])
        if key == GRID_KEY:
            grids.append(_grids(whole, real))
        elif key in FRAME_KEYS:
            frames.update(_frames(*FRAME_KEYS[key], whole, real))
    if not grids:
        return None, frames
    ids, systems, coordinates = (np.concatenate(parts) for parts in zip(*grids, strict=True))
    return (ids, systems, coordinates), frames


def _grids(whole: Array, real: Array) -> tuple[Array, Array, Floats]:
    """Ids, systems and coordinates of a record of grids, in single or double precision."""
    width, last = (11, 8) if _is_double(whole) else (8, 5)
    rows = _in_rows(whole[3:], width, "GRID")
    coordinates = _numbers(_in_rows(real[3:], width, "GRID")[:, 2:last], _is_double(whole))
    return rows[:, 0].astype(np.int64), rows[:, [1, last]].astype(np.int64), coordinates


def _is_double(whole: Array) -> bool:
    """Whether a record has its real numbers in two words each."""
    return int(whole[2]) > DOUBLE and whole.dtype.itemsize == 4


def _numbers(words: Array, is_double: bool) -> Floats:
    """The numbers in rows of words."""
    if is_double:
        words = np.ascontiguousarray(words).view(f"{words.dtype.str[0]}f8")
    return words.astype(np.float64)


def _frames(
    kind: FrameKind, by_points: bool, whole: Array, real: Array
) -> Iterator[tuple[int, FrameCard]]:
    if not by_points:
        for row in _in_rows(whole[3:], 6, "coordinate system").tolist():
            yield row[0], FrameCard(kind, 0, grids=tuple(row[3:]))
        return
    width = 22 if _is_double(whole) else 13
    rows = _in_rows(whole[3:], width, "coordinate system")
    values = _numbers(_in_rows(real[3:], width, "coordinate system")[:, 4:], _is_double(whole))
    for (number, _, _, reference), points in zip(rows[:, :4].tolist(), values, strict=True):
        yield number, FrameCard(kind, reference, points.reshape(3, 3))


def _in_rows(words: Array, width: int, what: str) -> Array:
    if len(words) % width:
        raise VehicleError(f"found {len(words)} words of {what}, expected a multiple of {width}")
    return words.reshape(-1, width)


def _add_elements(lots: dict[ElementKind, list[Array]], table: Table, ids: Array) -> Iterator[str]:
    """Puts corners of elements to those of their kind; yields what could not be read of them."""
    for number in range(1, len(table.records)):
        whole = table.whole(number)
        if len(whole) <= 3 or (key := (int(whole[0]), int(whole[1]))) not in ELEMENT_KEYS:
            continue
        name, widths = ELEMENT_KEYS[key]
        corners = _corners(whole[3:], name, widths, ids)
        if corners is None:
            yield unread_note(name)
        else:
            lots.setdefault(CORNERS_OF[name], []).append(corners)


def _corners(words: Array, name: str, widths: tuple[int, ...], ids: Array) -> Array | None:
    """The grids at corners of elements, for the width with which all of them are grids; else None."""
    first = FIRST_GRID.get(name, 2)
    n_corners = CORNERS[CORNERS_OF[name]]
    for width in widths:
        if len(words) % width == 0:
            corners = words.reshape(-1, width)[:, first : first + n_corners].astype(np.int64)
            corners = corners[(corners != 0).all(axis=1)]
            if np.isin(corners, ids).all():
                return corners
    return None
