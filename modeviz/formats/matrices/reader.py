"""Mass, stiffness and nodes, each in whichever file, as a component."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, listed, located, paths_together
from modeviz.fem.matrices import Matrices
from modeviz.files.disk import opened
from modeviz.formats.ansys import FULL, read_full
from modeviz.formats.component import Component, ElementKind, Modes, rows_of
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.matrices.abaqus import read_abaqus
from modeviz.formats.matrices.arrays import read_npz
from modeviz.formats.matrices.market import BEGINNING, read_market
from modeviz.formats.matrices.matlab import read_matlab
from modeviz.formats.matrices.node_table import NodeTable, read_node_table
from modeviz.formats.matrices.soundness import check_structure
from modeviz.formats.named_matrices import NamedMatrix, mass_and_stiffness, symmetric
from modeviz.formats.nastran.input_file import InputFile
from modeviz.formats.nastran.op4 import read_op4
from modeviz.formats.nastran.punch_modes import PUNCH
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.rigid import rigid_motions

TABLES = (".csv", ".txt")
"""Endings of node tables."""


def _read_mtx(path: Path) -> list[NamedMatrix]:
    """The matrices of a file of Matrix Market or of Abaqus, which end alike."""
    with opened(path, LARGEST_FILE) as file:
        is_market = file.read(len(BEGINNING)) == BEGINNING
    return read_market(path) if is_market else read_abaqus(path)


READERS: Mapping[str, Callable[[Path], list[NamedMatrix]]] = {
    FULL: read_full,
    ".npz": read_npz,
    ".mtx": _read_mtx,
    ".mat": read_matlab,
    ".op4": read_op4,
}
"""By the ending of a file's name."""

SUFFIXES = (*READERS, PUNCH, *TABLES)


def read_matrices(
    paths: Sequence[Path],
    geometry: Component | None,
    inputs: Sequence[InputFile] = (),
) -> Component:
    """Return the component of mass and stiffness matrices and of the nodes that they move.

    Args:
        paths: of matrices and, if wanted, of a node table.
        geometry: places of nodes, and elements to draw, from other files.
        inputs: Nastran's input files and what it punched, with matrices or the geometry.

    Raises:
        VehicleError: a file is damaged, something is missing or there twice, or the matrices are none
            of a structure with these nodes.
    """
    tables = [path for path in paths if path.suffix.lower() in TABLES]
    if len(tables) > 1:
        raise VehicleError(
            f"found {len(tables)} node tables, {tables[0]} and {tables[1]}, expected one"
        )
    found = [m for path in paths if path not in tables for m in READERS[path.suffix.lower()](path)]
    table = read_node_table(tables[0]) if tables else None
    found += [matrix for one in inputs for matrix in one.matrices]
    if geometry is None and table is None and len(inputs) == 1:
        geometry = inputs[0].geometry()
    with located(paths_together([*paths, *(one.path for one in inputs)])):
        mass, stiffness, others = mass_and_stiffness(found)
        nodes = _geometry(geometry, table)
        orders = [] if table else [order for one in inputs for order in one.orders]
        component = _component(mass, stiffness, nodes, table, orders)
    left_out = f"the matrices {listed(others)} are left out: neither mass nor stiffness"
    drawn = (
        "the elements of the input file are only drawn: mass and stiffness are those of its DMIG cards"
    )
    notes = [
        *component.notes,
        *([left_out] if others else []),
        *([drawn] if component.elements and any(map(_is_deck_with_matrices, inputs)) else []),
    ]
    return replace(component, notes=tuple(notes))


def _is_deck_with_matrices(one: InputFile) -> bool:
    return one.path.suffix.lower() != PUNCH and bool(one.matrices)


