"""The second check of a message, inside viser: may its page say it, and can its widget have that value?

A page without control only looks, see `looking`; what it changed on its own screen is put back at once.
Values from a page are anybody's: viser stores 1e9 and NaN, and lets a page set any attribute of a
widget. `decoding` lets only kinds through that we use; here a value must be one that its widget can
produce.
"""

import asyncio
from collections.abc import Callable, Coroutine
from functools import partial
from typing import TYPE_CHECKING, Any

import viser
from viser import _messages
from viser.infra import ClientId, WebsockClientConnection

from modeviz.viewer.page.people.looking import DRAGS, only_looks, put_back_drag, widget_of
from modeviz.viewer.page.people.visitors import Visitors
from modeviz.viewer.page.possible_values import is_possible
from modeviz.viewer.page.widgets.write_back import DELAY
from modeviz.viewer.page.wire.connection import expect
from modeviz.viewer.page.wire.uploads import UPLOADS, is_upload_allowed, refuse_upload

NO_CONTROL = "only who presents can change something."
"""Why a file is not taken from who looks."""

if TYPE_CHECKING:
    from viser._gui_handles import _GuiInputHandle


Report = Callable[[ClientId, Exception], None]
Handle = Callable[[ClientId, _messages.Message], Coroutine[Any, Any, None]]


def gate_messages(server: viser.ViserServer, report: Report, visitors: Visitors) -> None:
    """Puts the checks before a server's and all its clients' handling of messages.

    Args:
        server: whose messages.
        report: told of the client and what handling its message raised.
        visitors: who may say what.
    """

    def gate(handler: Any, connection: WebsockClientConnection | None) -> None:
        handle = handler._handle_incoming_message
        handler._handle_incoming_message = _Gate(server, report, visitors, handle, connection).take

    websock = server._websock_server
    gate(websock, None)
    websock.on_client_connect(lambda connection: gate(connection, connection))


class _Gate:
    """The checks before one handler of messages; a client's own also corrects its screen."""

    def __init__(
        self,
        server: viser.ViserServer,
        report: Report,
        visitors: Visitors,
        handle: Handle,
        connection: WebsockClientConnection | None,
    ) -> None:
        """Takes nothing yet.

        Args:
            server: whose messages.
            report: as of `gate_messages`.
            visitors: who may say what.
            handle: what messages that pass go to.
            connection: of the client whose handler it is; None: of the server's, for shared widgets.
        """
        self._server, self._report, self._visitors = server, report, visitors
        self._handle, self._connection = handle, connection

    async def take(self, client_id: ClientId, message: _messages.Message) -> None:
        """Handles a message that may be said, and reports where that goes wrong."""
        try:
            await self._judge(client_id, message)
        except Exception as error:
            self._report(client_id, error)

    async def _judge(self, client_id: ClientId, message: _messages.Message) -> None:
        has_control = self._visitors.has_control(client_id)
        if not has_control and not only_looks(self._server, client_id, message):
            self._refuse(client_id, message)
        elif isinstance(message, UPLOADS):
            await self._take_upload(client_id, message)
        elif isinstance(message, _messages.GuiUpdateMessage):
            await self._take_value(client_id, message)
        else:
            await self._handle(client_id, message)

    def _refuse(self, client_id: ClientId, message: _messages.Message) -> None:
        """Shows a page as things are what it has changed on its screen without control."""
        connection = self._connection
        if connection is None:
            return
        if isinstance(message, _messages.GuiUpdateMessage):
            self._correct(client_id, widget_of(self._server, client_id, message.uuid))
        elif isinstance(message, UPLOADS):
            refuse_upload(self._server, client_id, message, NO_CONTROL)
        elif isinstance(message, DRAGS):
            put_back_drag(self._server, connection, message)
        self._visitors.refuse(client_id)

    async def _take_upload(self, client_id: ClientId, message: _messages.Message) -> None:
        """Takes a part of a file, which only shared widgets do."""
        if self._connection is not None:
            return
        if not is_upload_allowed(self._server, client_id, message):
            refuse_upload(self._server, client_id, message)
            return
        if isinstance(message, _messages.FileTransferStartUpload):
            expect(self._server, client_id, message.size_bytes)
        await self._handle(client_id, message)

    async def _take_value(self, client_id: ClientId, message: _messages.GuiUpdateMessage) -> None:
        """Takes a value that its widget can have, or corrects the screen."""
        widget = widget_of(self._server, client_id, message.uuid)
        if widget is None:
            return
        if set(message.updates) == {"value"} and is_possible(widget, message.updates["value"]):
            await self._handle(client_id, message)
        else:
            self._correct(client_id, widget)

    def _correct(self, client_id: ClientId, widget: "_GuiInputHandle | None") -> None:
        """Sends a page the value that a widget has, and again: it can cross what the page says next."""
        connection = self._connection
        if connection is None or widget is None or isinstance(widget, viser.GuiUploadButtonHandle):
            return
        _send_value(connection, widget)
        again = partial(self._correct_if_there, client_id, connection, widget)
        asyncio.get_running_loop().call_later(DELAY, again)

    def _correct_if_there(
        self, client_id: ClientId, connection: WebsockClientConnection, widget: "_GuiInputHandle"
    ) -> None:
        """Sends it unless the page has been closed meanwhile."""
        if client_id in self._server._websock_server._live_connections:
            _send_value(connection, widget)


def _send_value(connection: WebsockClientConnection, widget: "_GuiInputHandle") -> None:
    """Sends a page the value that a widget has."""
    true_value = {"value": widget._impl.value}
    connection.queue_message(_messages.GuiUpdateMessage(widget._impl.uuid, true_value))
