"""Nastran's files as a component."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.component import Component, ElementKind, Modes, rows_of
from modeviz.formats.frames import turn_to_basic
from modeviz.formats.limits import check_shapes
from modeviz.formats.nastran.deck import read_deck
from modeviz.formats.nastran.model import Model, basic_geometry
from modeviz.formats.nastran.op2_geometry import read_model
from modeviz.formats.nastran.op2_modes import Shape, Shapes, modal_masses, read_shapes
from modeviz.formats.nastran.op2_records import Table, read_tables
from modeviz.vehicle.arrays import Array, Floats

DECKS = (".bdf", ".dat", ".nas")
SUFFIXES = (*DECKS, ".op2")


@dataclass(frozen=True, eq=False)
class _Results:
    """What an OP2 file has."""

    path: Path
    tables: list[Table]
    shapes: Shapes | None


def read_nastran(paths: Sequence[Path]) -> Component:
    """Return the component of an OP2 file, of an input file, or of both.

    With both the geometry is the input file's.

    Raises:
        VehicleError: there are several of a kind, or one is damaged, cut, or has neither geometry nor
            modes.
    """
    decks = [path for path in paths if path.suffix.lower() in DECKS]
    others = [path for path in paths if path not in decks]
    if len(decks) > 1 or len(others) > 1:
        raise VehicleError(
            f"found {', '.join(path.name for path in paths)}, expected one input file, one OP2 file or "
            "one of each; files that are included are found"
        )
    results = [_read_results(path) for path in others]
    model = read_deck(decks[0]) if decks else None
    if model is None:
        model = read_model(results[0].tables, results[0].path)
    if model is None:
        return _without_geometry(results[0])
    with located(", ".join(map(str, paths))):
        places, frames = basic_geometry(model)
        if not results or results[0].shapes is None:
            return _without_modes(model, places, bool(results))
        return _component(model, places, frames, results[0])


def _read_results(path: Path) -> _Results:
    tables = read_tables(path)
    return _Results(path, tables, read_shapes(tables, path))


def _without_geometry(results: _Results) -> Component:
    nothing = Model(np.zeros(0, np.int64), np.zeros((0, 2), np.int64), np.zeros((0, 3)), {}, {})
    if results.shapes is None:
        raise VehicleError(f"{results.path}: has neither geometry (GEOM1) nor modes")
    with located(results.path):
        component = _component(nothing, np.zeros((0, 3)), {}, results)
    note = "the OP2 file has no geometry (GEOM1): give the input file too"
    return replace(component, notes=(note,))


def _without_modes(model: Model, places: Floats, has_results: bool) -> Component:
    missing = (
        "the OP2 file has no modes" if has_results else "the modes are in the OP2 file: give it too"
    )
    none = np.zeros(0)
    modes = Modes(none, none, none, np.zeros((len(model.ids), 6, 0)))
    elements: dict[ElementKind, Array] = {
        kind: rows_of(model.ids, corners) for kind, corners in model.elements.items()
    }
    return Component(
        model.ids,
        places,
        elements,
        modes,
        notes=(*model.notes, missing),
        node_sets=model.node_sets,
    )


def _component(model: Model, places: Floats, frames: dict, results: _Results) -> Component:
    shapes = results.shapes
    assert shapes is not None
    ids = _common_ids(shapes.modes)
    known, placed, systems = _places(model, places, ids)
    notes = [*model.notes, *_remarks(model, shapes, ids, known)]
    array = _array(ids, shapes.modes)
    if not shapes.is_basic:
        is_fluid = systems < 0
        turn_to_basic(frames, np.where(is_fluid, 0, systems), np.nan_to_num(placed), array)
    frequency, damping = _frequencies(shapes.modes)
    masses = modal_masses(results.tables, shapes.modes, results.path)
    if np.isnan(masses).all() and model.is_mass_normalised and not shapes.modes[0].is_complex:
        masses = np.ones(len(masses))
        notes.append(
            "the OP2 file has no table of eigenvalues (LAMA); the modal masses are taken for one, "
            "since the input asks for modes normalised to MASS"
        )
    order = np.argsort(frequency, kind="stable")
    if (np.diff(order) != 1).any():
        array = array[:, :, order]
    modes = Modes(frequency[order], masses[order], damping[order], array)
    elements = _elements(model, ids)
    return Component(ids, placed, elements, modes, notes=tuple(notes), node_sets=model.node_sets)


def _common_ids(modes: Sequence[Shape]) -> Array:
    """The grids that all modes move, rising."""
    ids = np.sort(modes[0].ids)
    if (ids[1:] == ids[:-1]).any():
        raise VehicleError(f"mode {modes[0].mode} moves grid {ids[1:][ids[1:] == ids[:-1]][0]} twice")
    for shape in modes:
        if len(shape.ids) != len(ids) or (np.sort(shape.ids) != ids).any():
            raise VehicleError(f"mode {shape.mode} moves other grids than mode {modes[0].mode}")
    return ids


def _array(ids: Array, modes: Sequence[Shape]) -> Array:
    """The shapes, (n_nodes, 6, n_modes), in the precision of the file."""
    check_shapes(len(ids), len(modes))
    dtype = np.result_type(*(shape.motions for shape in modes)).newbyteorder("=")
    array = np.zeros((len(ids), 6, len(modes)), dtype)
    for column, shape in enumerate(modes):
        array[rows_of(ids, shape.ids), :, column] = shape.motions
    return array


def _places(model: Model, places: Floats, ids: Array) -> tuple[Array, Floats, Array]:
    """Which moved grids have a place, all their places, and the systems of their motions."""
    known = np.isin(ids, model.ids)
    rows = rows_of(model.ids, ids[known])
    placed = np.full((len(ids), 3), np.nan)
    placed[known] = places[rows]
    systems = np.zeros(len(ids), np.int64)
    systems[known] = model.systems[rows, 1]
    return known, placed, systems


def _frequencies(modes: Sequence[Shape]) -> tuple[Floats, Floats]:
    """Hz and damping ratios, of eigenvalues: what tables say of hertz is in rad/s in some files."""
    size = np.array([abs(shape.eigenvalue) for shape in modes])
    unknown = np.full(len(modes), np.nan)
    if modes[0].is_complex:
        real = np.array([shape.eigenvalue.real for shape in modes])
        return size / (2 * np.pi), np.divide(-real, size, out=unknown, where=size > 0)
    sign = np.sign([shape.eigenvalue.real for shape in modes])
    return sign * np.sqrt(size) / (2 * np.pi), unknown


def _elements(model: Model, ids: Array) -> dict[ElementKind, Array]:
    """Elements all of whose corners move, by rows of the nodes."""
    kept: dict[ElementKind, Array] = {
        kind: c[np.isin(c, ids).all(axis=1)] for kind, c in model.elements.items()
    }
    return {kind: rows_of(ids, corners) for kind, corners in kept.items() if len(corners)}


def _remarks(model: Model, shapes: Shapes, ids: Array, known: Array) -> list[str]:
    remarks = []
    if shapes.n_scalar:
        remarks.append(f"{shapes.n_scalar} scalar points have no place and are left out")
    if shapes.n_other:
        remarks.append(
            f"{shapes.n_other} modes of other subcases than {shapes.modes[0].subcase} are left out"
        )
    if n_unplaced := int(np.sum(~known)):
        remarks.append(f"{n_unplaced} grids are moved but not in the input file")
    if n_unmoved := int(np.sum(~np.isin(model.ids, ids))):
        remarks.append(f"{n_unmoved} grids have no motion in the OP2 file and are left out")
    return remarks
