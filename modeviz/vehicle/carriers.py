"""The motion of places on a body that are carried along by the nodes around them."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from modeviz.vehicle.arrays import Array, Floats

F = TypeVar("F", np.float32, np.float64)

N_CARRIERS = 8
"""How many nodes carry a place: those at the corners of the solid element around it."""

SAME_PLACE = 1e-6
"""m: a place this close to a node is that node."""

ALL_ALIKE = 1e-9
"""How much further than they are, relatively, nodes reach that are all at the same distance."""

N_NEIGHBOURS = 8
"""How many nodes around a node tell how it turns: those of a grid of shells."""

COLLINEAR = 1e-6
"""Relative: nodes that are no wider than this are on a line, about which they are not seen to turn."""


def carried_by_nodes(nodes: Floats, motions: Array, places: Floats) -> NDArray[np.float32]:
    """Return the displacement of places that follow their nearest nodes, (n_coordinates, n_places, 3).

    Each node would carry a place along rigidly, u + θ x r, and the place takes the mean of the nearest
    ones, weighted by (1/r - 1/R)² where R is as far as the next node is (R. Franke and G. Nielson,
    "Smooth interpolation of large sets of scattered data", 1980). That is exact where a place is a node
    and wherever all moves rigidly, and nothing tears: a node's weight is zero where another takes over.
    Nodes that have no rotations in a coordinate turn in it as the nodes around them say.

    Args:
        nodes: (n_nodes, 3), m.
        motions: (n_nodes, 6, n_coordinates), real: of the nodes in every coordinate.
        places: (n_places, 3), m.
    """
    return coordinates_first(_mean_carried(nodes, motions, places, carried, 3, np.float32))


def motions_by_nodes(nodes: Floats, motions: Array, places: Floats) -> Floats:
    """Return the six motions of such places, (n_places, 6, n_coordinates): they turn as their nodes do.

    Args:
        nodes: (n_nodes, 3), m; one or more.
        motions: (n_nodes, 6, n_coordinates), real.
        places: (n_places, 3), m.
    """
    return _mean_carried(nodes, motions, places, _all_carried, 6, np.float64)


def carried(shapes: Array, offset: Floats) -> Array:
    """Six motions of a point carried to places `offset` away, u + θ x r: (n, 3, n_coordinates)."""
    translation, rotation = shapes[:, :3], shapes[:, 3:]
    return translation + np.cross(rotation, offset[..., None].astype(shapes.dtype), axis=1)


def _all_carried(shapes: Array, offset: Floats) -> Array:
    """The same with how they turn: (n, 6, n_coordinates)."""
    return np.concatenate([carried(shapes, offset), shapes[:, 3:]], axis=1)


def _mean_carried(
    nodes: Floats,
    motions: Array,
    places: Floats,
    carry: Callable[[Array, Floats], Array],
    n_rows: int,
    dtype: type[F],
) -> NDArray[F]:
    """What the nearest nodes make of each place, weighted, (n_places, n_rows, n_coordinates).

    As exact as the type is, whatever that of the motions, so that it has derivatives to the places.
    """
    nearest, weights = _carriers(nodes, places)
    used, rows = np.unique(nearest, return_inverse=True)
    moved = _turned(nodes, motions, used).astype(dtype)
    total = np.zeros((len(places), n_rows, motions.shape[2]), dtype)
    for row, node, weight in zip(rows.reshape(nearest.shape).T, nearest.T, weights.T, strict=True):
        total += weight[:, None, None] * carry(moved[row], places - nodes[node])
    return total


def coordinates_first(shapes: NDArray[np.float32]) -> NDArray[np.float32]:
    """Contiguous by coordinate: a displacement is then found in less than half the time."""
    return np.ascontiguousarray(np.moveaxis(shapes, -1, 0))


def _carriers(nodes: Floats, places: Floats) -> tuple[NDArray[np.intp], Floats]:
    """The nodes that carry each place and their weights, (n_places, n_carriers), rows sum to one."""
    n_found = min(N_CARRIERS + 1, len(nodes))
    found = KDTree(nodes).query(places, k=n_found)
    distance, nearest = (np.reshape(f, (len(places), n_found)) for f in found)
    near = np.maximum(distance, SAME_PLACE)
    if n_found <= N_CARRIERS:
        weights = 1 / near**2
    else:
        reach = near[:, -1:] * (1 + ALL_ALIKE)
        nearest, weights = nearest[:, :-1], (1 / near[:, :-1] - 1 / reach) ** 2
    at_node = distance[:, 0] < SAME_PLACE
    weights[at_node] = distance[at_node, : weights.shape[1]] < SAME_PLACE
    return nearest, weights / weights.sum(axis=1, keepdims=True)


def _turned(nodes: Floats, motions: Array, used: NDArray[np.intp]) -> Array:
    """The motions of some nodes, (n_used, 6, n_coordinates), with rotations in every coordinate."""
    still = ~motions[:, 3:].any(axis=(0, 1))
    moved = motions[used]
    if len(nodes) > 1 and still.any():
        moved[:, 3:, still] = _rotations(nodes, motions[:, :3, still], used)
    return moved


def _rotations(nodes: Floats, translations: Array, used: NDArray[np.intp]) -> Array:
    """The rotations of some nodes by the translations of those around them, (n_used, 3, n_coordinates).

    Those that fit best: θ minimises Σ |u_j - u - θ x d_j|²/|d_j|² over neighbours at d_j, so that
    Σ (I - d dᵀ/d²) θ = Σ d x (u_j - u)/d². About a line of nodes it is zero.
    """
    n_found = min(N_NEIGHBOURS + 1, len(nodes))
    _, around = KDTree(nodes).query(nodes[used], k=n_found)
    total = np.zeros((len(used), 3, translations.shape[2]))
    matrix = np.zeros((len(used), 3, 3))
    for other in np.transpose(around):
        d = nodes[other] - nodes[used]
        square = np.sum(d**2, axis=1)[:, None]
        scaled = np.divide(d, square, out=np.zeros_like(d), where=square > SAME_PLACE**2)
        matrix += (d * scaled).sum(axis=1)[:, None, None] * np.eye(3) - d[:, :, None] * scaled[:, None]
        total += np.cross(scaled[:, :, None], translations[other] - translations[used], axis=1)
    return np.linalg.pinv(matrix, COLLINEAR, hermitian=True) @ total
