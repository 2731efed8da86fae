"""Binary glTF 2.0: the triangles of its scene where its nodes put them, and their materials."""

from collections.abc import Iterator
from dataclasses import dataclass
from reprlib import repr as brief

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError, located
from modeviz.files.mesh_formats.glb_arrays import scaled, values
from modeviz.files.mesh_formats.glb_document import Glb, item, read_document
from modeviz.files.mesh_formats.glb_materials import Materials
from modeviz.files.mesh_formats.glb_records import Document, NodeRecord, Primitive
from modeviz.files.mesh_formats.limits import MOST_PARTS, MOST_POINTS, check_size
from modeviz.files.mesh_formats.parts import RawPart, used
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material

TRIANGLES, STRIP, FAN = 4, 5, 6
"""Modes of primitives; the others are points and lines, which are not drawn."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A primitive where a node puts it."""

    name: str
    primitive: Primitive
    place: Floats
    """(4, 4)."""


def read_glb(content: bytes, plain: Material) -> list[RawPart]:
    """The parts of a file: a part for each primitive of triangles, in the order of its nodes.

    Args:
        content: of the file.
        plain: of what has neither a material nor colours.

    Raises:
        VehicleError: it is damaged, too large, or requires what is not read.
    """
    glb = read_document(content)
    placed = list(_placed(glb.document))
    _check_sizes(glb.document, placed)
    materials = Materials(glb, plain)
    return [part for each in placed if (part := _part(glb, each, materials)) is not None]


def _placed(document: Document) -> Iterator[Placed]:
    """The primitives of triangles in the scene."""
    for node, place in _nodes(document):
        if node.mesh is None:
            continue
        surface = item(document.meshes, node.mesh, "meshes")
        for primitive in surface.primitives:
            if primitive.mode >= TRIANGLES:
                yield Placed(node.name or surface.name, primitive, place)


def _nodes(document: Document) -> Iterator[tuple[NodeRecord, Floats]]:
    """The nodes of the scene, each before its children, and where they are, (4, 4)."""
    seen = set[int]()
    waiting = [(index, np.eye(4)) for index in reversed(_roots(document))]
    while waiting:
        index, place = waiting.pop()
        if index in seen:
            raise VehicleError(f"nodes[{index}]: is reached twice, expected nodes that form trees")
        seen.add(index)
        node = item(document.nodes, index, "nodes")
        place = place @ _matrix(node)
        yield node, place
        waiting += [(child, place) for child in reversed(node.children)]


def _roots(document: Document) -> list[int]:
    """The nodes that the scene begins with; without a scene those that are no children."""
    if document.scenes:
        return item(document.scenes, document.scene or 0, "scenes").nodes
    children = {child for node in document.nodes for child in node.children}
    return [index for index in range(len(document.nodes)) if index not in children]


def _matrix(node: NodeRecord) -> Floats:
    """The matrix that takes a node's coordinates to its parent's, (4, 4)."""
    if node.matrix is not None:
        return np.array(node.matrix).reshape(4, 4).T  # column by column
    matrix = np.eye(4)
    matrix[:3, :3] = _rotation(np.array(node.rotation)) * node.scale
    matrix[:3, 3] = node.translation
    return matrix


def _rotation(quaternion: Floats) -> Floats:
    """The rotation of a quaternion x, y, z, w, (3, 3)."""
    x, y, z, w = quaternion / (np.linalg.norm(quaternion) or 1.0)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _check_sizes(document: Document, placed: list[Placed]) -> None:
    """Checks what reading the primitives will take, before any is read."""
    check_size("parts", len(placed), MOST_PARTS)
    n_corners = n_rows = 0
    for each in placed:
        attributes = each.primitive.attributes
        for index in (attributes.get("POSITION"), attributes.get("COLOR_0"), each.primitive.indices):
            if index is not None:
                accessor = item(document.accessors, index, "accessors")
                n_rows += accessor.count if accessor.sparse else 0
        n_corners += _n_corners(document, each.primitive)
    check_size("corners of faces", n_corners, 3 * MOST_POINTS)
    check_size("sparse rows", n_rows, 3 * MOST_POINTS)


def _n_corners(document: Document, primitive: Primitive) -> int:
    """The number of corners of triangles that a primitive has."""
    index = primitive.indices if primitive.indices is not None else primitive.attributes.get("POSITION")
    if index is None:
        return 0
    n = document.accessors[index].count
    return n if primitive.mode == TRIANGLES else 3 * max(n - 2, 0)


def _part(glb: Glb, placed: Placed, materials: Materials) -> RawPart | None:
    """The triangles of a primitive; None if it has none."""
    primitive = placed.primitive
    index = primitive.attributes.get("POSITION")
    if index is None:
        return None
    with located(f"node {brief(placed.name)}"):
        positions = values(glb, index, "VEC3")
        faces = _triangles(_corners(glb, primitive, len(positions)), primitive.mode)
        if not len(faces):
            return None
        if faces.max() >= len(positions):
            raise VehicleError(f"a face names vertex {faces.max()}; there are {len(positions)}")
        drawn, numbered = used(np.arange(len(positions)), faces)
        vertices = _moved(scaled(positions[drawn], glb.document.accessors[index]), placed.place)
        return RawPart(placed.name, vertices, numbered, materials.of(primitive, drawn))


def _corners(glb: Glb, primitive: Primitive, n_vertices: int) -> NDArray[np.int64]:
    """The vertices that a primitive draws, one after the other."""
    if primitive.indices is None:
        return np.arange(n_vertices)
    return values(glb, primitive.indices, "SCALAR")[:, 0].astype(np.int64)


def _triangles(corners: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    """The faces of a primitive, (n_faces, 3); glTF 2.0 specification, section 3.7.2.1."""
    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    i = np.arange(max(len(corners) - 2, 0))
    if mode == FAN:
        return np.stack([corners[i + 1], corners[i + 2], np.broadcast_to(corners[:1], i.shape)], axis=1)
    return np.stack([corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]], axis=1)


def _moved(vertices: Floats, place: Floats) -> Floats:
    return vertices @ place[:3, :3].T + place[:3, 3]
