"""Display meshes as files, in metres and vehicle coordinates."""

import json
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from trimesh.exchange.gltf import export_glb

from modeviz.errors import VehicleError, located
from modeviz.vehicle.bodies import Material, Mesh, MeshPart
from modeviz.vehicle.files.disk import read_bytes
from modeviz.vehicle.srgb import linear_to_srgb, srgb_to_linear

MESH_SUFFIXES = (".glb", ".stl", ".obj", ".ply")

Color = tuple[int, int, int]

DEFAULT_COLOR: Color = (150, 156, 164)
"""sRGB, of what comes without a material."""


def read_mesh(path: Path, color: Color = DEFAULT_COLOR) -> Mesh:
    """The parts of a mesh file, with their vertices in the file's order.

    Args:
        path: binary glTF with its materials, STL, OBJ or PLY.
        color: of the parts without a material.

    Raises:
        VehicleError: not such a file, not there, damaged or empty.
    """
    suffix = path.suffix.lower()
    if suffix not in MESH_SUFFIXES:
        raise VehicleError(f"{path}: found {suffix!r}, expected one of {', '.join(MESH_SUFFIXES)}")
    content = read_bytes(path)
    try:
        materials = _materials(content) if suffix == ".glb" else {}
        scene = trimesh.load_scene(BytesIO(content), file_type=suffix[1:], process=False)
        surfaces = _surfaces(scene)
    except Exception as error:  # damaged files make trimesh raise almost anything
        raise VehicleError(f"{path}: not a whole {suffix} file ({error})") from None
    if not surfaces:
        raise VehicleError(f"{path}: found no triangles")
    plain = Material(color)
    with located(path):
        return tuple(
            MeshPart(
                str(surface.metadata["node"]),
                surface.vertices,
                surface.faces,
                materials.get(_material_name(surface), plain),
            )
            for surface in surfaces
        )


def write_mesh(path: Path, mesh: Mesh) -> None:
    """Writes the parts as binary glTF, in single precision, each a node with its material."""
    scene = trimesh.Scene()
    for part in mesh:
        surface = trimesh.Trimesh(part.vertices, part.faces, process=False)
        scene.add_geometry(surface, node_name=part.name, geom_name=part.name)

    def set_materials(tree: dict[str, Any]) -> None:
        # here and not as trimesh's materials, because those have 8-bit linear colours
        tree["materials"] = [_gltf_material(part) for part in mesh]
        for index, surface in enumerate(tree["meshes"]):
            surface["primitives"][0]["material"] = index

    path.write_bytes(export_glb(scene, tree_postprocessor=set_materials))


def _surfaces(scene: trimesh.Scene) -> list[trimesh.Trimesh]:
    """What of the scene has faces, where its node puts it, in the file's order."""
    order = {name: index for index, name in enumerate(scene.geometry)}
    placed = [g for g in scene.dump() if isinstance(g, trimesh.Trimesh)]
    return sorted(placed, key=lambda g: (order[g.metadata["name"]], g.metadata["node"]))


def _materials(content: bytes) -> dict[str, Material]:
    """The named materials of a binary glTF."""
    length = int.from_bytes(content[12:16], "little")
    tree = json.loads(content[20 : 20 + length])
    return {m["name"]: _material(m) for m in tree.get("materials", []) if "name" in m}


def _material(data: dict[str, Any]) -> Material:
    surface = data.get("pbrMetallicRoughness", {})
    *linear, opacity = surface.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
    red, green, blue = np.rint(255 * linear_to_srgb(linear)).astype(int).tolist()
    return Material(
        (red, green, blue),
        opacity,
        surface.get("roughnessFactor", 1.0),
        surface.get("metallicFactor", 1.0),
    )


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


def _material_name(surface: trimesh.Trimesh) -> str:
    return str(getattr(getattr(surface.visual, "material", None), "name", ""))
