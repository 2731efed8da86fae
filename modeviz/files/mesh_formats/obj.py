"""OBJ: the faces of a file as one part; its materials are in other files and are not read."""

import re

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.limits import LARGEST_TEXT, MOST_POINTS, check_size
from modeviz.files.mesh_formats.parts import RawPart, fans, numbers, used
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material

BEYOND_PLACE = re.compile(rb"/[^ \t\n]*")
"""What follows the number of a corner's vertex: those of its texture and normal."""


def read_obj(content: bytes, plain: Material) -> list[RawPart]:
    """The one part of a file.

    Raises:
        VehicleError: it is damaged or too large.
    """
    check_size("bytes of text", len(content), LARGEST_TEXT)
    vertices, faces, n_before = _lines(content.replace(b"\r", b"").replace(b"\\\n", b" "))
    check_size("vertices", len(vertices), MOST_POINTS)
    check_size("faces", len(faces), MOST_POINTS)
    text = BEYOND_PLACE.sub(b"", b"\n".join(faces))
    corners = numbers(text)
    check_size("corners of faces", len(corners), 3 * MOST_POINTS)
    if not len(corners):
        return []
    counts = np.array([len(face.split()) for face in text.split(b"\n")])
    indices = _indices(corners, np.repeat(n_before, counts), len(vertices))
    drawn, numbered = used(np.arange(len(vertices)), fans(counts, indices))
    places = numbers(b" ".join(b" ".join(vertices[i].split(None, 3)[:3]) for i in drawn.tolist()))
    if len(places) != 3 * len(drawn):
        raise VehicleError("found a vertex without three coordinates")
    return [RawPart("", places.reshape(-1, 3), numbered, plain)]


def _lines(text: bytes) -> tuple[list[bytes], list[bytes], list[int]]:
    """The lines of vertices and of faces, and for each face how many vertices stand before it."""
    vertices: list[bytes] = []
    faces: list[bytes] = []
    n_before: list[int] = []
    for line in text.split(b"\n"):
        kind, _, rest = line.lstrip().replace(b"\t", b" ").partition(b" ")
        if kind == b"v":
            vertices.append(rest)
        elif kind == b"f":
            faces.append(rest)
            n_before.append(len(vertices))
    return vertices, faces, n_before


def _indices(corners: Floats, n_before: NDArray[np.int64], n_vertices: int) -> NDArray[np.int64]:
    """Corners, counted from one or back from the last vertex before, as indices of vertices."""
    indices = np.where(corners < 0, n_before + corners, corners - 1)
    wrong = ~((indices >= 0) & (indices < n_vertices))
    if wrong.any():
        raise VehicleError(f"a face names vertex {corners[wrong][0]:g}; there are {n_vertices}")
    return indices.astype(np.int64)
