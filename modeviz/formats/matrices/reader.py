"""Mass, stiffness and nodes, each in whichever file, as a component."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, listed, located
from modeviz.fem.matrices import Matrices
from modeviz.files.disk import opened
from modeviz.formats.component import Component, Modes
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.matrices.abaqus import read_abaqus
from modeviz.formats.matrices.arrays import read_npz
from modeviz.formats.matrices.market import BEGINNING, read_market
from modeviz.formats.matrices.named import NamedMatrix, mass_and_stiffness, symmetric
from modeviz.formats.matrices.node_table import NodeTable, read_node_table
from modeviz.formats.matrices.soundness import check_structure
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.rigid import rigid_motions


def _read_mtx(path: Path) -> list[NamedMatrix]:
    """The matrices of a file of Matrix Market or of Abaqus, which end alike."""
    with opened(path, LARGEST_FILE) as file:
        is_market = file.read(len(BEGINNING)) == BEGINNING
    return read_market(path) if is_market else read_abaqus(path)


READERS: Mapping[str, Callable[[Path], list[NamedMatrix]]] = {".npz": read_npz, ".mtx": _read_mtx}
"""By the ending of a file's name."""

TABLES = (".csv", ".txt")
"""Endings of node tables."""

SUFFIXES = (*READERS, *TABLES)


def read_matrices(paths: Sequence[Path], geometry: Component | None) -> Component:
    """Return the component of mass and stiffness matrices and of the nodes that they move.

    Args:
        paths: of matrices and, if wanted, of a node table.
        geometry: places of nodes, and elements to draw, from other files.

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
    with located(", ".join(map(str, paths))):
        mass, stiffness, others = mass_and_stiffness(found)
        geometry = _geometry(geometry, table)
        component = _component(mass, stiffness, geometry, table)
    left_out = f"the matrices {listed(others)} are left out: neither mass nor stiffness"
    notes = (*geometry.notes, *component.notes, *([left_out] if others else []))
    return replace(component, notes=notes)


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
    nodes = Component(table.ids[order], table.places[order], {}, _no_modes(len(order)))
    if geometry is None:
        return nodes
    elements = {
        kind: corners[np.isin(geometry.node_ids[corners], nodes.node_ids).all(axis=1)]
        for kind, corners in geometry.elements.items()
    }
    rows = {kind: nodes.rows(geometry.node_ids[corners]) for kind, corners in elements.items()}
    return replace(nodes, elements=rows, units=geometry.units, notes=geometry.notes)


def _no_modes(n_nodes: int) -> Modes:
    none = np.zeros(0)
    return Modes(none, none, none, np.zeros((n_nodes, 6, 0)))


def _component(
    mass: NamedMatrix, stiffness: NamedMatrix, geometry: Component, table: NodeTable | None
) -> Component:
    M, K = symmetric(mass), symmetric(stiffness)
    labels = _labels(mass, stiffness, geometry, table)
    if mass.labels is not None and stiffness.labels is not None:
        M, K = _expanded(M, mass.labels, labels), _expanded(K, stiffness.labels, labels)
    _check_mass(M, labels)
    matrices, n_empty = _without_empty(_matrices(M, K, labels, geometry))
    check_structure(matrices, geometry.node_ids)
    notes = []
    if n_empty:
        notes.append(f"{n_empty} degrees of freedom have neither mass nor stiffness and are left out")
    return replace(geometry, matrices=matrices, notes=tuple(notes))


def _labels(
    mass: NamedMatrix, stiffness: NamedMatrix, geometry: Component, table: NodeTable | None
) -> Array:
    """The node and the direction of each degree of freedom, (n_dofs, 2)."""
    if mass.labels is not None and stiffness.labels is not None:
        return np.unique(np.concatenate([mass.labels, stiffness.labels]), axis=0)
    if mass.shape != stiffness.shape:
        raise VehicleError(
            f"matrix {mass.name} has {mass.shape[0]} rows, matrix {stiffness.name} "
            f"{stiffness.shape[0]}, expected as many"
        )
    known = mass.labels if mass.labels is not None else stiffness.labels
    if known is not None:
        return known
    return (table or NodeTable(geometry.node_ids, geometry.nodes)).labels(mass.shape[0])


def _expanded(A: sp.csc_array, own: Array, labels: Array) -> sp.csc_array:
    """A matrix in more degrees of freedom than its own, which are among them."""
    keys, wanted = (array[:, 0] * 10 + array[:, 1] for array in (own, labels))
    if len(np.unique(keys)) != len(keys):
        raise VehicleError("a degree of freedom is there twice in a matrix")
    place = np.searchsorted(wanted, keys)
    n = len(labels)
    S = sp.csc_array((np.ones(len(keys)), (place, np.arange(len(keys)))), shape=(n, len(keys)))
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
    if len(np.unique(dofs)) != len(dofs):
        dof = np.sort(dofs)[:-1][np.diff(np.sort(dofs)) == 0][0]
        raise VehicleError(
            f"node {geometry.node_ids[dof // 6]}, direction {dof % 6 + 1}: is there twice"
        )
    shape = (6 * len(geometry.node_ids), len(labels))
    motion = sp.csr_array((np.ones(len(dofs)), (dofs, moves)), shape=shape)
    return Matrices(geometry.nodes, M, K, motion, _rigid(motion, geometry.nodes))


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
