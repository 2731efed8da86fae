"""How viser's server starts and stops here: behind a front, past its door, and silent.

Its web server is built inside `ViserServer.__init__`, so ours is put in while that runs.
tests/viewer/page/test_server.py fails when viser changes.
"""

import asyncio
import io
import threading
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from functools import partial
from typing import Any

import rich
import websockets.asyncio.server
from viser.infra import WebsockMessageHandler
from websockets.asyncio.server import serve
from websockets.http11 import Request, Response

from modeviz.viewer.page.front import HANDSHAKE_S, Front
from modeviz.viewer.page.wire.acceptor import Acceptor
from modeviz.viewer.page.wire.connection import CLOSING_S, PageConnection
from modeviz.viewer.page.wire.decoding import LARGEST_MESSAGE
from modeviz.viewer.page.wire.loop_troubles import Handler, report, reported, silent_logger
from modeviz.viewer.page.wire.turns import Turns

_one_server_at_a_time, _one_is_quiet_at_a_time = threading.Lock(), threading.Lock()


@contextmanager
def quietly() -> Iterator[None]:
    """While this lasts, viser says nothing; in a notebook rich shows it past what stdout is.

    By one thread at a time: of two that put an output of their own in place one would stay there.
    """
    with _one_is_quiet_at_a_time:
        console = rich.get_console()
        was_quiet, console.quiet = console.quiet, True
        try:
            with redirect_stdout(io.StringIO()):
                yield
        finally:
            console.quiet = was_quiet


def let_leave_in_silence(connection: WebsockMessageHandler) -> None:
    """Has viser say nothing on the terminal of what is still said to a page that has left."""
    connection.get_message_buffer()._warned_push_after_done = True


@contextmanager
def behind(front: Front, turns: Turns, acceptor: Acceptor) -> Iterator[None]:
    """While this lasts, a server that viser starts gets its websockets from a front, past its door."""
    house = front.house

    async def place(connection: PageConnection, request: Request) -> Response | None:
        return await front.door.place(connection, request)

    def inner_serve(handler: Handler, *args: Any, **options: Any):
        asyncio.get_running_loop().set_exception_handler(partial(report, house.notices))
        ours = {
            "process_request": front.door.guard(place),
            "create_connection": partial(PageConnection, house=house, turns=turns),
            "max_size": LARGEST_MESSAGE,
            "open_timeout": HANDSHAKE_S,
            "close_timeout": CLOSING_S,
            "logger": silent_logger(),
        }
        with acceptor.inside():
            return serve(reported(handler, house.notices), *args, **{**options, **ours})

    with _one_server_at_a_time:
        websockets.asyncio.server.serve = inner_serve
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve
