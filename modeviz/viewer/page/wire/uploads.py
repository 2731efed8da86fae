"""Which files a page may send: small ones, whole, to a button that takes files."""

import math

import viser
from viser import _messages
from viser.infra import ClientId

from modeviz.viewer.page.wire.decoding import PART

LARGEST_FILE = 1_000_000
"""Bytes: a hundred times what a set of rates takes."""

LARGEST_IN_ALL = 300_000_000
"""Bytes of files on their way from all pages: viser keeps them in memory."""

MOST_AT_ONCE = 2
"""Files on their way from one page."""

UPLOADS = (_messages.FileTransferStartUpload, _messages.FileTransferPart)


def take_files_of(button: viser.GuiUploadButtonHandle, most: int) -> None:
    """Lets a button take files of so many bytes, and not of `LARGEST_FILE`."""
    vars(button)["largest_file"] = most


def _largest_of(server: viser.ViserServer, message: _messages.FileTransferStartUpload) -> int:
    button = server.gui._gui_input_handle_from_uuid.get(message.source_component_uuid or "")
    return LARGEST_FILE if button is None else vars(button).get("largest_file", LARGEST_FILE)


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
        in_all = sum(state["total_bytes"] for state in on_the_way.values())
        return (
            message.transfer_uuid not in on_the_way
            and from_here < MOST_AT_ONCE
            and 0 <= message.size_bytes <= _largest_of(server, message)
            and in_all + message.size_bytes <= LARGEST_IN_ALL
            and message.part_count == math.ceil(message.size_bytes / PART)
        )
    assert isinstance(message, _messages.FileTransferPart)
    state = on_the_way.get(message.transfer_uuid)
    return (
        state is not None
        and state["client_id"] == client_id
        and len(message.content) == min(PART, state["total_bytes"] - PART * message.part_index)
    )


def refuse_upload(
    server: viser.ViserServer, client_id: ClientId, message: _messages.Message, why: str = ""
) -> None:
    """Tells a page that its file is not taken, and ends its waiting for it.

    Args:
        server: of the page.
        client_id: of the page.
        message: what it sent.
        why: the reason, if it is none of size or number.
    """
    client = server.get_clients().get(client_id)
    if client is None or not isinstance(message, _messages.FileTransferStartUpload):
        return
    largest = _largest_of(server, message)
    reason = why or f"found {_size(message.size_bytes)}, expected a file of at most {_size(largest)}."
    if not why and message.size_bytes <= largest:
        reason = "others are still on their way; try again when they have come."
    client.add_notification("Not imported", f"{message.filename}: {reason}", color="red")
    done = _messages.FileTransferPartAck(
        source_component_uuid=message.source_component_uuid,
        transfer_uuid=message.transfer_uuid,
        transferred_bytes=message.size_bytes,
        total_bytes=message.size_bytes,
    )
    client.gui._websock_interface.queue_message(done)


def _size(n_bytes: int) -> str:
    return f"{n_bytes / 1e6:.0f} MB" if n_bytes > 1e7 else f"{n_bytes / 1000:.0f} kB"
