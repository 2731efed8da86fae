"""Messages that no page sends: noise, those of pages broken, and other kinds, with hostile values."""

import random
from collections.abc import Iterator, Sequence
from typing import Any

from viser import _messages

from benchmarks.page_client import CAMERA, wire

KNOWN: dict[str, dict[str, Any]] = {
    "ViewerCameraMessage": CAMERA,
    "GuiUpdateMessage": {"uuid": "no widget", "updates": {"value": 1.0}},
    "GetRenderResponseMessage": {"payload": b"", "render_uuid": "no picture"},
    "CommandTriggerMessage": {"uuid": "no command"},
    "TransformControlsDragStartMessage": {"name": "/no/handle"},
    "TransformControlsUpdateMessage": {
        "name": "/no/handle",
        "wxyz": (1.0, 0.0, 0.0, 0.0),
        "position": (0.0, 0.0, 0.0),
    },
    "FileTransferStartUpload": {
        "source_component_uuid": "no button",
        "transfer_uuid": "no file",
        "filename": "../../vehicle.toml",
        "mime_type": "text/plain",
        "part_count": 10**9,
        "size_bytes": 10**15,
    },
}
"""What a page says, of things that are not there."""

OTHERS = sorted(name for name in vars(_messages) if name.endswith("Message") and name not in KNOWN)
"""Kinds that only servers send."""

HOSTILE: tuple[Any, ...] = (
    *(float("nan"), float("inf"), -1e308, 2**63, -(2**63), True, None),
    *(
        "",
        "\x00",
        "../../etc/passwd",
        "<script>alert(1)</script>",
        "{{7*7}}",
        "'; DROP TABLE state;--",
        "\x1b]0;x\x07",
    ),
    *(
        "x" * 5000,
        b"\x00" * 100,
        [],
        {},
        [[]] * 50,
        [float("nan")] * 4,
        {"__class__": "x"},
        {"value": {}},
    ),
)


def malformed(n_messages: int, seed: int, widgets: Sequence[str] = ()) -> Iterator[bytes | str]:
    """Yields messages of which none changes anything.

    Args:
        n_messages: to be had.
        seed: of what is chosen.
        widgets: ids of some that are there, and that have no such values.
    """
    chosen = random.Random(seed)
    ways = [_noise, _text, _broken, _cut, _wrong_field, _missing_field, _other_kind, _deep]
    for i in range(n_messages):
        if widgets and i % 3 == 0:
            yield _wrong_value(chosen, widgets)
        else:
            yield chosen.choice(ways)(chosen)


def _noise(chosen: random.Random) -> bytes:
    return chosen.randbytes(chosen.randrange(300))


def _text(chosen: random.Random) -> str:
    return chosen.choice(('{"type": "GuiUpdateMessage"}', "", "GET / HTTP/1.1\r\n\r\n", "\x00" * 50))


def _known(chosen: random.Random) -> tuple[str, dict[str, Any]]:
    return chosen.choice(list(KNOWN.items()))


def _broken(chosen: random.Random) -> bytes:
    kind, fields = _known(chosen)
    raw = bytearray(wire(kind, **fields))
    for _ in range(chosen.randrange(1, 6)):
        raw[chosen.randrange(len(raw))] = chosen.randrange(256)
    return bytes(raw)


def _cut(chosen: random.Random) -> bytes:
    kind, fields = _known(chosen)
    raw = wire(kind, **fields)
    return raw[: chosen.randrange(len(raw))]


def _wrong_field(chosen: random.Random) -> bytes:
    kind, fields = _known(chosen)
    return wire(kind, **{**fields, chosen.choice([*fields, "extra"]): chosen.choice(HOSTILE)})


def _missing_field(chosen: random.Random) -> bytes:
    kind, fields = _known(chosen)
    left_out = chosen.choice(list(fields))
    return wire(kind, **{name: value for name, value in fields.items() if name != left_out})


def _other_kind(chosen: random.Random) -> bytes:
    return wire(chosen.choice(OTHERS), **chosen.choice(list(KNOWN.values())))


def _deep(chosen: random.Random) -> bytes:
    return b"\x81\xa1a" * chosen.randrange(2, 50) + b"\x80"


def _wrong_value(chosen: random.Random, widgets: Sequence[str]) -> bytes:
    updates = chosen.choice(
        ({"value": chosen.choice(HOSTILE)}, {"update_cb": []}, {"removed": True}, {}, {"min": -1e9})
    )
    return wire("GuiUpdateMessage", uuid=chosen.choice(widgets), updates=updates)
