"""The second check of a message, inside viser: may its page say it, and can its widget have that value?

A page without control only looks, see `looking`; what it changed on its own screen is put back at once.
Values from a page are anybody's: viser stores 1e9 and NaN, and lets a page set any attribute of a
widget. `decoding` lets only kinds through that we use; here a value must be one that its widget can
produce.
"""

import asyncio
import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import viser
from viser import _messages
from viser.infra import ClientId, WebsockClientConnection

from modeviz.viewer.page.connection import expect
from modeviz.viewer.page.decoding import LONGEST_TEXT
from modeviz.viewer.page.looking import DRAGS, only_looks, put_back_drag, widget_of
from modeviz.viewer.page.uploads import UPLOADS, is_upload_allowed, refuse_upload
from modeviz.viewer.page.visitors import Visitors
from modeviz.viewer.page.write_back import DELAY

NO_CONTROL = "only who presents can change something."
"""Why a file is not taken from who looks."""

if TYPE_CHECKING:
    from viser._gui_handles import _GuiInputHandle


Report = Callable[[ClientId, Exception], None]


def gate_messages(server: viser.ViserServer, report: Report, visitors: Visitors) -> None:
    """Puts the checks before a server's and all its clients' handling of messages.

    Args:
        server: whose messages.
        report: told of the client and what handling its message raised.
        visitors: who may say what.
    """
    websock = server._websock_server
    _gate(server, report, visitors, websock, None)
    websock.on_client_connect(
        lambda connection: _gate(server, report, visitors, connection, connection)
    )


def _gate(
    server: viser.ViserServer,
    report: Report,
    visitors: Visitors,
    handler: Any,
    connection: WebsockClientConnection | None,
) -> None:
    """Puts the checks before one handler of messages; a client's own also corrects its screen."""
    handle = handler._handle_incoming_message

    async def reported(client_id: ClientId, message: _messages.Message) -> None:
        try:
            await checked(client_id, message)
        except Exception as error:
            report(client_id, error)

    async def checked(client_id: ClientId, message: _messages.Message) -> None:
        if not visitors.has_control(client_id) and not only_looks(server, client_id, message):
            if connection is not None:
                _put_back(server, client_id, connection, message)
                visitors.refuse(client_id)
            return
        if isinstance(message, UPLOADS):
            if connection is None:  # only shared widgets take files
                if is_upload_allowed(server, client_id, message):
                    if isinstance(message, _messages.FileTransferStartUpload):
                        expect(server, client_id, message.size_bytes)
                    await handle(client_id, message)
                else:
                    refuse_upload(server, client_id, message)
            return
        if not isinstance(message, _messages.GuiUpdateMessage):
            await handle(client_id, message)
            return
        widget = widget_of(server, client_id, message.uuid)
        if widget is None:
            return
        if set(message.updates) == {"value"} and is_possible(widget, message.updates["value"]):
            await handle(client_id, message)
        elif connection is not None:
            _correct_now_and_later(server, client_id, connection, widget)

    handler._handle_incoming_message = reported


def _put_back(
    server: viser.ViserServer,
    client_id: ClientId,
    connection: WebsockClientConnection,
    message: _messages.Message,
) -> None:
    """Shows a page as things are what it has changed on its screen without control."""
    if isinstance(message, _messages.GuiUpdateMessage):
        widget = widget_of(server, client_id, message.uuid)
        if widget is not None:
            _correct_now_and_later(server, client_id, connection, widget)
    elif isinstance(message, UPLOADS):
        refuse_upload(server, client_id, message, NO_CONTROL)
    elif isinstance(message, DRAGS):
        put_back_drag(server, connection, message)


def _correct_now_and_later(
    server: viser.ViserServer,
    client_id: ClientId,
    connection: WebsockClientConnection,
    widget: "_GuiInputHandle",
) -> None:
    """Sends a page the value that a widget has; again, as that can cross what the page says next."""
    if isinstance(widget, viser.GuiUploadButtonHandle):
        return
    _correct(connection, widget)
    again = partial(_correct_if_there, server, client_id, connection, widget)
    asyncio.get_running_loop().call_later(DELAY, again)


def _correct(connection: WebsockClientConnection, widget: "_GuiInputHandle") -> None:
    """Sends a page the value that a widget has."""
    true_value = {"value": widget._impl.value}
    connection.queue_message(_messages.GuiUpdateMessage(widget._impl.uuid, true_value))


def _correct_if_there(
    server: viser.ViserServer,
    client_id: ClientId,
    connection: WebsockClientConnection,
    widget: "_GuiInputHandle",
) -> None:
    """The same, unless the page has been closed meanwhile."""
    if client_id in server._websock_server._live_connections:
        _correct(connection, widget)


def is_possible(widget: "_GuiInputHandle[Any]", value: Any) -> bool:
    """Whether a value is one that the widget can produce: of its type, in its range, of its choices."""
    props, current = widget._impl.props, widget._impl.value
    options = getattr(props, "options", None)
    if options is not None:
        return value in options
    low, high = getattr(props, "min", None), getattr(props, "max", None)
    if isinstance(current, tuple):
        return (
            isinstance(value, (tuple, list))
            and len(value) == len(current)
            and all(_is_number(v, _at(low, i), _at(high, i)) for i, v in enumerate(value))
        )
    if isinstance(current, bool):
        return isinstance(value, bool)
    if isinstance(current, (int, float)):
        return _is_number(value, low, high)
    return isinstance(current, str) and isinstance(value, str) and len(value) <= LONGEST_TEXT


def _at(bound: Any, index: int) -> float | None:
    """A bound of one component, from a bound for each or for all."""
    return bound[index] if isinstance(bound, (tuple, list)) else bound


def _is_number(value: Any, low: float | None, high: float | None) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return False
    return (low is None or value >= low) and (high is None or value <= high)
