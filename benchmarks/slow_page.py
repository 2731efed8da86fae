"""A page on a line that is as good as dead: it opens, and then reads what it likes."""

import socket
import struct
from collections.abc import Iterator
from contextlib import contextmanager

import viser

from benchmarks.page_client import CAMERA, own_origin, wire

HEAD = "\r\n".join(
    [
        "GET {path} HTTP/1.1",
        "Host: 127.0.0.1:{port}",
        "Origin: {origin}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Protocol: viser-v{version}",
        "",
        "",
    ]
)


@contextmanager
def slow_page(port: int, path: str = "/") -> Iterator[socket.socket]:
    """The socket of a page that has told its camera, and for which little fits on the way."""
    with socket.socket() as page:
        page.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        page.connect(("127.0.0.1", port))
        head = HEAD.format(path=path, port=port, origin=own_origin(port), version=viser.__version__)
        camera = wire("ViewerCameraMessage", **CAMERA)
        frame = bytes([0x82, 0x80 | 126]) + struct.pack(">HI", len(camera), 0) + camera  # mask 0
        page.sendall(head.encode() + frame)
        yield page
