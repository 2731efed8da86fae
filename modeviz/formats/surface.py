"""The display mesh of a component: outer faces of elements, lines as thin tubes, or the nodes alone."""

from collections.abc import Mapping

import numpy as np

from modeviz.formats.component import Component, ElementKind
from modeviz.shapes.points import octahedra
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Material, Mesh, MeshPart

COLOR = (150, 156, 164)
"""sRGB, of what another program gave no look to."""

TUBE, POINT = 0.003, 0.006
"""Radius of a line and of a node, parts of the largest dimension."""

FACES: Mapping[ElementKind, tuple[tuple[int, ...], ...]] = {
    "triangle": ((0, 1, 2),),
    "quad": ((0, 1, 2, 3),),
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "hexa": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}
"""The corners of each face, seen from outside against the clock."""

MOST_POINTS = 12_500
"""Nodes that are drawn as points, of eight faces each."""

SHELLS = ("triangle", "quad")


def display_mesh(component: Component, length: float) -> tuple[Mesh, Array]:
    """Return the parts to draw of a component, in m, its surface and its lines, and the nodes in them.

    Elements with a corner that has no place are left out. Where nothing is left, nodes are drawn, every
    so many of more than `MOST_POINTS`.

    Args:
        component: what to draw.
        length: m of one of its units.
    """
    placed = component.has_place
    elements: dict[ElementKind, Array] = {
        kind: corners[placed[corners].all(axis=1)] for kind, corners in component.elements.items()
    }
    nodes = component.nodes * length
    material = Material(COLOR)
    parts, drawn = [], [np.zeros(0, int)]
    if len(faces := outer_triangles(elements)):
        used, compact = np.unique(faces, return_inverse=True)
        drawn.append(used)
        parts.append(MeshPart("surface", nodes[used], compact.reshape(-1, 3), material))
    lines = elements.get("line", np.zeros((0, 2), int))
    lines = lines[np.linalg.norm(nodes[lines[:, 0]] - nodes[lines[:, 1]], axis=1) > 0]
    size = float(np.ptp(nodes[placed], axis=0).max()) if placed.any() else 0.0
    if len(lines):
        drawn.append(lines.ravel())
        parts.append(MeshPart("lines", *tubes(nodes[lines], TUBE * size), material))
    if not parts and size:
        shown = np.flatnonzero(placed)
        shown = shown[:: -(-len(shown) // MOST_POINTS)]
        drawn.append(shown)
        parts.append(MeshPart("nodes", *octahedra(nodes[shown], POINT * size), material))
    return tuple(parts), np.unique(np.concatenate(drawn))


def outer_triangles(elements: Mapping[ElementKind, Array]) -> Array:
    """Return the faces of shells, and those of solids that no other solid shares, (n, 3).

    Args:
        elements: by kind, the rows of their corners.
    """
    shells = [elements[kind] for kind in SHELLS if kind in elements]
    solid: dict[int, list[Array]] = {3: [], 4: []}
    for kind, corners in elements.items():
        for face in FACES.get(kind, ()) if kind not in SHELLS else ():
            solid[len(face)].append(corners[:, face])
    outer = [_unshared(np.concatenate(faces)) for faces in solid.values() if faces]
    return np.concatenate([np.zeros((0, 3), int), *map(_triangles, (*shells, *outer))])


def _unshared(faces: Array) -> Array:
    """Those of some faces that are there once."""
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[np.sort(first[counts == 1])]


def _triangles(faces: Array) -> Array:
    """Triangles as they are, quadrangles cut in two."""
    if faces.shape[1] == 3:
        return faces
    return np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def tubes(ends: Floats, radius: float) -> tuple[Floats, Array]:
    """Return vertices and faces of a tube with three sides around each line.

    Args:
        ends: (n_lines, 2, 3), m, apart from each other.
        radius: m.
    """
    along = ends[:, 1] - ends[:, 0]
    along = along / np.linalg.norm(along, axis=1, keepdims=True)
    first = np.cross(along, np.eye(3)[np.abs(along).argmin(axis=1)])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(along, first)
    angles = np.arange(3) * 2 * np.pi / 3
    around = radius * (
        np.cos(angles)[:, None] * first[:, None] + np.sin(angles)[:, None] * second[:, None]
    )
    vertices = (ends[:, :, None] + around[:, None]).reshape(-1, 3)
    sides = [[i, (i + 1) % 3, (i + 1) % 3 + 3, i + 3] for i in range(3)]
    faces = _triangles(np.array(sides)) + 6 * np.arange(len(ends))[:, None, None]
    return vertices, faces.reshape(-1, 3)
