"""The first lines of a request, looked at before anybody reads them."""

import socket
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlsplit

LARGEST = 65536
"""Bytes of what is looked at; a request that asks for a page or a websocket has far fewer."""


@dataclass(frozen=True)
class RequestHead:
    """What a request wants."""

    query: dict[str, str]
    """Of its address."""
    is_websocket: bool


def request_head(connection: socket.socket) -> RequestHead | None:
    """Return what came of a request, and leave it to be read; None if more is to come.

    Raises:
        OSError: the connection is closed.
    """
    try:
        came = connection.recv(LARGEST, socket.MSG_PEEK)
    except BlockingIOError:
        return None
    if not came:
        raise ConnectionResetError("closed before it asked for anything")
    head, end, _ = came.partition(b"\r\n\r\n")
    if not end and len(came) < LARGEST:
        return None
    return _parsed(head.decode("latin-1"))


def _parsed(head: str) -> RequestHead:
    """Return what a head wants; who serves it judges whether it is a good one."""
    line, *headers = head.split("\r\n")
    parts = line.split(" ")
    names = [header.partition(":")[::2] for header in headers]
    upgrades = [value.strip().lower() for name, value in names if name.strip().lower() == "upgrade"]
    try:
        query = dict(parse_qsl(urlsplit(parts[1]).query)) if len(parts) > 1 else {}
    except ValueError:
        query = {}
    return RequestHead(query, "websocket" in upgrades)
