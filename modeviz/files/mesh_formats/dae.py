"""COLLADA: the triangles of a file's scene where its nodes put them; it says its unit and axes."""

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.dae_document import Dae, child, children, read_document, values
from modeviz.files.mesh_formats.dae_materials import material_of
from modeviz.files.mesh_formats.limits import MOST_PARTS, MOST_POINTS, check_size
from modeviz.files.mesh_formats.parts import RawMesh, RawPart, fans, used
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material

UP: dict[str, Floats] = {
    "X_UP": np.array([[0.0, -1, 0], [0, 0, -1], [1, 0, 0]]),
    "Y_UP": np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "Z_UP": np.eye(3),
}
"""What turns a file's axes so that z is up and x stays to the right."""

PRIMITIVES = ("triangles", "polylist", "polygons", "tristrips", "trifans")

MOST_NODES = 20_000
"""Visited: those of a library count as often as they are used."""


@dataclass(frozen=True, eq=False)
class Placed:
    """A geometry where a node puts it."""

    name: str
    geometry: Element
    materials: dict[str, Element]
    """By the symbols that its primitives have for them."""
    place: Floats
    """(4, 4)."""


def read_dae(content: bytes, plain: Material) -> RawMesh:
    """The parts of a file: one for each primitive of triangles or polygons in its scene.

    Args:
        content: of the file.
        plain: of what has no colour; textures are in other files, which are not opened.

    Raises:
        VehicleError: it is damaged, too large, or refers to what is not in it.
    """
    dae = read_document(content)
    parts: list[RawPart] = []
    n_corners = 0
    for placed in _placed(dae):
        for primitive in children(child(placed.geometry, "mesh"), *PRIMITIVES):
            part = _part(dae, placed, primitive, plain)
            if part is None:
                continue
            n_corners += part.faces.size
            check_size("corners of faces", n_corners, 3 * MOST_POINTS)
            parts.append(part)
            check_size("parts", len(parts), MOST_PARTS)
    return RawMesh(parts, _unit(dae), UP[_up_axis(dae)])


def _unit(dae: Dae) -> float:
    """The m of one unit; one if nothing is said."""
    unit = dae.root.find("asset/unit")
    text = "1" if unit is None else unit.get("meter", "1")
    try:
        length = float(text)
    except ValueError:
        length = 0.0
    if not 1e-6 <= length <= 1e6:
        raise VehicleError(f"<unit>: meter: found {text[:80]!r}, expected how many metres a unit has")
    return length


def _up_axis(dae: Dae) -> str:
    """Its name; that of y if nothing is said."""
    name = (dae.root.findtext("asset/up_axis") or "Y_UP").strip()
    if name not in UP:
        raise VehicleError(f"<up_axis>: found {name[:80]!r}, expected one of {', '.join(UP)}")
    return name


def _placed(dae: Dae) -> Iterator[Placed]:
    """The geometries in the scene."""
    n_nodes = 0
    waiting = [(node, np.eye(4)) for node in reversed(_roots(dae))]
    while waiting:
        node, place = waiting.pop()
        n_nodes += 1
        check_size("nodes", n_nodes, MOST_NODES)
        place = place @ _matrix(node)
        for instance in children(node, "instance_geometry", "instance_controller"):
            yield _instance(dae, node, instance, place)
        inner = [*children(node, "node")]
        inner += [dae.named(instance, "url") for instance in children(node, "instance_node")]
        waiting += [(other, place) for other in reversed(inner)]


def _roots(dae: Dae) -> list[Element]:
    """The nodes of the scene; of all scenes if the file does not say which."""
    instance = dae.root.find("scene/instance_visual_scene")
    if instance is not None:
        return [*children(dae.named(instance, "url"), "node")]
    return dae.root.findall("library_visual_scenes/visual_scene/node")


def _instance(dae: Dae, node: Element, instance: Element, place: Floats) -> Placed:
    geometry = dae.named(instance, "url")
    if geometry.tag == "controller":
        skin = child(geometry, "skin")
        bound = skin.find("bind_shape_matrix")
        place = place if bound is None else place @ values(bound, 16).reshape(4, 4)
        geometry = dae.named(skin, "source")
    materials = {
        bound.get("symbol", ""): dae.named(bound, "target")
        for bound in instance.iter("instance_material")
    }
    name = node.get("name") or node.get("id") or geometry.get("name") or ""
    return Placed(name, geometry, materials, place)


def _matrix(node: Element) -> Floats:
    """What takes a node's coordinates to its parent's, (4, 4): its transformations in their order."""
    matrix = np.eye(4)
    for element in node:
        step = np.eye(4)
        match element.tag:
            case "matrix":
                step = values(element, 16).reshape(4, 4)
            case "translate":
                step[:3, 3] = values(element, 3)
            case "scale":
                step[:3, :3] = np.diag(values(element, 3))
            case "rotate":
                *axis, angle = values(element, 4)
                step[:3, :3] = _rotation(np.array(axis), np.radians(angle))
            case "skew" | "lookat":
                raise VehicleError(f"<{element.tag}> in <node>: is not read, expected <matrix>")
        matrix = matrix @ step
    return matrix


