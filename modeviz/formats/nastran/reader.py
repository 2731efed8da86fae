"""Nastran's files as a component."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located, paths_together
from modeviz.formats.component import Component, ElementKind, Modes, rows_of
from modeviz.formats.frames import turn_to_basic
from modeviz.formats.nastran.deck import read_deck
from modeviz.formats.nastran.geometry import once, without_modes
from modeviz.formats.nastran.hdf5 import read_hdf5_model, read_hdf5_shapes
from modeviz.formats.nastran.input_file import read_input
from modeviz.formats.nastran.model import Model, basic_geometry
from modeviz.formats.nastran.op2_geometry import read_model
from modeviz.formats.nastran.op2_modes import eigenvalue_rows, read_shapes
from modeviz.formats.nastran.op2_records import read_tables
from modeviz.formats.nastran.op2_remarks import remarks
from modeviz.formats.nastran.printed_modes import PRINTED, read_printed_shapes
from modeviz.formats.nastran.punch_modes import PUNCH, read_punch_shapes
from modeviz.formats.nastran.residual_vectors import residual_vectors
from modeviz.formats.nastran.shapes import Shapes
from modeviz.vehicle.arrays import Array, Floats

DECKS = (".bdf", ".dat", ".nas")
HDF5 = (".h5", ".hdf5")
MODES_ELSEWHERE = "the modes are in a file of results (OP2, HDF5, punch, F06): give it too"

SUFFIXES = (*DECKS, ".op2", *HDF5, PUNCH, PRINTED)


@dataclass(frozen=True, eq=False)
class _Results:
    """What a file of results has."""

    path: Path
    shapes: Shapes | None
    rows: Floats
    """(n, 4): number, eigenvalue, generalised mass and RESFLG in tables of eigenvalues."""
    model: Callable[[], Model | None]
    """Reads its geometry; none if it has none."""
    notes: tuple[str, ...] = ()
    """What there is to know of the file."""


def read_nastran(paths: Sequence[Path]) -> Component:
    """Return the component of a file of results, of an input file, or of both.

    With both the geometry is the input file's.

    Raises:
        VehicleError: there are several of a kind, or one is damaged, cut, or has neither geometry nor
            modes.
    """
    decks = [path for path in paths if path.suffix.lower() in DECKS]
    others = [path for path in paths if path not in decks]
    if len(decks) > 1 or len(others) > 1:
        raise VehicleError(
            f"found {', '.join(path.name for path in paths)}, expected one input file, one file of "
            "results (OP2, HDF5, punch, F06) or one of each; files that are included are found"
        )
    if not others:
        return read_input(decks[0]).geometry(MODES_ELSEWHERE)
    results = _read_results(others[0])
    model = read_deck(decks[0]) if decks else results.model()
    if model is None:
        return _without_geometry(results)
    with located(paths_together(paths)):
        places, frames = basic_geometry(model)
        if decks:
            _check_one_model(model, results)
        if results.shapes is None:
            said = [*results.notes, "the file of results has no modes"]
            return without_modes(model, places, frames, said)
        return _component(model, places, frames, results)


def _check_one_model(model: Model, results: _Results) -> None:
    """Checks that an input file has most of the grids that results move; those of others may be few.

    Raises:
        VehicleError: it does not.
    """
    ids = np.zeros(0, np.int64) if results.shapes is None else results.shapes.ids
    n_there = int(np.isin(ids, model.ids).sum())
    if 2 * n_there < len(ids):
        raise VehicleError(
            f"these two files are not of one model: {len(ids) - n_there} of the {len(ids)} grids that "
            f"{results.path.name} moves are not in the input file, which has {len(model.ids)}; give "
            "the input file of that run"
        )


def _read_results(path: Path) -> _Results:
    if path.suffix.lower() in HDF5:
        shapes, rows = read_hdf5_shapes(path)
        model = partial(read_hdf5_model, path)
    elif path.suffix.lower() == PUNCH:
        shapes, rows, model = read_punch_shapes(path), np.zeros((0, 4)), _no_model
    elif path.suffix.lower() == PRINTED:
        (shapes, rows), model = read_printed_shapes(path), _no_model
    else:
        tables = read_tables(path)
        shapes, rows = read_shapes(tables, path), eigenvalue_rows(tables)
        return _Results(path, shapes, rows, partial(read_model, tables, path), tuple(remarks(tables)))
    return _Results(path, shapes, rows, model)


def _no_model() -> None:
    """The geometry of files that never have one."""


def _without_geometry(results: _Results) -> Component:
    nothing = Model(np.zeros(0, np.int64), np.zeros((0, 2), np.int64), np.zeros((0, 3)), {}, {})
    if results.shapes is None:
        raise VehicleError(f"{results.path}: has neither geometry nor modes")
    with located(results.path):
        component = _component(nothing, np.zeros((0, 3)), {}, results)
    note = "the file of results has no geometry: give the input file too"
    return replace(component, notes=(*results.notes, *results.shapes.notes, note))


def _component(model: Model, places: Floats, frames: dict, results: _Results) -> Component:
    shapes = results.shapes
    assert shapes is not None
    known, placed, systems = _places(model, places, shapes.ids)
    notes = [*shapes.notes, *_remarks(model, shapes.ids, known)]
    array = shapes.array
    if not shapes.is_basic:
        is_fluid = systems < 0
        turn_to_basic(frames, np.where(is_fluid, 0, systems), np.nan_to_num(placed), array)
    frequency, damping = shapes.frequencies()
    masses = shapes.modal_masses(results.rows)
    n_residuals, unsaid = residual_vectors(shapes, results.rows, model.asked)
    notes += unsaid
    if np.isnan(masses).all() and model.is_mass_normalised and not shapes.is_complex:
        masses = np.ones(len(masses))
        notes.append(
            "the file of results has no table of eigenvalues (LAMA); the modal masses are taken for "
            "one, since the input asks for modes normalised to MASS"
        )
    order = np.argsort(frequency, kind="stable")
    if (np.diff(order) != 1).any():
        array = array[:, :, order]
    modes = Modes(frequency[order], masses[order], damping[order], array, n_residuals)
    elements = _elements(model, shapes.ids)
    return Component(
        shapes.ids,
        placed,
        elements,
        modes,
        notes=once(results.notes, model.notes, notes),
        node_sets=model.node_sets,
    )


def _places(model: Model, places: Floats, ids: Array) -> tuple[Array, Floats, Array]:
    """Which moved grids have a place, all their places, and the systems of their motions."""
    known = np.isin(ids, model.ids)
    rows = rows_of(model.ids, ids[known])
    placed = np.full((len(ids), 3), np.nan)
    placed[known] = places[rows]
    systems = np.zeros(len(ids), np.int64)
    systems[known] = model.systems[rows, 1]
    return known, placed, systems


def _elements(model: Model, ids: Array) -> dict[ElementKind, Array]:
    """Elements all of whose corners move, by rows of the nodes."""
    kept: dict[ElementKind, Array] = {
        kind: c[np.isin(c, ids).all(axis=1)] for kind, c in model.elements.items()
    }
    return {kind: rows_of(ids, corners) for kind, corners in kept.items() if len(corners)}


def _remarks(model: Model, ids: Array, known: Array) -> list[str]:
    remarks = []
    if n_unplaced := int(np.sum(~known)):
        remarks.append(f"{n_unplaced} grids are moved but not in the input file")
    if n_unmoved := int(np.sum(~np.isin(model.ids, ids))):
        remarks.append(f"{n_unmoved} grids have no motion in the file of results and are left out")
    return remarks
