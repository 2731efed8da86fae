"""What messages of pages may hold, before anything is made of them."""

import math
import struct
import tracemalloc
from contextlib import suppress

import msgspec.msgpack
import pytest
from viser import _messages
from visitors import CAMERA, PART_OF_FILE, encoded

from modeviz.viewer.page.wire import decoding
from modeviz.viewer.page.wire.decoding import (
    LARGEST_WRONG,
    MOST_ITEMS,
    MessageError,
    TooMuchError,
    checked,
)

UPDATE = {"type": "GuiUpdateMessage", "uuid": "a", "updates": {"value": 1.0}}
CLICK = {
    "type": "SceneNodeClickMessage",
    "name": "/mounts/C1",
    "instance_index": None,
    "ray_origin": (0.0, 0.0, 0.0),
    "ray_direction": (1.0, 0.0, 0.0),
    "screen_pos": (0.5, 0.5),
    "modifier": None,
    "owner": "",
}
DRAG = {
    "type": "TransformControlsUpdateMessage",
    "name": "/mount handle",
    "wxyz": (1.0, 0.0, 0.0, 0.0),
    "position": (0.0, 1.0, 2.0),
    "owner": "",
}
START = {
    "type": "FileTransferStartUpload",
    "source_component_uuid": "button",
    "transfer_uuid": "new",
    "filename": "rates.csv",
    "mime_type": "text/csv",
    "part_count": 1,
    "size_bytes": 100,
}


def chunk(kind, content=b""):
    return struct.pack(">I4s", len(content), kind) + content + b"\0" * 4


def png(width=8, height=8, *chunks):
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + b"".join(chunks) + chunk(b"IDAT", b"x")


def picture(payload):
    return {"type": "GetRenderResponseMessage", "payload": payload, "render_uuid": "a"}


@pytest.mark.parametrize(
    "message",
    [
        UPDATE,
        CAMERA,
        CLICK,
        DRAG,
        *(
            {"type": f"TransformControlsDrag{end}Message", "name": "a", "owner": ""}
            for end in ("Start", "End")
        ),
        START,
        PART_OF_FILE,
        picture(png()),
        picture(png(4096, 4096, chunk(b"tEXt", b"acTL"))),
        picture(b""),
        {"type": "CommandTriggerMessage", "uuid": "a"},
        *({**UPDATE, "updates": {"value": v}} for v in (True, None, "text", 3, [1.0, 2.0, 3.0])),
    ],
    ids=lambda message: message["type"],
)
def test_what_pages_say_comes_through_unchanged(message):
    read = msgspec.msgpack.decode(checked(encoded(message)))
    assert read == msgspec.msgpack.decode(encoded(message))


@pytest.mark.parametrize(
    "message",
    [
        {**CAMERA, "image_height": 0},
        {**CAMERA, "image_width": 30_000},
        {**CAMERA, "wxyz": (0.0, 0.0, 0.0, 0.0)},
        {**CAMERA, "wxyz": (1.0, 0.0, 0.0)},
        {**CAMERA, "position": (math.nan, 0.0, 0.0)},
        {**CAMERA, "near": math.inf},
        {**CAMERA, "fov": 4.0},
        {**UPDATE, "uuid": []},
        {**UPDATE, "uuid": "x" * 300},
        {**UPDATE, "updates": 5},
        {**UPDATE, "updates": {"value": 1.0, "removed": True}},
        {**UPDATE, "updates": {"value": {}}},
        {**UPDATE, "updates": {"value": [[1.0]]}},
        {**UPDATE, "updates": {"value": [1.0] * (MOST_ITEMS + 1)}},
        {**UPDATE, "more": 1},
        {**START, "size_bytes": math.nan},
        {**START, "size_bytes": True},
        {**START, "part_count": -1},
        {**START, "filename": "x" * 300},
        {**PART_OF_FILE, "content": "x"},
        {**PART_OF_FILE, "source_component_uuid": None},
        picture(b"GIF89a"),
        picture(png(30_000, 20_000)),
        picture(png(8, 8, chunk(b"acTL", struct.pack(">II", 100_000, 0)))),
        picture(png()[:40]),
        {"type": "ShareUrlRequest"},
        {"uuid": "a"},
        [],
        5,
    ],
    ids=lambda message: str(message)[:60],
)
def test_what_no_page_says_is_refused(message):
    with pytest.raises(MessageError):
        checked(encoded(message))


def test_text_and_what_is_no_msgpack_is_refused():
    for raw in ("text", b"", b"\xc1", b"\x81"):
        with pytest.raises(MessageError):
            checked(raw)


def test_texts_that_are_no_utf_8_are_refused_wherever_they_are():
    raw = encoded(UPDATE)
    for place in range(len(raw)):
        with suppress(MessageError):
            checked(raw[:place] + b"\xe5" + raw[place + 1 :])
    with pytest.raises(MessageError):
        checked(raw.replace(b"uuid", b"uu\xe5d"))


def test_a_kind_that_is_said_twice_is_not_read_in_two_ways():
    """viser reads the last of a key, so it gets a message that has one."""
    fields = b"\xa4uuid\xa1a\xa7updates\x81\xa5value\x01"
    raw = b"\x84" + b"\xa4type\xb0GuiUpdateMessage" + fields + b"\xa4type\xafShareUrlRequest"
    with pytest.raises(MessageError):
        checked(raw)
    twice = b"\x84\xa4type\xb0GuiUpdateMessage" + fields + b"\xa4uuid\xa1b"
    assert checked(twice).count(b"uuid") == 1


N_MAPS = 20_000_000
MAPS = b"\xdd" + N_MAPS.to_bytes(4, "big") + b"\x80" * N_MAPS


@pytest.mark.parametrize(
    "raw",
    [
        pytest.param(b"\x81\xa4type" + MAPS, id="as a kind"),
        pytest.param(
            b"\x83\xa4type\xb0GuiUpdateMessage\xa4uuid\xa1a\xa7updates\x81\xa5value" + MAPS,
            id="as a value",
        ),
        pytest.param(b"\x81\xa1x" * (N_MAPS // 3) + b"\x80", id="in each other"),
        pytest.param(
            encoded({**CAMERA, "wxyz": [0.5] * (5_000_000 // 9)}), id="a quaternion of half a million"
        ),
    ],
)
def test_what_is_there_to_exhaust_is_refused_before_anything_is_made_of_it(raw):
    tracemalloc.start()
    try:
        with pytest.raises(TooMuchError):
            checked(raw)
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert most < 1_000_000


def test_a_deep_message_is_too_much_however_small():
    raw = b"\x82\xa1x" + b"\x91" * (LARGEST_WRONG - 100) + b"\x80" + b"\xa4type\xa1x"
    with pytest.raises(TooMuchError):
        checked(raw)


def test_every_kind_has_the_fields_that_viser_reads():
    kinds = [kind for kind in vars(decoding).values() if isinstance(kind, type)]
    wire = [kind for kind in kinds if issubclass(kind, decoding._Wire) and kind is not decoding._Wire]
    assert wire
    for kind in wire:
        fields = getattr(_messages, kind.__name__).__dataclass_fields__
        assert set(kind.__struct_fields__) == set(fields), kind.__name__
