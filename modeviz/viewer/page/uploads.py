"""Which files a page may send: small ones, whole, to a button that takes files."""

import math

import viser
from viser import _messages
from viser.infra import ClientId

from modeviz.viewer.page.decoding import PART

LARGEST_FILE = 1_000_000
"""Bytes: a hundred times what a set of rates takes."""

MOST_AT_ONCE = 2
"""Files on their way from one page."""

UPLOADS = (_messages.FileTransferStartUpload, _messages.FileTransferPart)


def is_upload_allowed(
    server: viser.ViserServer, client_id: ClientId, message: _messages.Message
) -> bool:
    """Whether a page may send one of `UPLOADS`: viser itself would keep whatever comes."""
    gui = server.gui
    button = gui._gui_input_handle_from_uuid.get(vars(message)["source_component_uuid"])
    if not isinstance(button, viser.GuiUploadButtonHandle):
        return False
    on_the_way = gui._current_file_upload_states
    if isinstance(message, _messages.FileTransferStartUpload):
        from_here = sum(state["client_id"] == client_id for state in on_the_way.values())
        return (
            message.transfer_uuid not in on_the_way
            and from_here < MOST_AT_ONCE
            and 0 <= message.size_bytes <= LARGEST_FILE
            and message.part_count == math.ceil(message.size_bytes / PART)
        )
    assert isinstance(message, _messages.FileTransferPart)
    state = on_the_way.get(message.transfer_uuid)
    return (
        state is not None
        and state["client_id"] == client_id
        and len(message.content) == min(PART, state["total_bytes"] - PART * message.part_index)
    )


def refuse_upload(server: viser.ViserServer, client_id: ClientId, message: _messages.Message) -> None:
    """Tells a page that its file is not taken, and ends its waiting for it."""
    client = server.get_clients().get(client_id)
    if client is None or not isinstance(message, _messages.FileTransferStartUpload):
        return
    client.add_notification(
        "Not imported",
        f"{message.filename}: found {message.size_bytes / 1000:.0f} kB, expected a file of at most "
        f"{LARGEST_FILE / 1000:.0f} kB.",
        color="red",
    )
    done = _messages.FileTransferPartAck(
        source_component_uuid=message.source_component_uuid,
        transfer_uuid=message.transfer_uuid,
        transferred_bytes=message.size_bytes,
        total_bytes=message.size_bytes,
    )
    client.gui._websock_interface.queue_message(done)
