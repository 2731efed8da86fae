"""The drawn surface of a body: its parts on one set of vertices, so that one shape moves them all."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.shapes.edges import feature_edges
from modeviz.shapes.simplify import simplified
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material, Mesh

SKIN_FRACTION = 0.15
"""A part with at least this share of a body's area is its skin; what is smaller dresses it."""


@dataclass(frozen=True, eq=False)
class Patch:
    """The faces of one material."""

    material: Material
    faces: NDArray[np.int32]
    """(n_faces, 3), indices of the surface's vertices."""
    is_skin: bool
    """Whether it takes the body's colours and transparency; dressing keeps its own."""


@dataclass(frozen=True, eq=False)
class Surface:
    """A body's drawn surface."""

    vertices: Floats
    """(n_vertices, 3), m."""
    patches: tuple[Patch, ...]
    edges: NDArray[np.int32]
    """(n_edges, 2): the borders and folds of the skin, indices of vertices."""


def surface(mesh: Mesh) -> Surface:
    """The drawn surface of a display mesh; its vertices are those of the parts, one after the other.

    A mesh of very many faces is made coarser, see `simplified`.
    """
    mesh = simplified(mesh)
    starts = np.cumsum([0, *(len(part.vertices) for part in mesh)])
    areas = np.array([_face_areas(part.vertices, part.faces).sum() for part in mesh])
    skin = areas >= SKIN_FRACTION * areas.sum()
    patches = [
        Patch(part.material, part.faces + np.int32(start), bool(is_skin))
        for part, start, is_skin in zip(mesh, starts, skin, strict=False)
    ]
    edges = [
        feature_edges(part.vertices, part.faces) + np.int32(start)
        for part, start, is_skin in zip(mesh, starts, skin, strict=False)
        if is_skin and part.material.opacity == 1
    ]
    return Surface(
        np.concatenate([np.zeros((0, 3)), *(part.vertices for part in mesh)]),
        tuple(patches),
        np.concatenate([np.zeros((0, 2), np.int32), *edges]),
    )


def outlines(drawn: Surface) -> tuple[Surface, NDArray[np.int32]]:
    """The edges of a surface alone, and which of its vertices they have kept, (n_kept,)."""
    kept, edges = np.unique(drawn.edges, return_inverse=True)
    reduced = edges.reshape(-1, 2).astype(np.int32)
    return Surface(drawn.vertices[kept], (), reduced), kept


def vertex_areas(drawn: Surface) -> Floats:
    """The area that every vertex stands for, a third of that of its faces, (n_vertices,), m²."""
    areas = np.zeros(len(drawn.vertices))
    for patch in drawn.patches:
        thirds = np.repeat(_face_areas(drawn.vertices, patch.faces) / 3, 3)
        areas += np.bincount(patch.faces.ravel(), thirds, len(areas))
    return areas


def _face_areas(vertices: Floats, faces: NDArray[np.int32]) -> Floats:
    a, b, c = np.moveaxis(vertices[faces], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
