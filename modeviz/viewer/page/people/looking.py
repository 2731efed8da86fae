"""What a page may say that only looks: what is its own, and what it says because it was asked.

Everything else is refused, whatever kinds of messages or shared widgets are added: one of these is
marked if using it changes nothing that others see, and a page's own widget is marked if using it does.
"""

from typing import Any

import viser
from viser import _messages
from viser.infra import ClientId, WebsockClientConnection

OWN = (
    _messages.ViewerCameraMessage,
    _messages.GetRenderResponseMessage,
    _messages.FileTransferPartAck,
)
"""Where a page's own camera is, and its answers to what it was sent."""

DRAGS = (
    _messages.TransformControlsDragStartMessage,
    _messages.TransformControlsUpdateMessage,
    _messages.TransformControlsDragEndMessage,
)


def let_all_use(handle: Any) -> None:
    """Lets pages without control use a shared widget or a command: others see nothing of it."""
    vars(handle)["is_for_all"] = True


def leave_to_control(handle: Any) -> None:
    """Keeps a page from using a widget of its own once it has no control: it decides something."""
    vars(handle)["is_for_all"] = False


def only_looks(server: viser.ViserServer, client_id: ClientId, message: _messages.Message) -> bool:
    """Whether a page that has no control may say that."""
    if isinstance(message, OWN):
        return True
    if isinstance(message, _messages.GuiUpdateMessage):
        widget = widget_of(server, client_id, message.uuid)
        return widget is not None and vars(widget).get("is_for_all", _is_own(server, widget))
    if isinstance(message, _messages.CommandTriggerMessage):
        command = server.gui._command_handle_from_uuid.get(message.uuid)
        return command is not None and vars(command).get("is_for_all", False)
    return False


def _is_own(server: viser.ViserServer, widget: Any) -> bool:
    """Whether a widget is of one page alone."""
    return widget._impl.gui_api is not server.gui


def widget_of(server: viser.ViserServer, client_id: ClientId, uuid: str) -> Any:
    """Return the widget of that id among the shared ones and the page's own; None if there is none."""
    client = server.get_clients().get(client_id)
    for gui in (server.gui, client.gui if client else None):
        if gui is not None and uuid in gui._gui_input_handle_from_uuid:
            return gui._gui_input_handle_from_uuid[uuid]
    return None


def put_back_drag(
    server: viser.ViserServer, connection: WebsockClientConnection, message: _messages.Message
) -> None:
    """Puts a handle in the scene back on a page that dragged it and may not."""
    handle = server.scene._handle_from_transform_controls_name.get(vars(message)["name"])
    if handle is not None:
        name = handle.name
        connection.queue_message(_messages.SetPositionMessage(name, tuple(handle.position.tolist())))
        connection.queue_message(_messages.SetOrientationMessage(name, tuple(handle.wxyz.tolist())))
