"""The motion of displayed vertices with their body: from generalised coordinates to drawn positions."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body, RigidBody
from modeviz.vehicle.carriers import carried, carried_by_nodes, coordinates_first

DRAWN_FRACTION = 0.025
"""A large displacement is drawn as this fraction of the vehicle's length, 0.13 m on a pickup."""

SMALL_FRACTION = 0.02
"""What has less than this of the area that is drawn may be too small, or too hidden, to go by."""

FURTHEST = 2.0
"""How many times as far as the rest something small may move: more would distort it."""

N_STEPS = 256
"""Of displacements, so that thousands of vertices need not be sorted."""


def vertex_shapes(body: Body, vertices: Floats) -> NDArray[np.float32]:
    """The displacement of every vertex in every coordinate of its body, (n_coordinates, n_vertices, 3).

    A rigid body's coordinates are x, y, z, rx, ry, rz at its centre of gravity, a flexible one's its
    modes, in which its vertices are carried by its nodes, see `carried_by_nodes`.

    Args:
        body: whose coordinates they are.
        vertices: (n_vertices, 3), m, in vehicle coordinates.
    """
    if isinstance(body, RigidBody):
        shapes = carried(np.eye(6)[None], vertices - body.center_of_gravity)
        return coordinates_first(shapes.astype(np.float32))
    return carried_by_nodes(body.nodes, body.shapes, vertices)


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
    large = _exceeded(moved, area, SMALL_FRACTION * float(area.sum()), largest / FURTHEST)
    return DRAWN_FRACTION * length / large


def _exceeded(moved: Floats, area: Floats, limit: float, least: float) -> float:
    """The largest displacement that as much area or more than a limit reaches, `least` at least.

    Vertices are counted in `N_STEPS` steps, and only those of one step are sorted.
    """
    far = np.flatnonzero(moved > least)
    if not len(far):
        return least
    moved, area = moved[far], area[far]
    largest = moved.max()
    step = np.minimum((largest - moved) * (N_STEPS / (largest - least)), N_STEPS - 1).astype(np.int64)
    reached = np.bincount(step, area, N_STEPS).cumsum()
    last = int(np.searchsorted(reached, limit, side="right"))
    if last == N_STEPS:
        return least
    inside = np.flatnonzero(step == last)
    inside = inside[np.argsort(-moved[inside])]
    before = reached[last - 1] if last else 0.0
    exceeds = before + area[inside].cumsum() > limit
    return float(moved[inside[exceeds.argmax() if exceeds.any() else -1]])


def _dot(u: Array, v: Array) -> Array:
    """u·v of every vertex, (n_vertices,); far faster by column than along an axis of three."""
    return u[:, 0] * v[:, 0] + u[:, 1] * v[:, 1] + u[:, 2] * v[:, 2]
