"""What a page says to its server and hears from it, without a browser."""

import http.client
from typing import Any

import msgspec
import viser
import zstandard
from websockets.typing import Origin, Subprotocol

Message = dict[str, Any]

CAMERA = {
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (5.0, 5.0, 3.0),
    "fov": 1.0,
    "near": 0.1,
    "far": 100.0,
    "image_height": 600,
    "image_width": 800,
    "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}
"""What a page tells of its camera."""


def wire(kind: str, **fields: Any) -> bytes:
    """A message of a page as it goes to the server."""
    return msgspec.msgpack.encode({"type": kind, **fields})


def messages(frame: bytes | str) -> list[Message]:
    """Those in a frame of the server's; arrays in them are numbers of its buffers."""
    return _content(frame)[0]["messages"]


def buffers(frame: bytes | str) -> list[bytes]:
    """The arrays in a frame of the server's, each of which begins at a multiple of eight bytes."""
    content, end = _content(frame)
    assert isinstance(frame, bytes)
    found = []
    for length in content["binaryBufferLengths"]:
        start = -8 * (-end // 8)
        end = start + length
        found.append(frame[start:end])
    return found


def _content(frame: bytes | str) -> tuple[dict[str, Any], int]:
    """What is in a frame but its arrays, after two lengths and compressed, and where these follow."""
    assert isinstance(frame, bytes)
    end = 16 + int.from_bytes(frame[8:16], "little")
    packed = zstandard.ZstdDecompressor().decompress(frame[16:end])
    return msgspec.msgpack.decode(packed), end


def own_origin(port: int) -> str:
    """Where a page comes from that this machine's server at a port has given out."""
    return f"http://127.0.0.1:{port}"


def session_query(port: int) -> str:
    """Return what the address of a new session adds: "?session=…"; nothing where there is only one."""
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60.0)
    try:
        connection.request("GET", "/")
        _, mark, query = (connection.getresponse().headers["Location"] or "").partition("?")
        return mark + query
    finally:
        connection.close()


def handshake(origin: str | None, version: str = viser.__version__, **headers: str) -> dict[str, Any]:
    """How a page of some origin connects, for messages of any size: arguments of `connect`."""
    return {
        "origin": origin and Origin(origin),
        "subprotocols": [Subprotocol(f"viser-v{version}")],
        "additional_headers": headers,
        "compression": None,
        "max_size": None,
        "ping_interval": None,
    }
