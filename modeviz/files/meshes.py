"""Display meshes as files, in metres and vehicle coordinates."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import read_bytes
from modeviz.files.mesh_formats.dae import read_dae
from modeviz.files.mesh_formats.glb import read_glb
from modeviz.files.mesh_formats.limits import LARGEST_FILE
from modeviz.files.mesh_formats.obj import read_obj
from modeviz.files.mesh_formats.parts import RawMesh, RawPart
from modeviz.files.mesh_formats.ply import read_ply
from modeviz.files.mesh_formats.stl import read_stl
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material, Mesh, MeshPart
from modeviz.vehicle.srgb import srgb_to_linear

Reader = Callable[[bytes, Material], RawMesh]


def _unsaid(read: Callable[[bytes, Material], list[RawPart]]) -> Reader:
    """The reader of a format that says neither unit nor axes."""
    return lambda content, plain: RawMesh(read(content, plain))


READERS: Mapping[str, Reader] = {
    ".glb": _unsaid(read_glb),
    ".stl": _unsaid(read_stl),
    ".obj": _unsaid(read_obj),
    ".ply": _unsaid(read_ply),
    ".dae": read_dae,
}
"""By the ending of a file."""

Color = tuple[int, int, int]

DEFAULT_COLOR: Color = (150, 156, 164)
"""sRGB, of what comes without a material."""


def read_mesh(
    path: Path,
    color: Color = DEFAULT_COLOR,
    length: float | None = None,
    turn: Floats | None = None,
    usual: float = 1.0,
) -> Mesh:
    """The parts of a mesh file, without the vertices that no face names, the others in their order.

    Args:
        path: binary glTF with its materials, STL, OBJ, PLY or COLLADA.
        color: of the parts without a material.
        length: m of one unit; None: as the file says.
        turn: (3, 3), of its axes; None: what makes z up, if the file says which axis is.
        usual: m of one unit, where the file says nothing and is not told.

    Raises:
        VehicleError: not such a file, not there, damaged, empty or too large.
    """
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise VehicleError(f"{path}: found {suffix!r}, expected one of {', '.join(READERS)}")
    content = read_bytes(path, LARGEST_FILE)
    with located(path):
        found = READERS[suffix](content, Material(color))
        if not found.parts:
            raise VehicleError("found no triangles")
        return found.placed(length, turn, usual)


def write_mesh(path: Path, mesh: Mesh) -> None:
    """Writes the parts as binary glTF, see `glb_file`."""
    path.write_bytes(glb_file(mesh))


def glb_file(mesh: Mesh, pose: Floats | None = None) -> bytes:
    """The content of a file of binary glTF, in single precision, each part a node with its material.

    Args:
        mesh: the parts; their names differ.
        pose: (4, 4), of all of them in the scene; None: they stand there as they are.
    """
    import trimesh  # half a second, of which a vehicle that is read needs nothing
    from trimesh.exchange.gltf import export_glb

    scene = trimesh.Scene()
    for part in mesh:
        surface = trimesh.Trimesh(part.vertices, part.faces, process=False)
        scene.add_geometry(surface, node_name=part.name, geom_name=part.name, transform=pose)

    def set_materials(tree: dict[str, Any]) -> None:
        # here and not as trimesh's materials, because those have 8-bit linear colours
        tree["materials"] = [_gltf_material(part) for part in mesh]
        for index, surface in enumerate(tree["meshes"]):
            surface["primitives"][0]["material"] = index

    return export_glb(scene, tree_postprocessor=set_materials)


def _gltf_material(part: MeshPart) -> dict[str, Any]:
    material = part.material
    return {
        "name": part.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [
                *srgb_to_linear(np.array(material.color) / 255).tolist(),
                material.opacity,
            ],
            "roughnessFactor": material.roughness,
            "metallicFactor": material.metallic,
        },
        "alphaMode": "BLEND" if material.opacity < 1 else "OPAQUE",
        "doubleSided": True,
    }
