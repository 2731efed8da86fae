"""PLY, text and binary: one triangulated surface, with its colour if it has one (G. Turk, 1994)."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.limits import LARGEST_TEXT, MOST_POINTS, check_size
from modeviz.files.mesh_formats.parts import RawPart, fans, used
from modeviz.files.mesh_formats.ply_columns import Columns, lines_of, read_columns
from modeviz.files.mesh_formats.ply_header import read_header
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Material
from modeviz.vehicle.srgb import linear_to_srgb, srgb_to_linear

CORNERS = ("vertex_indices", "vertex_index")
COLOR = ("red", "green", "blue")


def read_ply(content: bytes, plain: Material) -> list[RawPart]:
    """The one part of a file; the colours of its vertices or faces are averaged.

    Raises:
        VehicleError: it is cut, damaged or too large.
    """
    order, elements, body = read_header(content)
    for element in elements:
        check_size(f"items of the element {element.name}", element.count, MOST_POINTS)
    if order:
        found = read_columns(elements, np.frombuffer(body, np.uint8), None)
    else:
        check_size("bytes of text", len(content), LARGEST_TEXT)
        found = read_columns(elements, *lines_of(body))
    vertex, face = found.get("vertex", {}), found.get("face", {})
    corners = next((face[name] for name in CORNERS if name in face), None)
    if corners is None:
        return []
    check_size("corners of faces", int(corners.lengths.sum()), 3 * MOST_POINTS)
    if not {"x", "y", "z"} <= set(vertex):
        raise VehicleError("found vertices without x, y and z")
    vertices = np.stack([vertex[axis].values.astype(float) for axis in "xyz"], axis=1)
    faces = fans(corners.lengths, _indices(corners.values, len(vertices)))
    if not len(faces):
        return []
    drawn, numbered = used(np.arange(len(vertices)), faces)
    material = _material(vertex, drawn, plain) if set(COLOR) <= set(vertex) else plain
    if set(COLOR) <= set(face):
        material = _material(face, np.arange(len(corners.lengths)), plain)
    return [RawPart("", vertices[drawn], numbered, material)]


def _indices(values: Array, n_vertices: int) -> NDArray[np.int64]:
    """The corners of faces as indices of vertices."""
    wrong = ~((values >= 0) & (values < n_vertices))
    if wrong.any():
        raise VehicleError(f"a face names vertex {values[wrong][0]:g}; there are {n_vertices}")
    return values.astype(np.int64)


def _material(columns: Columns, items: Array, plain: Material) -> Material:
    """The mean colour of items that have colours."""
    red, green, blue = (_mean(columns[name].values[items]) for name in COLOR)
    opacity = float(np.mean(_unit(columns["alpha"].values[items]))) if "alpha" in columns else 1.0
    return replace(plain, color=(red, green, blue), opacity=opacity)


def _mean(levels: Array) -> int:
    """The mean of an sRGB channel in linear light, 0 to 255."""
    return int(np.rint(255 * linear_to_srgb(srgb_to_linear(_unit(levels)).mean())))


def _unit(levels: Array) -> Floats:
    """The levels of a channel from 0 to 1, which whole numbers count up to 255."""
    numbers = np.nan_to_num(levels.astype(float))
    counts_up = levels.dtype.kind in "iu" or numbers.max(initial=0) > 1
    return (numbers / 255 if counts_up else numbers).clip(0, 1)
