"""A drawn surface as binary glTF 2.0 (GLB): what the page receives once."""

import json
import struct
from typing import Any

import numpy as np

from modeviz.shapes.colors import Color
from modeviz.shapes.surface import Surface
from modeviz.vehicle.arrays import Array
from modeviz.vehicle.bodies import Material
from modeviz.vehicle.srgb import srgb_to_linear

FLOAT, UNSIGNED_INT = 5126, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
LINES, TRIANGLES = 1, 4


def glb(surface: Surface, edge_color: Color | None = None) -> bytes:
    """The surface as a GLB: one vertex array, a primitive for each patch and one for the edges.

    No normals are written, so a viewer shades flat and its shading follows the deformation. A patch of
    skin is marked in its material's `extras`.

    Args:
        surface: what to write.
        edge_color: sRGB, 0 to 255, of the border and fold lines; none are written without it.
    """
    arrays: list[Array] = [surface.vertices.astype("<f4")]
    materials, primitives = [], []
    for patch in surface.patches:
        arrays.append(patch.faces.reshape(-1).astype("<u4"))
        primitives.append(_primitive(TRIANGLES, len(primitives)))
        materials.append({**_material(patch.material), "extras": {"skin": patch.is_skin}})
    if edge_color is not None and len(surface.edges):
        arrays.append(surface.edges.reshape(-1).astype("<u4"))
        primitives.append(_primitive(LINES, len(primitives)))
        materials.append(_material(Material(edge_color, roughness=1.0, metallic=0.0)))
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": materials,
        "accessors": [_accessor(view, array) for view, array in enumerate(arrays)],
        **_buffers(arrays),
    }
    return _container(document, b"".join(array.tobytes() for array in arrays))


def _primitive(mode: int, number: int) -> dict[str, Any]:
    """The primitive of that number; accessor 0 holds the vertices, the next ones the indices."""
    return {"mode": mode, "attributes": {"POSITION": 0}, "indices": number + 1, "material": number}


def _material(material: Material) -> dict[str, Any]:
    color = [float(c) for c in srgb_to_linear(np.array(material.color) / 255)]
    return {
        "pbrMetallicRoughness": {
            "baseColorFactor": [*color, material.opacity],
            "roughnessFactor": material.roughness,
            "metallicFactor": material.metallic,
        },
        "doubleSided": True,
        "alphaMode": "BLEND" if material.opacity < 1 else "OPAQUE",
    }


def _accessor(view: int, array: Array) -> dict[str, Any]:
    if array.ndim == 1:
        return {
            "bufferView": view,
            "componentType": UNSIGNED_INT,
            "count": len(array),
            "type": "SCALAR",
        }
    return {
        "bufferView": view,
        "componentType": FLOAT,
        "count": len(array),
        "type": "VEC3",
        "min": array.min(axis=0).tolist(),
        "max": array.max(axis=0).tolist(),
    }


def _buffers(arrays: list[Array]) -> dict[str, Any]:
    """The views of arrays laid one after the other; items of four bytes keep them all aligned."""
    offsets = np.cumsum([0, *(array.nbytes for array in arrays)])
    views = [
        {
            "buffer": 0,
            "byteOffset": int(offset),
            "byteLength": array.nbytes,
            "target": ARRAY_BUFFER if array.ndim == 2 else ELEMENT_ARRAY_BUFFER,
        }
        for array, offset in zip(arrays, offsets, strict=False)
    ]
    return {"bufferViews": views, "buffers": [{"byteLength": int(offsets[-1])}]}


def _container(document: dict[str, Any], binary: bytes) -> bytes:
    """The GLB of a document and its binary chunk (glTF 2.0, section 4)."""
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