def _rotation(axis: Floats, angle: float) -> Floats:
    """(3, 3), by the formula of Rodrigues."""
    x, y, z = axis / (np.linalg.norm(axis) or 1.0)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def _part(dae: Dae, placed: Placed, primitive: Element, plain: Material) -> RawPart | None:
    """The triangles of a primitive; None if it has none."""
    inputs = [*children(primitive, "input")]
    vertex = next((i for i in inputs if i.get("semantic") == "VERTEX"), None)
    if vertex is None:
        raise VehicleError(f"<{primitive.tag}> has no <input> with the semantic VERTEX")
    stride = 1 + max(_count(i, "offset") for i in inputs)
    faces = _faces(primitive, stride, _count(vertex, "offset"))
    if not len(faces):
        return None
    positions = _positions(dae, dae.named(vertex, "source"))
    if not 0 <= faces.min() <= faces.max() < len(positions):
        wrong = faces.min() if faces.min() < 0 else faces.max()
        raise VehicleError(
            f"<{primitive.tag}>: a face names vertex {wrong}; there are {len(positions)}, from 0"
        )
    drawn, numbered = used(np.arange(len(positions)), faces)
    vertices = positions[drawn] @ placed.place[:3, :3].T + placed.place[:3, 3]
    material = placed.materials.get(primitive.get("material", ""))
    return RawPart(placed.name, vertices, numbered, material_of(dae, material, plain))


def _faces(primitive: Element, stride: int, offset: int) -> NDArray[np.int64]:
    """The vertices of a primitive's triangles, (n_faces, 3)."""
    lists = [_corners(p, stride, offset) for p in children(primitive, "p")]
    corners = np.concatenate([np.zeros(0, np.int64), *lists])
    counts = np.array([len(one) for one in lists], np.int64)
    match primitive.tag:
        case "triangles":
            return corners[: len(corners) // 3 * 3].reshape(-1, 3)
        case "polylist":
            return fans(_polygons(primitive, len(corners)), corners)
        case "tristrips":
            return np.concatenate([np.zeros((0, 3), np.int64), *map(_strip, lists)])
    return fans(counts, corners)


def _corners(p: Element, stride: int, offset: int) -> NDArray[np.int64]:
    indices = values(p)
    check_size("indices in <p>", len(indices), 3 * MOST_POINTS * stride)
    if len(indices) % stride:
        raise VehicleError(f"<p>: found {len(indices)} indices, expected {stride} for each corner")
    if not (np.abs(indices) < 2**31).all():
        raise VehicleError("<p>: found indices beyond any vertex")
    return indices[offset::stride].astype(np.int64)


def _polygons(primitive: Element, n_corners: int) -> NDArray[np.int64]:
    """The number of corners of each polygon."""
    counts = values(child(primitive, "vcount"))
    if not ((counts >= 0) & (counts <= n_corners)).all() or counts.sum() != n_corners:
        raise VehicleError(f"<vcount>: tells {counts.sum():g} corners, <p> has {n_corners}")
    return counts.astype(np.int64)


def _strip(corners: NDArray[np.int64]) -> NDArray[np.int64]:
    i = np.arange(max(len(corners) - 2, 0))
    return np.stack([corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]], axis=1)


def _positions(dae: Dae, vertices: Element) -> Floats:
    """The places of a mesh's vertices, (n_vertices, 3)."""
    inputs = [i for i in children(vertices, "input") if i.get("semantic") == "POSITION"]
    if not inputs:
        raise VehicleError("<vertices> has no <input> with the semantic POSITION")
    source = dae.named(inputs[0], "source")
    accessor = child(child(source, "technique_common"), "accessor")
    stored = values(dae.named(accessor, "source"))
    stride, offset = max(_count(accessor, "stride"), 1), _count(accessor, "offset")
    count = min(_count(accessor, "count"), (len(stored) - offset) // stride)
    if stride < 3 or count < 1:
        raise VehicleError("<accessor> of positions: expected three numbers for each of its vertices")
    check_size("vertices", count, MOST_POINTS)
    return stored[offset : offset + count * stride].reshape(count, stride)[:, :3]


def _count(element: Element, key: str) -> int:
    """An attribute that counts, zero if it is not there."""
    text = element.get(key, "0")
    if not (text.isascii() and text.isdigit() and len(text) < 10):
        raise VehicleError(f"<{element.tag}>: {key}: found {text[:80]!r}, expected a whole number")
    return int(text)