def _geometry(geometry: Component | None, table: NodeTable | None) -> Component:
    """The component without matrices: the places of nodes are the table's if there is one."""
    if table is None and geometry is None:
        raise VehicleError(
            "found matrices without the nodes that they move: give a table of nodes (.csv) with "
            "node, x, y, z, or a file with the geometry, too"
        )
    if table is None:
        assert geometry is not None
        return replace(geometry, modes=_no_modes(len(geometry.node_ids)))
    is_node = np.ones(len(table.ids), bool) if table.masks is None else table.masks > 0
    order = np.flatnonzero(is_node)[np.argsort(table.ids[is_node], kind="stable")]
    ids, places = table.ids[order], table.places[order]
    if geometry is None:
        return Component(ids, places, {}, _no_modes(len(ids)))
    named = _restricted(geometry, ids)
    rows = rows_of(ids, named.node_ids)
    elements: dict[ElementKind, Array] = {
        kind: rows[corners] for kind, corners in named.elements.items()
    }
    return replace(
        named, node_ids=ids, nodes=places, elements=elements, modes=_no_modes(len(ids)), axes=None
    )


def _restricted(geometry: Component, ids: Array) -> Component:
    """The part of a component without modes that those nodes are."""
    kept = np.flatnonzero(np.isin(geometry.node_ids, ids))
    elements: dict[ElementKind, Array] = {}
    for kind, corners in geometry.elements.items():
        whole = corners[np.isin(corners, kept).all(axis=1)]
        if len(whole):
            elements[kind] = np.searchsorted(kept, whole)
    return replace(
        geometry,
        node_ids=geometry.node_ids[kept],
        nodes=geometry.nodes[kept],
        elements=elements,
        modes=_no_modes(len(kept)),
        axes=None if geometry.axes is None else geometry.axes[kept],
    )


def _no_modes(n_nodes: int) -> Modes:
    none = np.zeros(0)
    return Modes(none, none, none, np.zeros((n_nodes, 6, 0)))


def _component(
    mass: NamedMatrix,
    stiffness: NamedMatrix,
    geometry: Component,
    table: NodeTable | None,
    orders: Sequence[Array],
) -> Component:
    M, K = symmetric(mass), symmetric(stiffness)
    labels = _labels(mass, stiffness, table or NodeTable(geometry.node_ids, geometry.nodes), orders)
    if mass.labels is not None and stiffness.labels is not None:
        M, K = _expanded(M, mass.labels, labels), _expanded(K, stiffness.labels, labels)
    _check_mass(M, labels)
    n_given = len(geometry.node_ids)
    geometry = _restricted(geometry, labels[labels[:, 1] > 0, 0])
    n_unmoved = n_given - len(geometry.node_ids)
    matrices, n_empty = _without_empty(_matrices(M, K, labels, geometry))
    check_structure(matrices, geometry.node_ids)
    empty = f"{n_empty} degrees of freedom have neither mass nor stiffness and are left out"
    unmoved = f"{n_unmoved} nodes are none of the matrices' and are left out"
    notes = [*geometry.notes, *([empty] if n_empty else []), *([unmoved] if n_unmoved else [])]
    return replace(geometry, matrices=matrices, notes=tuple(notes))


def _labels(
    mass: NamedMatrix, stiffness: NamedMatrix, table: NodeTable, orders: Sequence[Array]
) -> Array:
    """The node and the direction of each degree of freedom, (n_dofs, 2)."""
    given = [_once(m.labels) for m in (mass, stiffness) if m.labels is not None]
    if len(given) == 2:
        return np.unique(np.concatenate(given), axis=0)
    if mass.shape != stiffness.shape:
        raise VehicleError(
            f"matrix {mass.name} has {mass.shape[0]} rows, matrix {stiffness.name} "
            f"{stiffness.shape[0]}, expected as many"
        )
    if given:
        return given[0]
    fitting = [order for order in orders if len(order) == mass.shape[0]]
    return _once(fitting[0]) if fitting else table.labels(mass.shape[0])


