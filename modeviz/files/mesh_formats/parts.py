"""Parts of a display mesh, made of the triangles of a file."""

import warnings
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Material, Mesh, MeshPart


@dataclass(frozen=True, eq=False)
class RawPart:
    """The triangles that a file has of one material."""

    name: str
    vertices: Array
    """(n_vertices, 3), m."""
    faces: Array
    """(n_faces, 3), indices of vertices."""
    material: Material


@dataclass(frozen=True, eq=False)
class RawMesh:
    """What a file has of a surface."""

    parts: Sequence[RawPart]
    length: float | None = None
    """m of one of its units, if it says so."""
    up: Floats | None = None
    """(3, 3): what turns its axes so that z is up, if it says which of them is."""

    def placed(self, length: float | None, turn: Floats | None, usual: float) -> Mesh:
        """The display mesh.

        Args:
            length: m of one unit; None: as the file says.
            turn: (3, 3), of its axes; None: what makes z up, if the file says that.
            usual: m of one unit, where nothing says it.
        """
        unit = length or self.length or usual
        T = turn if turn is not None else self.up
        return mesh([replace(p, vertices=_turned(p.vertices, T) * unit) for p in self.parts])


def _turned(vertices: Array, T: Floats | None) -> Array:
    return vertices if T is None else vertices @ T.T


def mesh(parts: Sequence[RawPart]) -> Mesh:
    """The parts as a display mesh, each with a name of its own: "door", "door 2"."""
    names = _told_apart([part.name or "part" for part in parts])
    return tuple(
        MeshPart(name, part.vertices, part.faces, part.material)
        for name, part in zip(names, parts, strict=True)
    )


def _told_apart(names: Sequence[str]) -> list[str]:
    """The names, those that were there before with a number that makes them new."""
    taken, seen, found = set(names), set[str](), []
    numbers: defaultdict[str, Iterator[int]] = defaultdict(lambda: count(2))
    for name in names:
        new = name
        while new in seen or (new != name and new in taken):
            new = f"{name} {next(numbers[name])}"
        seen.add(new)
        found.append(new)
    return found


def used(vertices: Array, faces: Array) -> tuple[Array, Array]:
    """The vertices that faces name, in their order, and the faces that name them.

    Args:
        vertices: (n_vertices, ...).
        faces: (n_faces, 3), indices of vertices that exist.
    """
    kept, inverse = np.unique(faces, return_inverse=True)
    return vertices[kept], inverse.reshape(-1, 3)


def fans(counts: NDArray[np.int64], corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """The triangles of polygons, each a fan around its first corner, (n_faces, 3).

    Args:
        counts: (n_polygons,), how many corners each has; those with fewer than three have no face.
        corners: the indices of vertices, polygon after polygon.
    """
    n_faces = np.maximum(counts - 2, 0)
    first = np.repeat(np.cumsum(counts) - counts, n_faces)
    number = np.arange(n_faces.sum()) - np.repeat(np.cumsum(n_faces) - n_faces, n_faces)
    places = np.stack([first, first + number + 1, first + number + 2], axis=1)
    return corners[places]


def merged(corners: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """The different ones of many corners, (n_vertices, 3), and the faces of each three of them."""
    bits = (corners + 0.0).view(np.uint64)  # makes -0 the same as 0
    bits ^= bits >> np.uint64(29)  # numbers of single precision have no lower bits
    keys = bits @ np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], np.uint64)
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    vertices, faces = corners[first], inverse.reshape(-1, 3)
    if np.array_equal(vertices[faces.ravel()], corners):
        return vertices, faces
    return corners, np.arange(len(corners)).reshape(-1, 3)  # two places share a key, by a rare chance


def numbers(text: bytes) -> Floats:
    """The numbers of a text with nothing but white space between them.

    Raises:
        VehicleError: there is something else.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)  # NumPy's way to say that it stopped
        try:
            return np.fromstring(text, sep=" ") if text.strip() else np.zeros(0)
        except (DeprecationWarning, ValueError):
            raise VehicleError("found something that is not a number among the numbers") from None
