"""The lines that make a shaded surface readable: its borders and folds."""

import numpy as np
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Array, Floats

FOLD = np.radians(25)
"""Two faces that meet at more than this angle make a visible line."""

WELD = 2e-6
"""Of the furthest coordinate: vertices closer than this are one corner; single precision is finer."""


def feature_edges(vertices: Floats, faces: Array) -> NDArray[np.int32]:
    """The border and fold edges of a triangulated surface, (n_edges, 2), indices of vertices.

    Which way round a face is numbered does not matter.

    Args:
        vertices: (n_vertices, 3), m.
        faces: (n_faces, 3), indices of vertices.
    """
    corners = welded(vertices)[faces]
    normals = _unit_normals(vertices[corners])
    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]], axis=-1).reshape(-1, 2)
    of_face = np.repeat(np.arange(len(faces)), 3)
    unique, inverse, counts = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    first, last = _first_and_last(inverse.reshape(-1))
    bend = np.abs(np.sum(normals[of_face[first]] * normals[of_face[last]], axis=1))
    visible = (counts != 2) | (bend < np.cos(FOLD))
    return unique[visible & (unique[:, 0] != unique[:, 1])].astype(np.int32)


def welded(vertices: Floats) -> NDArray[np.intp]:
    """For every vertex the first one that lies in its place, (n_vertices,)."""
    step = WELD * np.abs(vertices).max(initial=0.0) or 1.0
    places = np.round(vertices / step).astype(np.int64)
    _, first, inverse = np.unique(places, axis=0, return_index=True, return_inverse=True)
    return first[inverse.reshape(-1)]


def _unit_normals(triangles: Floats) -> Floats:
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.where(length > 0, length, 1)


def _first_and_last(groups: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """The first and the last position of every group number in `groups`."""
    _, first = np.unique(groups, return_index=True)
    _, last = np.unique(groups[::-1], return_index=True)
    return first, len(groups) - 1 - last