def _once(labels: Array) -> Array:
    """The labels of a matrix's rows as they are; raises VehicleError if two of them are the same."""
    keys = np.sort(_keys(labels))
    if len(again := keys[1:][keys[1:] == keys[:-1]]):
        node, direction = divmod(int(again[0]), 10)
        raise VehicleError(f"node {node}, direction {direction}: is there twice in a matrix")
    return labels


def _keys(labels: Array) -> Array:
    """A number for each node and direction, (n_dofs,)."""
    return np.asarray(10 * labels[:, 0] + labels[:, 1])


def _expanded(A: sp.csc_array, own: Array, labels: Array) -> sp.csc_array:
    """A matrix in more degrees of freedom than its own, which are among them."""
    place = np.searchsorted(_keys(labels), _keys(own))
    shape = (len(labels), len(own))
    S = sp.csc_array((np.ones(len(own)), (place, np.arange(len(own)))), shape=shape)
    return sp.csc_array(S @ A @ S.T)


def _check_mass(M: sp.csc_array, labels: Array) -> None:
    diagonal = M.diagonal()
    if (diagonal < 0).any():
        node, direction = labels[diagonal.argmin()]
        raise VehicleError(
            f"the mass matrix has {diagonal.min():.6g} on its diagonal at node {node}, direction "
            f"{direction}, expected no negative mass"
        )
    if not diagonal.any():
        raise VehicleError("the mass matrix has no mass on its diagonal")


def _matrices(M: sp.csc_array, K: sp.csc_array, labels: Array, geometry: Component) -> Matrices:
    """The matrices in degrees of freedom along x, y and z, and of scalars that move no node."""
    moves = np.flatnonzero(labels[:, 1] > 0)
    ids, directions = labels[moves].T
    placed = geometry.node_ids[geometry.has_place]
    missing = np.setdiff1d(ids, placed)
    if len(missing):
        raise VehicleError(
            f"the matrices move {len(missing)} nodes of which no place is known, such as "
            f"{listed(missing[:5].tolist())}: the table or the file with the geometry lacks them"
        )
    dofs = 6 * geometry.rows(ids) + directions - 1
    motion = _motion(geometry, dofs, moves, len(labels))
    return Matrices(geometry.nodes, M, K, motion, _rigid(motion, geometry.nodes))


def _motion(geometry: Component, dofs: Array, moves: Array, n_dofs: int) -> sp.csr_array:
    """How degrees of freedom move the nodes, (6 n_nodes, n_dofs), along the basic axes.

    Args:
        geometry: has the nodes, and what they take for axes.
        dofs: (n_moves,), 6 node + (0 to 5), along these.
        moves: (n_moves,), the degrees of freedom that they are; others are scalars.
        n_dofs: of all.
    """
    shape = (6 * len(geometry.node_ids), n_dofs)
    own = sp.csr_array((np.ones(len(dofs)), (dofs, moves)), shape=shape)
    if geometry.axes is None:
        return own
    return sp.csr_array(sp.block_diag(np.repeat(geometry.axes, 2, axis=0), format="csr") @ own)


def _rigid(motion: sp.csr_array, nodes: Floats) -> Floats:
    """What degrees of freedom along orthogonal directions do as the whole moves."""
    return np.asarray(motion.T @ np.nan_to_num(rigid_motions(nodes).reshape(-1, 6)))


def _without_empty(matrices: Matrices) -> tuple[Matrices, int]:
    """The matrices without degrees of freedom that nothing holds and that hold nothing."""
    K, M = matrices.stiffness, matrices.mass
    kept = np.flatnonzero((abs(K).sum(axis=0) > 0) | (abs(M).sum(axis=0) > 0))
    if len(kept) == matrices.n_dofs:
        return matrices, 0
    reduced = replace(
        matrices,
        mass=sp.csc_array(M[kept][:, kept]),
        stiffness=sp.csc_array(K[kept][:, kept]),
        motion=matrices.motion[:, kept],
        rigid=matrices.rigid[kept],
    )
    return reduced, matrices.n_dofs - len(kept)
