"""Binary glTF files made by hand, byte by byte, as their specification has them."""

import json
import struct
from io import BytesIO
from typing import Any

import numpy as np
from PIL import Image

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4")
TWO_FACES = np.array([0, 1, 2, 0, 2, 3], "<u2")
COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
WIDTHS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


class GlbFile:
    """A document with its buffer; tests change the document before they write it."""

    def __init__(self) -> None:
        """Starts with one empty scene."""
        self.binary = b""
        self.document: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def view(self, content: bytes, **keys: Any) -> int:
        """Adds bytes as a buffer view, and gives its index."""
        place = len(self.binary)
        self.binary += content + bytes(-len(content) % 4)
        view = {"buffer": 0, "byteOffset": place, "byteLength": len(content), **keys}
        return self.add("bufferViews", view)

    def add(self, key: str, item: dict[str, Any]) -> int:
        """Adds an object to the document, and gives its index."""
        items = self.document.setdefault(key, [])
        items.append(item)
        return len(items) - 1

    def accessor(self, rows: np.ndarray, **keys: Any) -> int:
        """Adds an array, and gives the index of its accessor."""
        rows = rows.reshape(len(rows), -1)
        kind = {
            "bufferView": self.view(rows.tobytes()),
            "componentType": COMPONENTS[rows.dtype.str[1:]],
            "count": len(rows),
            "type": WIDTHS[rows.shape[1]],
        }
        return self.add("accessors", kind | keys)

    def image(self, pixels: np.ndarray) -> int:
        """Adds a texture, and gives its index."""
        content = BytesIO()
        Image.fromarray(pixels).save(content, "PNG")
        image = self.add("images", {"bufferView": self.view(content.getvalue())})
        return self.add("textures", {"source": image})

    def surface(self, *primitives: dict[str, Any], **node: Any) -> int:
        """Adds a mesh with a node of the scene for it, and gives the index of the node."""
        mesh = self.add("meshes", {"primitives": list(primitives)})
        index = self.add("nodes", {"mesh": mesh, **node})
        self.document["scenes"][0]["nodes"].append(index)
        return index

    def square(self, material: dict[str, Any] | None = None, **attributes: int) -> dict[str, Any]:
        """A primitive of two triangles."""
        primitive: dict[str, Any] = {
            "attributes": {"POSITION": self.accessor(SQUARE), **attributes},
            "indices": self.accessor(TWO_FACES),
        }
        if material is not None:
            primitive["material"] = self.add("materials", material)
        return primitive

    def content(self) -> bytes:
        """The file."""
        document = {k: v for k, v in self.document.items() if v != []}
        if self.binary and "buffers" not in document:
            document["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(document).encode()
        return container(text + b" " * (-len(text) % 4), self.binary)


def container(text: bytes, binary: bytes) -> bytes:
    """A file of a JSON and a binary chunk."""
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
