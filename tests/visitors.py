"""Who comes to a server without a browser: requests, websockets, and what they say there."""

import http.client
import time
from collections.abc import Callable
from typing import Any

import msgspec.msgpack
import viser
import zstandard
from websockets.sync.client import connect

TOKEN = "a-long.secret_1"

PATIENCE_S = 20.0

CAMERA = {
    "type": "ViewerCameraMessage",
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (1.0, 0.0, 0.0),
    "fov": 1.0,
    "near": 0.1,
    "far": 10.0,
    "image_height": 10,
    "image_width": 10,
    "look_at": (0.0, 0.0, 0.0),
    "up_direction": (0.0, 0.0, 1.0),
}
"""What a page says first."""


def get(server, path="/", **headers):
    """The answer to one HTTP request: status, headers, body."""
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=PATIENCE_S)
    connection.request("GET", path, headers=headers)
    answer = connection.getresponse()
    return answer.status, dict(answer.getheaders()), answer.read()


def own_origin(server):
    return f"http://127.0.0.1:{server.get_port()}"


def knock(server, origin, path="/", version=viser.__version__, **headers):
    """A websocket to the server as a page of `origin` would open it."""
    return connect(
        f"ws://127.0.0.1:{server.get_port()}{path}",
        origin=origin,
        subprotocols=[f"viser-v{version}"],
        additional_headers=headers,
        open_timeout=PATIENCE_S,
        close_timeout=1.0,
        compression=None,
        max_size=None,
    )


def visit(server):
    """A websocket as a page of the server's own opens it."""
    return knock(server, own_origin(server))


def encoded(message: Any) -> bytes:
    return msgspec.msgpack.encode(message)


def update(handle, value) -> bytes:
    """What a page says when a widget has another value."""
    fields = {"type": "GuiUpdateMessage", "uuid": handle._impl.uuid, "updates": {"value": value}}
    return encoded(fields)


def decoded(frame):
    """The messages in what viser sends: two lengths, and a compressed msgpack."""
    length = int.from_bytes(frame[8:16], "little")
    unzipped = zstandard.ZstdDecompressor().decompress(frame[16 : 16 + length])
    return msgspec.msgpack.decode(unzipped)["messages"]


def wait_until(reached: Callable[[], Any], seconds: float = PATIENCE_S) -> None:
    """Waits until something is true."""
    deadline = time.monotonic() + seconds
    while not reached():
        assert time.monotonic() < deadline, "it did not come to that in time"
        time.sleep(0.02)
