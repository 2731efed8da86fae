"""STL, binary and text: triangles and nothing else (3D Systems, 1989)."""

import re

import numpy as np

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.limits import LARGEST_TEXT, MOST_POINTS, check_size
from modeviz.files.mesh_formats.parts import RawPart, merged, numbers
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material

HEADER = 84
"""Bytes before the faces of a binary file; the last four count them."""

FACE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

VERTEX = re.compile(rb"\bvertex((?:\s+[-+.0-9e]+){3})")
"""A vertex with its coordinates, in small letters."""

LONGEST_END = 10_000
"""Bytes in which the last line of a text file has to be."""


def read_stl(content: bytes, plain: Material) -> list[RawPart]:
    """The one part of a file, its vertices merged where they are the same.

    Raises:
        VehicleError: it is cut, damaged or too large.
    """
    n_faces = int.from_bytes(content[80:HEADER], "little")
    is_binary = len(content) == HEADER + n_faces * FACE.itemsize
    if not is_binary and content.lstrip()[:5].lower() == b"solid":
        corners = _text_corners(content)
    else:
        corners = _binary_corners(content, n_faces)
    if not len(corners):
        return []
    vertices, faces = merged(corners)
    return [RawPart("", vertices, faces, plain)]


def _binary_corners(content: bytes, n_faces: int) -> Floats:
    """(3 n_faces, 3)."""
    if len(content) < HEADER:
        raise VehicleError("found neither a text that begins with 'solid' nor a binary STL's header")
    n_found = (len(content) - HEADER) // FACE.itemsize
    if n_found < n_faces:
        raise VehicleError(f"is cut: found {n_found} of its {n_faces} faces")
    check_size("faces", n_faces, MOST_POINTS)
    corners = np.frombuffer(content, FACE, n_faces, HEADER)["corners"].reshape(-1, 3)
    return corners.astype(float)


def _text_corners(content: bytes) -> Floats:
    """(3 n_faces, 3)."""
    check_size("bytes of text", len(content), LARGEST_TEXT)
    text = content.lower()
    n_vertices = text.count(b"vertex")
    check_size("faces", n_vertices // 3, MOST_POINTS)
    if b"endsolid" not in text[-LONGEST_END:]:
        raise VehicleError("is cut: found no 'endsolid' at its end")
    found = numbers(b" ".join(VERTEX.findall(text)))
    if n_vertices % 3 or len(found) != 3 * n_vertices:
        raise VehicleError(
            f"found {len(found)} coordinates of {n_vertices} vertices, expected three of each, and "
            "three vertices of each face"
        )
    return found.reshape(-1, 3)
