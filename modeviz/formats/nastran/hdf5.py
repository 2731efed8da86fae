"""MSC Nastran's HDF5 results (.h5), which MDLPRM,HDF5 asks for.

After the data type definitions that come with MSC Nastran. NASTRAN/INPUT has a table for each kind of
card, NASTRAN/RESULT those of results, whose rows are in the order of domains: NASTRAN/RESULT/DOMAINS
says what a domain is, such as a mode, and INDEX which rows of a table it has.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from modeviz.errors import located
from modeviz.formats.component import CORNERS, ElementKind
from modeviz.formats.nastran.hdf5_tables import Tables, opened_tables
from modeviz.formats.nastran.model import (
    CORNERS_OF,
    FRAME_CARDS,
    FrameCard,
    Model,
    grouped,
    sorted_grids,
    unread_note,
    weights_note,
)
from modeviz.formats.nastran.shapes import Shape, Shapes, assembled
from modeviz.vehicle.arrays import Array, Floats

INPUT, RESULT = "NASTRAN/INPUT", "NASTRAN/RESULT"

DIRECTIONS = ("X", "Y", "Z", "RX", "RY", "RZ")

NORMAL, COMPLEX = 2, 9
"""Kinds of analysis that have modes."""

SHAPES: Mapping[str, tuple[int, tuple[str, ...]]] = {
    "NODAL/EIGENVECTOR": (NORMAL, DIRECTIONS),
    "NODAL/EIGENVECTOR_CPLX": (
        COMPLEX,
        (*(f"{d}R" for d in DIRECTIONS), *(f"{d}I" for d in DIRECTIONS)),
    ),
}
"""The tables of modes, the first that has any is taken: of which kind, and their columns."""


def read_hdf5_shapes(path: Path) -> tuple[Shapes | None, Floats]:
    """Return the modes of a file, None if it has none, and its table of eigenvalues.

    The table is (n, 3): number of a mode, eigenvalue, generalised mass.

    Raises:
        VehicleError: it is no such file, is damaged, or h5py is not installed.
    """
    with opened_tables(path) as tables, located(path):
        return _first_shapes(tables), _eigenvalue_rows(tables)


def read_hdf5_model(path: Path) -> Model | None:
    """Return the geometry of a file, None if it has none.

    Raises:
        VehicleError: as for the modes.
    """
    with opened_tables(path) as tables, located(path):
        if not tables.has(f"{INPUT}/NODE/GRID"):
            return None
        name = f"{INPUT}/NODE/GRID"
        whole = tables.whole(name, ("ID", "CP", "CD"))
        grids = sorted_grids(whole[:, 0], whole[:, 1:], tables.real(name, ("X",), width=3))
        elements, notes = _elements(tables)
        return Model(*grids, dict(_frames(tables)), elements, notes=(*notes, *_weights(tables)))


def _first_shapes(tables: Tables) -> Shapes | None:
    for name, (analysis, columns) in SHAPES.items():
        found = list(_shapes(tables, f"{RESULT}/{name}", analysis, columns))
        if found:
            return assembled(found, is_basic=False)
    return None


def _shapes(tables: Tables, name: str, analysis: int, columns: Sequence[str]) -> Iterator[Shape]:
    """The modes of a table."""
    if not tables.has(name):
        return
    of_domains = f"{RESULT}/DOMAINS"
    domains = tables.whole(of_domains, ("ID", "ANALYSIS", "SUBCASE", "MODE"))
    eigenvalues = tables.real(of_domains, ("TIME_FREQ_EIGR", "EIGI"))
    scalar = _scalar_points(tables)
    index = tables.whole(f"INDEX/{name}", ("DOMAIN_ID", "POSITION", "LENGTH"))
    for domain, position, length in index.tolist():
        rows = np.flatnonzero((domains[:, :2] == (domain, analysis)).all(axis=1))
        if not len(rows):
            continue
        subcase, mode = domains[rows[0], 2:].tolist()
        real, imaginary = eigenvalues[rows[0]].tolist()
        part = slice(position, position + length)
        ids = tables.whole(name, ("ID",), part)[:, 0]
        is_grid = ~np.isin(ids, scalar)
        yield Shape(
            subcase,
            mode,
            complex(real, imaginary if analysis == COMPLEX else 0.0),
            ids[is_grid],
            partial(_motions, tables, name, columns, part, is_grid),
            n_scalar=int(np.sum(~is_grid)),
        )


def _motions(tables: Tables, name: str, columns: Sequence[str], part: slice, is_grid: Array) -> Array:
    """The motions of grids in some rows of a table, (n, 6)."""
    values = tables.real(name, columns, part)[is_grid]
    return values if len(columns) == 6 else values[:, :6] + 1j * values[:, 6:]


def _scalar_points(tables: Tables) -> Array:
    """The ids of points that are nowhere, which stand among the grids of results."""
    names = [f"{INPUT}/NODE/{kind}" for kind in ("SPOINT", "EPOINT")]
    ids = [tables.whole(name, ("ID",))[:, 0] for name in names if tables.has(name)]
    return np.concatenate([np.zeros(0, np.int64), *ids])


def _eigenvalue_rows(tables: Tables) -> Floats:
    name = f"{RESULT}/SUMMARY/EIGENVALUE"
    if not tables.has(name):
        return np.zeros((0, 4))
    return tables.real(name, ("MODE", "EIGEN", "MASS", "RESFLG"))


def _frames(tables: Tables) -> Iterator[tuple[int, FrameCard]]:
    """Coordinate systems by number."""
    for letter, kind in FRAME_CARDS.items():
        name = f"{INPUT}/COORDINATE_SYSTEM/CORD1{letter}"
        if tables.has(name):
            for number, *grids in tables.whole(name, ("CID", "G1", "G2", "G3")).tolist():
                yield number, FrameCard(kind, 0, grids=tuple(grids))
        name = f"{INPUT}/COORDINATE_SYSTEM/CORD2{letter}"
        if tables.has(name):
            numbers = tables.whole(name, ("CID", "RID")).tolist()
            points = tables.real(name, [f"{point}{i}" for point in "ABC" for i in (1, 2, 3)])
            for (number, reference), own in zip(numbers, points.reshape(-1, 3, 3), strict=True):
                yield number, FrameCard(kind, reference, own)


def _elements(tables: Tables) -> tuple[dict[ElementKind, Array], list[str]]:
    """The grids at corners of elements, by kind, and what could not be read of them."""
    lots: dict[ElementKind, list[Array]] = {}
    notes = []
    for card, kind in CORNERS_OF.items():
        name = f"{INPUT}/ELEMENT/{card}"
        if not tables.has(name):
            continue
        n_corners = CORNERS[kind]
        forms = (("G",), ("GA", "GB"), tuple(f"G{i + 1}" for i in range(n_corners)))
        own = next((form for form in forms if set(form) <= tables.columns(name)), None)
        if own is None:
            notes.append(unread_note(card))
        else:
            corners = tables.whole(name, own, width=n_corners)
            lots.setdefault(kind, []).append(corners[(corners > 0).all(axis=1)])
    return grouped(lots), notes


def _weights(tables: Tables) -> Iterator[str]:
    """A sentence if masses are given as weights."""
    name = f"{INPUT}/PARAMETER/PVT/DOUBLE"
    if not tables.has(name):
        return
    values = tables.real(name, ("VALUE",))[:, 0].tolist()
    for key, value in zip(tables.texts(name, "NAME"), values, strict=True):
        if key.upper() == "WTMASS" and value != 1:
            yield weights_note(f"{value:.6g}")
