"""Which files a page may send: small ones, whole, to a button that takes files."""

import math
from collections.abc import Mapping
from typing import Any

import viser
from viser import _messages
from viser.infra import ClientId

LARGEST_FILE = 1_000_000
"""Bytes: a hundred times what a set of rates takes."""

PART = 512 * 1024
"""Bytes of each part but the last; viser's pages cut files so."""

MOST_AT_ONCE = 2
"""Files on their way from one page."""

LONGEST_NAME = 255

UPLOADS = (_messages.FileTransferStartUpload, _messages.FileTransferPart)


def is_upload_allowed(
    server: viser.ViserServer, client_id: ClientId, message: _messages.Message
) -> bool:
    """Whether a page may send one of `UPLOADS`: viser itself would keep whatever comes."""
    if not _is_whole(vars(message)):
        return False
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
        and state["transferred_bytes"] + len(message.content) <= state["total_bytes"]
    )


def refuse_upload(server: viser.ViserServer, client_id: ClientId, message: _messages.Message) -> None:
    """Tells a page that its file is not taken, and ends its waiting for it."""
    client = server.get_clients().get(client_id)
    if client is None or not isinstance(message, _messages.FileTransferStartUpload):
        return
    if not _is_whole(vars(message)):
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


def _is_whole(fields: Mapping[str, Any]) -> bool:
    """Whether every field of an upload's message is of its type; a page can send anything."""
    types = {"content": bytes, "part_index": int, "part_count": int, "size_bytes": int}
    return all(
        type(value) is types.get(name, str)
        and (not isinstance(value, str) or len(value) <= LONGEST_NAME)
        for name, value in fields.items()
        if name != "excluded_self_client"
    )
