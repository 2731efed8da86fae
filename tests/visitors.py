"""Who comes to a server without a browser: requests, websockets, and what they say there."""

import http.client
import time
from collections.abc import Callable
from contextlib import contextmanager
from typing import Any

import msgspec.msgpack
import viser
from websockets.sync.client import connect

from benchmarks import page_client
from modeviz.viewer.page.wire.decoding import PART

TOKEN = "a-long.secret_1"

PATIENCE_S = 20.0

CAMERA = {"type": "ViewerCameraMessage", **page_client.CAMERA}
"""What a page says first."""


PART_OF_FILE = {
    "type": "FileTransferPart",
    "source_component_uuid": "button",
    "transfer_uuid": "new",
    "part_index": 0,
    "content": b"x" * PART,
}
"""Of what a page uploads."""


def get(server, path="/", **headers):
    """The answer to one HTTP request: status, headers, body."""
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=PATIENCE_S)
    connection.request("GET", path, headers=headers)
    answer = connection.getresponse()
    return answer.status, dict(answer.getheaders()), answer.read()


def own_origin(server):
    return page_client.own_origin(server.get_port())


def knock(server, origin, path="/", version=viser.__version__, **headers):
    """A websocket to the server as a page of `origin` would open it."""
    return connect(
        f"ws://127.0.0.1:{server.get_port()}{path}",
        open_timeout=PATIENCE_S,
        close_timeout=1.0,
        max_queue=None,  # else who does not read is not told that it may go, and waits for that
        **page_client.handshake(origin, version, **headers),
    )


def visit(server):
    """A websocket as a page of the server's own opens it."""
    return knock(server, own_origin(server))


@contextmanager
def entered(server, token="open-sesame-open"):
    """The same of somebody who has brought the token, and whose camera is told."""
    cookie = get(server, f"/?token={token}")[1]["Set-Cookie"].split(";")[0]
    with knock(server, own_origin(server), Cookie=cookie) as socket:
        socket.send(encoded(CAMERA))
        yield socket


def encoded(message: Any) -> bytes:
    return msgspec.msgpack.encode(message)


def update(handle, value) -> bytes:
    """What a page says when a widget has another value."""
    return page_client.wire("GuiUpdateMessage", uuid=handle._impl.uuid, updates={"value": value})


def wait_until(reached: Callable[[], Any], seconds: float = PATIENCE_S) -> None:
    """Waits until something is true."""
    deadline = time.monotonic() + seconds
    while not reached():
        assert time.monotonic() < deadline, "it did not come to that in time"
        time.sleep(0.02)
