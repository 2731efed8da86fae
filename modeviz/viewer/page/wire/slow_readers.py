"""Pages that do not read what they are sent: they would hold up what is for them alone."""

import asyncio
import socket
from collections.abc import Callable

READS_WITHIN = 15.0
"""s that may pass until a page reads on."""

MOST_UNSENT = 65536
"""Bytes that the system keeps to send."""

SLOWEST = 1000.0
"""Bytes a second that a page must read then; what is newer replaces what waits for it meanwhile."""


class ReadingWatch:
    """Looks whether what waits to be sent is read, from when there is too much of it."""

    def __init__(self, give_up: Callable[[], None]) -> None:
        """Looks at nothing yet; `give_up` ends a connection of which hardly anything is read."""
        self._give_up = give_up
        self._next: asyncio.TimerHandle | None = None

    def begin(self, transport: asyncio.WriteTransport) -> None:
        """Looks again in a while; called in the loop."""
        n_bytes = transport.get_write_buffer_size()
        loop = asyncio.get_running_loop()
        self._next = loop.call_later(READS_WITHIN, self._look, transport, n_bytes)

    def end(self) -> None:
        """Looks no more: so much has been read, or nobody is there."""
        if self._next is not None:
            self._next.cancel()

    def _look(self, transport: asyncio.WriteTransport, n_before: int) -> None:
        n_read = n_before - transport.get_write_buffer_size()
        if n_read < READS_WITHIN * SLOWEST:
            self._give_up()
        else:
            self.begin(transport)


def hold_little(transport: asyncio.BaseTransport) -> None:
    """Has the system keep little of what is not sent yet: here it is replaced by what is newer."""
    connection = transport.get_extra_info("socket")
    if connection is not None and hasattr(socket, "TCP_NOTSENT_LOWAT"):
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NOTSENT_LOWAT, MOST_UNSENT)
