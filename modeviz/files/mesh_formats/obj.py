"""OBJ: the faces of a file, a part for each of its materials, which are in other files beside it."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError, located
from modeviz.files.mesh_formats.limits import LARGEST_TEXT, MOST_PARTS, MOST_POINTS, check_size
from modeviz.files.mesh_formats.mtl import read_mtl
from modeviz.files.mesh_formats.parts import RawPart, fans, numbers, used
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material

MOST_LIBRARIES = 100
"""Files of materials."""

BEYOND_PLACE = re.compile(rb"/[^ \t\n]*")
"""What follows the number of a corner's vertex: those of its texture and normal."""


@dataclass(frozen=True, eq=False)
class Lines:
    """What the lines of a file say of its faces."""

    vertices: list[bytes] = field(default_factory=list)
    faces: list[bytes] = field(default_factory=list)
    n_before: list[int] = field(default_factory=list)
    """For each face how many vertices stand before it."""
    materials: dict[str, int] = field(default_factory=lambda: {"": 0})
    """Numbers of the materials' names, "" of none."""
    material_of: list[int] = field(default_factory=list)
    """That of each face."""
    libraries: list[str] = field(default_factory=list)
    """The files that have the materials."""


def read_obj(content: bytes, plain: Material, beside: Callable[[str], bytes | None]) -> list[RawPart]:
    """The parts of a file.

    Args:
        content: of the file.
        plain: of faces without a material, or with one that nothing is known of.
        beside: the content of a file in the same folder; None if there is none.

    Raises:
        VehicleError: it, or a file of its materials, is damaged or too large.
    """
    check_size("bytes of text", len(content), LARGEST_TEXT)
    lines = _lines(content.replace(b"\r", b"").replace(b"\\\n", b" "))
    vertices, faces = lines.vertices, lines.faces
    check_size("vertices", len(vertices), MOST_POINTS)
    check_size("faces", len(faces), MOST_POINTS)
    text = BEYOND_PLACE.sub(b"", b"\n".join(faces))
    corners = numbers(text)
    check_size("corners of faces", len(corners), 3 * MOST_POINTS)
    if not len(corners):
        return []
    counts = np.array([len(face.split()) for face in text.split(b"\n")])
    indices = _indices(corners, np.repeat(lines.n_before, counts), len(vertices))
    drawn, numbered = used(np.arange(len(vertices)), fans(counts, indices))
    places = numbers(b" ".join(b" ".join(vertices[i].split(None, 3)[:3]) for i in drawn.tolist()))
    if len(places) != 3 * len(drawn):
        raise VehicleError("found a vertex without three coordinates")
    material_of = np.repeat(lines.material_of, np.maximum(counts - 2, 0))
    known = _materials(lines.libraries, plain, beside)
    return [
        RawPart(name, *used(places.reshape(-1, 3), numbered[own]), known.get(name, plain))
        for name, number in lines.materials.items()
        if (own := material_of == number).any()
    ]


def _lines(text: bytes) -> Lines:
    lines, material = Lines(), 0
    for line in text.split(b"\n"):
        kind, _, rest = line.lstrip().replace(b"\t", b" ").partition(b" ")
        match kind:
            case b"v":
                lines.vertices.append(rest)
            case b"f":
                lines.faces.append(rest)
                lines.n_before.append(len(lines.vertices))
                lines.material_of.append(material)
            case b"usemtl":
                name = rest.decode("utf-8", "replace").strip()
                material = lines.materials.setdefault(name, len(lines.materials))
                check_size("materials", len(lines.materials), MOST_PARTS)
            case b"mtllib":
                lines.libraries.append(rest.decode("utf-8", "replace").strip())
    return lines


def _materials(
    libraries: Sequence[str], plain: Material, beside: Callable[[str], bytes | None]
) -> dict[str, Material]:
    """The materials of the files that are there; one line may name several, or one with spaces.

    Folders in their names are those of who wrote the file: they are looked for beside it.
    """
    found: dict[str, Material] = {}
    for line in dict.fromkeys(libraries[:MOST_LIBRARIES]):
        for name in dict.fromkeys([line, *line.split()]):
            file = re.split(r"[/\\]", name)[-1]
            content = beside(file) if file.strip(".") else None
            if content is not None:
                with located(file):
                    found |= read_mtl(content, plain)
    return found


def _indices(corners: Floats, n_before: NDArray[np.int64], n_vertices: int) -> NDArray[np.int64]:
    """Corners, counted from one or back from the last vertex before, as indices of vertices."""
    indices = np.where(corners < 0, n_before + corners, corners - 1)
    wrong = ~((indices >= 0) & (indices < n_vertices))
    if wrong.any():
        raise VehicleError(f"a face names vertex {corners[wrong][0]:g}; there are {n_vertices}")
    return indices.astype(np.int64)
