"""What goes wrong in the loops of servers, said once."""

import asyncio
import logging
from collections.abc import Callable, Coroutine
from typing import Any

from websockets.asyncio.server import ServerConnection
from websockets.exceptions import ConnectionClosed

from modeviz.viewer.page.wire.notices import Notices

Handler = Callable[[ServerConnection], Coroutine[Any, Any, None]]


def silent_logger() -> logging.Logger:
    """Return a logger that keeps silent on what is no request, such as a port scan."""
    logger = logging.getLogger("modeviz.websockets")
    logger.setLevel(logging.CRITICAL)
    return logger


def report(notices: Notices, _loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """Says once what went wrong in a loop, such as that there are no more files to open."""
    error = context.get("exception")
    if isinstance(error, OSError):
        notices.note("the server", f"cannot take a connection: {error.strerror}")
    elif isinstance(error, Exception):
        notices.mistake(error)
    else:
        notices.note("the server", f"has trouble: {context['message']}")


def reported(handler: Handler, notices: Notices) -> Handler:
    """Return a handler of connections that says once where it went wrong."""

    async def handle(connection: ServerConnection) -> None:
        try:
            await handler(connection)
        except ConnectionClosed:
            pass
        except Exception as error:
            notices.mistake(error)

    return handle
