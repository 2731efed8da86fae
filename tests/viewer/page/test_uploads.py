from types import SimpleNamespace

import pytest
import viser
from viser import _messages

from modeviz.viewer.page.wire.decoding import PART
from modeviz.viewer.page.wire.uploads import (
    LARGEST_FILE,
    LARGEST_IN_ALL,
    MOST_AT_ONCE,
    is_upload_allowed,
    take_files_of,
)


def on_the_way(client_id=1, total=100):
    return {"client_id": client_id, "total_bytes": total}


def server(**transfers):
    """A server with a button that takes files, a slider, and files on their way."""
    button = viser.GuiUploadButtonHandle.__new__(viser.GuiUploadButtonHandle)
    gui = SimpleNamespace(
        _gui_input_handle_from_uuid={"button": button, "slider": object()},
        _current_file_upload_states=transfers,
    )
    return SimpleNamespace(gui=gui)


def start(size=100, parts=1, **fields):
    values = {
        "source_component_uuid": "button",
        "transfer_uuid": "new",
        "filename": "rates.csv",
        "mime_type": "text/csv",
        "part_count": parts,
        "size_bytes": size,
    }
    return _messages.FileTransferStartUpload(**{**values, **fields})


def part(**fields):
    values = {
        "source_component_uuid": "button",
        "transfer_uuid": "old",
        "part_index": 0,
        "content": b"x" * 100,
    }
    return _messages.FileTransferPart(**{**values, **fields})


@pytest.mark.parametrize(("size", "parts"), [(0, 0), (1, 1), (PART, 1), (LARGEST_FILE, 2)])
def test_a_small_file_may_come_in_the_parts_it_takes(size, parts):
    assert is_upload_allowed(server(), 1, start(size, parts))


@pytest.mark.parametrize(
    "message",
    [
        start(LARGEST_FILE + 1, 2),
        start(-1, 0),
        start(100, 2),
        start(source_component_uuid="slider"),
        start(source_component_uuid="nobody"),
        start(transfer_uuid="old"),
        part(content=b"x" * 101),
        part(content=b"x" * 99),
        part(part_index=1),
        part(transfer_uuid="unknown"),
        part(source_component_uuid="slider"),
        part(source_component_uuid=None),
    ],
    ids=repr,
)
def test_whatever_else_a_page_sends_may_not_come(message):
    assert not is_upload_allowed(server(old=on_the_way()), 1, message)


def test_parts_may_come_from_the_page_that_started_only():
    assert is_upload_allowed(server(old=on_the_way()), 1, part())
    assert not is_upload_allowed(server(old=on_the_way()), 2, part())


def test_a_page_may_send_few_files_at_once():
    full = {f"file {i}": on_the_way() for i in range(MOST_AT_ONCE)}
    assert not is_upload_allowed(server(**full), 1, start())
    assert is_upload_allowed(server(**full), 2, start())


def large_button_server(most, **transfers):
    large = server(**transfers)
    take_files_of(large.gui._gui_input_handle_from_uuid["button"], most)
    return large


def test_a_button_may_take_larger_files():
    most = 10 * LARGEST_FILE
    parts = -(-most // PART)
    assert is_upload_allowed(large_button_server(most), 1, start(most, parts))
    assert not is_upload_allowed(server(), 1, start(most, parts))
    assert not is_upload_allowed(large_button_server(most), 1, start(most + PART, parts + 1))


def test_what_all_pages_send_at_once_is_bounded():
    most = LARGEST_IN_ALL
    parts = -(-most // PART)
    other = {"file": on_the_way(client_id=2, total=1)}
    assert is_upload_allowed(large_button_server(most), 1, start(most, parts))
    assert not is_upload_allowed(large_button_server(most, **other), 1, start(most, parts))
