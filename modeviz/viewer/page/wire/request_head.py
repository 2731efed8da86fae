"""The first lines of a request, looked at before anybody reads them."""

import asyncio
import select
import socket
from urllib.parse import parse_qsl, urlsplit

from websockets import Headers
from websockets.http11 import Request

SOON, LATER = 0.02, 0.5
"""s between two looks whether the rest of a request has come: at first, and at last."""

LARGEST = 65536
"""Bytes of what is looked at; a request for a page or a websocket has far fewer."""


def request_head(connection: socket.socket) -> Request | None:
    """Return the request that comes, and leave it to be read; None if there is more to come.

    Who reads it judges whether it is a good one: of what is none, this is no request for anything.

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


async def awaited_head(loop: asyncio.AbstractEventLoop, connection: socket.socket) -> Request:
    """Return what a connection asks for, which stays to be read.

    Raises:
        OSError: it is closed.
    """
    came = loop.create_future()
    loop.add_reader(connection, lambda: came.done() or came.set_result(None))
    try:
        await came
    finally:
        loop.remove_reader(connection)
    wait = SOON
    while (request := request_head(connection)) is None:
        await asyncio.sleep(wait)
        wait = min(2 * wait, LATER)
    return request


def has_left(connection: socket.socket) -> bool:
    """Return whether the other end has closed a connection, of which something is still to be read."""
    left = select.POLLHUP | select.POLLERR | getattr(select, "POLLRDHUP", 0)
    poll = select.poll()
    poll.register(connection, left)
    return any(events & left for _, events in poll.poll(0))


def query_of(request: Request) -> dict[str, str]:
    """Return what the address of a request says after its question mark.

    Raises:
        ValueError: it is no address.
    """
    return dict(parse_qsl(urlsplit(request.path).query, keep_blank_values=True))


def is_websocket(request: Request) -> bool:
    """Return whether a request wants a websocket."""
    return "websocket" in (each.lower() for each in request.headers.get_all("Upgrade"))


def _parsed(head: str) -> Request:
    line, *others = head.split("\r\n")
    path = line.split(" ")[1] if line.count(" ") == 2 else ""
    pairs = (each.partition(":")[::2] for each in others)
    return Request(path, Headers([(name.strip(), value.strip()) for name, value in pairs]))
