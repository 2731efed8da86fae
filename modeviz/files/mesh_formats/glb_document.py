"""A binary glTF 2.0 file as it stands: its container, its JSON and its bytes.

glTF 2.0 specification, section 4 (Khronos Group, ISO/IEC 12113).
"""

import base64
import json
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

from modeviz.errors import VehicleError, quoted, reason
from modeviz.files.mesh_formats.glb_records import Buffer, Document
from modeviz.files.mesh_formats.limits import LARGEST_DOCUMENT, check_size
from modeviz.files.schema.decoding import decode, unreadable

READ_EXTENSIONS = frozenset(
    {
        "KHR_mesh_quantization",
        # The next ones change no place and, but for what light does on it, no colour.
        "KHR_lights_punctual",
        "KHR_materials_anisotropy",
        "KHR_materials_clearcoat",
        "KHR_materials_dispersion",
        "KHR_materials_emissive_strength",
        "KHR_materials_ior",
        "KHR_materials_iridescence",
        "KHR_materials_sheen",
        "KHR_materials_specular",
        "KHR_materials_unlit",
        "KHR_materials_variants",
        "KHR_texture_transform",
    }
)
"""What a file may require."""

T = TypeVar("T")


@dataclass(frozen=True, eq=False)
class Glb:
    """A file that is being read."""

    document: Document
    buffers: Sequence[memoryview]

    def view(self, index: int) -> memoryview:
        """The bytes of a buffer view.

        Raises:
            VehicleError: there is no such view, or it is not within its buffer.
        """
        view = item(self.document.buffer_views, index, "bufferViews")
        buffer = item(self.buffers, view.buffer, "buffers")
        end = view.byte_offset + view.byte_length
        if end > len(buffer):
            raise VehicleError(f"bufferViews[{index}]: ends at byte {end} of {len(buffer)}")
        return buffer[view.byte_offset : end]


def item(items: Sequence[T], index: int, key: str) -> T:
    """One of the document's objects.

    Raises:
        VehicleError: there is none of that index.
    """
    if index >= len(items):
        raise VehicleError(f"{key}[{index}]: is named and not there; there are {len(items)}")
    return items[index]


def read_document(content: bytes) -> Glb:
    """The document and the binary data of a file.

    Raises:
        VehicleError: it is cut or damaged, or requires what is not read.
    """
    text, binary = _chunks(content)
    check_size("bytes of JSON", len(text), LARGEST_DOCUMENT)
    document = _decoded(text)
    unread = sorted(set(document.extensions_required) - READ_EXTENSIONS)
    if unread:
        raise VehicleError(
            f"requires the glTF extension {', '.join(unread)}, which is not read: export it again "
            "without (compression and instances off)"
        )
    return Glb(document, [_buffer(b, i, binary) for i, b in enumerate(document.buffers)])


def _chunks(content: bytes) -> tuple[bytes, memoryview]:
    """The JSON and the binary chunk of a container."""
    magic, version, length = struct.unpack_from("<4sII", content.ljust(12, b"\0"))
    if magic != b"glTF":
        found = (
            f"bytes that begin with {quoted(content[:4].decode('latin-1'))}" if content else "no bytes"
        )
        raise VehicleError(f"found {found}, expected a binary glTF, which begins with 'glTF'")
    if version != 2:
        raise VehicleError(f"found glTF {version}, expected glTF 2")
    if length > len(content):
        raise VehicleError(f"is cut: found {len(content)} of its {length} bytes")
    chunks: dict[bytes, memoryview] = {}
    place = 12
    while place + 8 <= length:
        size, kind = struct.unpack_from("<I4s", content, place)
        if place + 8 + size > length:
            raise VehicleError(f"the chunk at byte {place} ends behind the file's end")
        chunks.setdefault(kind, memoryview(content)[place + 8 : place + 8 + size])
        place += 8 + size
    if b"JSON" not in chunks:
        raise VehicleError("found no JSON chunk")
    return bytes(chunks[b"JSON"]), chunks.get(b"BIN\0", memoryview(b""))


def _decoded(text: bytes) -> Document:
    try:
        return decode(json.loads(text), Document)
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"its JSON cannot be read ({unreadable(error)})") from None


def _buffer(buffer: Buffer, index: int, binary: memoryview) -> memoryview:
    """The bytes of a buffer: the binary chunk, or those within its own text."""
    whole = binary if buffer.uri is None else memoryview(embedded(buffer.uri, f"buffers[{index}]"))
    if len(whole) < buffer.byte_length:
        raise VehicleError(f"buffers[{index}]: found {len(whole)} of its {buffer.byte_length} bytes")
    return whole


def embedded(uri: str, key: str) -> bytes:
    """The bytes of a data URI.

    Raises:
        VehicleError: it is the name of another file, or damaged.
    """
    head, comma, text = uri.partition(",")
    if not head.startswith("data:") or not head.endswith(";base64") or not comma:
        raise VehicleError(f"{key}: names the file {uri[:80]!r}, expected all within the .glb file")
    try:
        return base64.b64decode(text, validate=True)
    except ValueError as error:
        raise VehicleError(f"{key}: cannot be read ({reason(error)})") from None
