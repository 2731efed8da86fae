"""Grids of an OP2 file that has none in GEOM1, as PARAM,POST,-4 leaves it.

After MSC Nastran's DMAP Programmer's Guide, "Data Blocks": GPL has the numbers of all points in the
solver's order, EQEXIN pairs of a number and its place in that order, GPDT where the points are, and
CSTM the coordinate systems as they stand in the basic one.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.frames import FrameKind
from modeviz.formats.nastran.model import FrameCard
from modeviz.formats.nastran.op2_records import Table
from modeviz.vehicle.arrays import Array, Floats

KINDS: dict[int, FrameKind] = {1: "rectangular", 2: "cylindrical", 3: "spherical"}

POINT_WIDTH, FRAME_WIDTH = 7, 14
"""Words of a point and of a coordinate system."""


def read_points(
    tables: Sequence[Table],
) -> tuple[tuple[Array, Array, Floats], dict[int, FrameCard]] | None:
    """Return ids, systems and coordinates of grids, and coordinate systems; None if there are none.

    Raises:
        VehicleError: a table is damaged.
    """
    places, systems = _first(tables, "GPDT"), _first(tables, "CSTM")
    ids = _in_order(tables)
    if ids is None or places is None:
        return None
    if len(places.whole(1)) != POINT_WIDTH * len(ids):
        raise VehicleError(
            f"table GPDT has {len(places.whole(1))} words, expected {POINT_WIDTH} for each of "
            f"{len(ids)} points"
        )
    whole, real = (words.reshape(-1, POINT_WIDTH) for words in (places.whole(1), places.real(1)))
    if ((whole[:, 0] < 1) | (whole[:, 0] > len(ids))).any():
        raise VehicleError("table GPDT has points beyond those that have a number")
    is_grid = whole[:, 1] >= 0  # scalar points are in no coordinate system
    grids = (
        ids[whole[is_grid, 0] - 1].astype(np.int64),
        whole[is_grid][:, [1, 5]].astype(np.int64),
        real[is_grid, 2:5].astype(float),
    )
    return grids, dict(_frames(systems)) if systems else {}


def _in_order(tables: Sequence[Table]) -> Array | None:
    """The numbers of all points in the solver's order; None if no table says them."""
    if numbers := _first(tables, "GPL"):
        return numbers.whole(1)
    if (pairs := _first(tables, "EQEXIN")) is None:
        return None
    ids, places = pairs.whole(1)[: len(pairs.whole(1)) // 2 * 2].reshape(-1, 2).T
    if not np.array_equal(np.sort(places), np.arange(1, len(places) + 1)):
        raise VehicleError("table EQEXIN does not say one place for each point")
    return ids[np.argsort(places)]


def _first(tables: Sequence[Table], name: str) -> Table | None:
    """The first table of that name that has a record beside its header."""
    return next((table for table in tables if table.name == name and len(table.records) > 1), None)


def _frames(table: Table) -> Iterator[tuple[int, FrameCard]]:
    """Coordinate systems: number, kind, origin, and a matrix whose columns are its axes."""
    whole, real = table.whole(1), table.real(1)
    if len(whole) % FRAME_WIDTH:
        raise VehicleError(f"found {len(whole)} words of CSTM, expected a multiple of {FRAME_WIDTH}")
    for row, values in zip(
        whole.reshape(-1, FRAME_WIDTH), real.reshape(-1, FRAME_WIDTH).astype(float), strict=True
    ):
        origin, axes = values[2:5], values[5:].reshape(3, 3)
        if (kind := KINDS.get(int(row[1]))) is None:
            raise VehicleError(
                f"found a coordinate system of kind {row[1]} in CSTM, expected 1, 2 or 3"
            )
        points = np.array([origin, origin + axes[:, 2], origin + axes[:, 0]])
        yield int(row[0]), FrameCard(kind, 0, points)
