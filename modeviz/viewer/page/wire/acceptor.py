"""Where a websocket server gets its connections: from whoever accepted them, in place of listening."""

import asyncio
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Factory = Callable[[], asyncio.BaseProtocol]


class Acceptor:
    """Has connections that were accepted elsewhere served in the loop of one server."""

    def __init__(self) -> None:
        """Serves none before a server was built `inside` it."""
        self._loop: asyncio.AbstractEventLoop | None = None
        self._factory: Factory | None = None

    @property
    def is_ready(self) -> bool:
        """Whether a server has been built inside it."""
        return self._factory is not None

    @contextmanager
    def inside(self) -> Iterator[None]:
        """While this lasts, what the running loop is asked to listen for comes by `take` instead."""
        loop = asyncio.get_running_loop()

        async def create_server(factory: Factory, *_: Any, **__: Any) -> asyncio.AbstractServer:
            self._loop, self._factory = loop, factory
            return _Deaf(loop)

        vars(loop)["create_server"] = create_server
        try:
            yield
        finally:
            del vars(loop)["create_server"]

    def take(self, connection: socket.socket) -> None:
        """Serves an accepted connection that nobody has read, or closes it if the server has ended."""
        loop, factory = self._loop, self._factory
        try:
            assert loop is not None
            assert factory is not None
            served = loop.connect_accepted_socket(factory, connection)
        except RuntimeError:
            connection.close()
            return
        try:
            asyncio.run_coroutine_threadsafe(served, loop)
        except RuntimeError:  # the loop is closed
            served.close()
            connection.close()


class _Deaf(asyncio.AbstractServer):
    """A server that listens to nothing."""

    sockets: tuple[socket.socket, ...] = ()

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop, self._is_closed = loop, False

    def close(self) -> None:
        self._is_closed = True

    def get_loop(self) -> asyncio.AbstractEventLoop:
        return self._loop

    def is_serving(self) -> bool:
        return not self._is_closed

    async def wait_closed(self) -> None:
        """Nothing is open."""
