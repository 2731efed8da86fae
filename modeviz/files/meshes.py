"""Display meshes as files, in metres and vehicle coordinates."""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.disk import inside, read_bytes
from modeviz.files.mesh_formats.dae import read_dae
from modeviz.files.mesh_formats.glb import read_glb
from modeviz.files.mesh_formats.limits import LARGEST_DOCUMENT, LARGEST_FILE
from modeviz.files.mesh_formats.obj import read_obj
from modeviz.files.mesh_formats.parts import RawMesh
from modeviz.files.mesh_formats.ply import read_ply
from modeviz.files.mesh_formats.step import read_step
from modeviz.files.mesh_formats.stl import read_stl
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Material, Mesh, MeshPart
from modeviz.vehicle.srgb import srgb_to_linear

Beside = Callable[[str], bytes | None]
"""The content of a file in the folder of a mesh, by its name; None if there is none."""

READERS: Mapping[str, Callable[[bytes, Material, Beside], RawMesh]] = {
    ".glb": lambda content, plain, _: RawMesh(read_glb(content, plain)),
    ".stl": lambda content, plain, _: RawMesh(read_stl(content, plain)),
    ".obj": lambda content, plain, beside: RawMesh(read_obj(content, plain, beside)),
    ".ply": lambda content, plain, _: RawMesh(read_ply(content, plain)),
    ".dae": lambda content, plain, _: read_dae(content, plain),
    **dict.fromkeys((".step", ".stp"), lambda content, plain, _: read_step(content, plain)),
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
        path: binary glTF with its materials, STL, OBJ, PLY, COLLADA or STEP.
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
    with located(path), np.errstate(all="ignore"):  # what is not finite is refused in the end
        found = READERS[suffix](content, Material(color), partial(_beside, path.parent))
        if not found.parts:
            raise VehicleError("found no triangles")
        return found.placed(length, turn, usual)


def _beside(folder: Path, name: str) -> bytes | None:
    """The content of a file in a folder, if it is there; raises VehicleError if it is too large."""
    path = inside(folder, name)
    return read_bytes(path, LARGEST_DOCUMENT) if path.is_file() else None


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
