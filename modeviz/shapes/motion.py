"""The motion of displayed vertices with their body: from generalised coordinates to drawn positions."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import KDTree

from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body, RigidBody

N_CARRIERS = 4
"""How many nodes carry a vertex."""

SAME_PLACE = 1e-6
"""m: a vertex this close to a node is that node."""

DRAWN_FRACTION = 0.025
"""A large displacement is drawn as this fraction of the vehicle's length, 0.13 m on a pickup."""

SMALL_FRACTION = 0.02
"""What has less than this of the area that is drawn may be too small, or too hidden, to go by."""

FURTHEST = 2.0
"""How many times as far as the rest something small may move: more would distort it."""


def vertex_shapes(body: Body, vertices: Floats) -> NDArray[np.float32]:
    """The displacement of every vertex in every coordinate of its body, (n_coordinates, n_vertices, 3).

    A rigid body's coordinates are x, y, z, rx, ry, rz at its centre of gravity, a flexible one's its
    modes. The vertices of a flexible body follow its nearest nodes: each would carry the vertex along
    rigidly, u + θ x r, and the vertex takes their mean weighted by 1/|r|² (D. Shepard, "A
    two-dimensional interpolation function for irregularly-spaced data", 1968). That is exact where
    a vertex is a node and wherever the body moves rigidly.

    Args:
        body: whose coordinates they are.
        vertices: (n_vertices, 3), m, in vehicle coordinates.
    """
    if isinstance(body, RigidBody):
        shapes = _carried(np.eye(6)[None], vertices - body.center_of_gravity)
        return _coordinates_first(shapes.astype(np.float32))
    return node_carried_shapes(body.nodes, body.shapes, vertices)


def node_carried_shapes(nodes: Floats, motions: Array, vertices: Floats) -> NDArray[np.float32]:
    """The displacement of every vertex that follows its nearest nodes, as `vertex_shapes` does.

    Args:
        nodes: (n_nodes, 3), m.
        motions: (n_nodes, 6, n_coordinates), real: of the nodes in every coordinate.
        vertices: (n_vertices, 3), m.
    """
    nearest, weights = _carriers(nodes, vertices)
    shapes = np.zeros((len(vertices), 3, motions.shape[2]), np.float32)
    for node, weight in zip(nearest.T, weights.T, strict=True):
        shapes += weight[:, None, None] * _carried(motions[node], vertices - nodes[node])
    return _coordinates_first(shapes)


def displacement(shapes: NDArray[np.float32], coordinates: ArrayLike) -> Array:
    """The displacement of every vertex, (n_vertices, 3), real or complex as the coordinates are.

    Args:
        shapes: (n_coordinates, n_vertices, 3), from `vertex_shapes`.
        coordinates: (n_coordinates,): one mode or response of the vehicle, this body's part of it.
    """
    q = np.asarray(coordinates)
    if np.iscomplexobj(q):
        return displacement(shapes, np.real(q)) + 1j * displacement(shapes, np.imag(q))
    return (q.astype(np.float32) @ shapes.reshape(len(q), -1)).reshape(shapes.shape[1:])


def peak_displacement(shape: Array) -> Floats:
    """The largest distance of every vertex from its place during a cycle, (n_vertices,).

    A vertex runs around an ellipse, whose longer half axis is √((u·ū + |u·u|)/2); √(u·u) if u is real.
    """
    u = np.asarray(shape)
    if np.isrealobj(u):
        return np.sqrt(_dot(u, u))
    return np.sqrt((np.real(_dot(u, np.conj(u))) + np.abs(_dot(u, u))) / 2)


def mean_square(shape: Array) -> Floats:
    """u·ū of every vertex, (n_vertices,): |u|² if u is real, else twice the mean of a cycle."""
    return np.real(_dot(shape, np.conj(shape)))


def default_amplitude(shapes: Sequence[Array], areas: Sequence[Floats], length: float) -> float:
    """The factor that draws a shape clearly and without distortion.

    It goes by the displacement that only `SMALL_FRACTION` of the area exceeds, but draws nothing
    `FURTHEST` times as far.

    Args:
        shapes: of every drawn body, (n_vertices, 3) each.
        areas: that their vertices stand for, (n_vertices,) each, m².
        length: of the vehicle, m.
    """
    moved = np.concatenate([np.zeros(0), *map(peak_displacement, shapes)])
    area = np.concatenate([np.zeros(0), *areas])
    largest = float(moved.max(initial=0.0))
    if largest == 0:
        return 0.0
    least = largest / FURTHEST
    far = moved > least  # only these are worth the sorting
    order = np.flatnonzero(far)[np.argsort(-moved[far])]
    exceeded = area[order].cumsum() > SMALL_FRACTION * area.sum()
    large = float(moved[order][exceeded.argmax()]) if exceeded.any() else least
    return DRAWN_FRACTION * length / large


def _carriers(nodes: Floats, vertices: Floats) -> tuple[NDArray[np.intp], Floats]:
    """The nodes that carry each vertex and their weights, (n_vertices, n_carriers), rows sum to one."""
    n_carriers = min(N_CARRIERS, len(nodes))
    found = KDTree(nodes).query(vertices, k=n_carriers)
    distance, nearest = (np.reshape(f, (len(vertices), n_carriers)) for f in found)
    weights = 1 / np.maximum(distance, SAME_PLACE) ** 2
    coincident = distance[:, 0] < SAME_PLACE
    weights[coincident] = 0
    weights[coincident, 0] = 1
    return nearest, weights / weights.sum(axis=1, keepdims=True)


def _carried(shapes: Array, offset: Floats) -> Array:
    """Six motions of a point carried to places `offset` away, u + θ x r: (n, 3, n_coordinates)."""
    translation, rotation = shapes[:, :3], shapes[:, 3:]
    return translation + np.cross(rotation, offset[..., None].astype(shapes.dtype), axis=1)


def _dot(u: Array, v: Array) -> Array:
    """u·v of every vertex, (n_vertices,); far faster by column than along an axis of three."""
    return u[:, 0] * v[:, 0] + u[:, 1] * v[:, 1] + u[:, 2] * v[:, 2]


def _coordinates_first(shapes: NDArray[np.float32]) -> NDArray[np.float32]:
    """Contiguous by coordinate: a displacement is then found in less than half the time."""
    return np.ascontiguousarray(np.moveaxis(shapes, -1, 0))
