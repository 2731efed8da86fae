"""The first check of a message, on its bytes, before viser: is it of a kind that we use?

msgspec looks at the number of items before it makes any, and goes no deeper than the types here do.
What viser reads afterwards is written anew, so that it cannot find anything else in it.
"""

import math
from typing import Annotated

import msgspec

from modeviz.viewer.page.wire.single_png import is_single_png

LONGEST_TEXT = 4000
LONGEST_NAME = 255
MOST_ITEMS = 100
"""In a list that a widget may have as its value."""

PART = 512 * 1024
"""Bytes of each part of a file but the last; viser's pages cut files so."""

LARGEST_MESSAGE = PART + 1024
"""Bytes: a part of a file."""

LARGEST_WRONG = 16 * 1024
"""Bytes of a message that is merely wrong; a larger one is meant to harm."""

LARGEST_SIDE = 16384
"""Pixels of a page."""

LARGEST_PICTURE = 4096
"""Pixels of a side of one that a page is asked for; more, graphics cards may not draw."""

FARTHEST = 1e9
"""m: of anything in a scene."""

Name = Annotated[str, msgspec.Meta(max_length=LONGEST_NAME)]
Text = Annotated[str, msgspec.Meta(max_length=LONGEST_TEXT)]
Count = Annotated[int, msgspec.Meta(ge=0)]
Side = Annotated[float, msgspec.Meta(ge=1, le=LARGEST_SIDE)]
Angle = Annotated[float, msgspec.Meta(gt=0, lt=math.pi)]
Coordinate = Annotated[float, msgspec.Meta(ge=-FARTHEST, le=FARTHEST)]
Distance = Annotated[float, msgspec.Meta(gt=0, le=FARTHEST)]
Point = tuple[Coordinate, Coordinate, Coordinate]
Quaternion = tuple[Coordinate, Coordinate, Coordinate, Coordinate]
Single = bool | int | float | Text | None
Value = bool | int | float | Text | None | Annotated[list[Single], msgspec.Meta(max_length=MOST_ITEMS)]


class MessageError(Exception):
    """A message that no page of ours sends."""


class TooMuchError(MessageError):
    """One that is there to exhaust the server."""


class _Wire(msgspec.Struct, tag_field="type", forbid_unknown_fields=True):
    """A message on its way; its class is called as viser's."""


class GuiUpdateMessage(_Wire):
    """A widget's new value."""

    uuid: Name
    updates: Annotated[dict[Name, Value], msgspec.Meta(max_length=1)]


class ViewerCameraMessage(_Wire):
    """The place of a page's camera and the size of its picture."""

    wxyz: Quaternion
    position: Point
    fov: Angle
    near: Distance
    far: Distance
    image_height: Side
    image_width: Side
    look_at: Point
    up_direction: Point

    def __post_init__(self) -> None:
        if not any(self.wxyz):
            raise ValueError("no orientation")


class GetRenderResponseMessage(_Wire):
    """A picture that was asked for; it is empty where the page could not draw it."""

    payload: bytes
    render_uuid: Name

    def __post_init__(self) -> None:
        if self.payload and not is_single_png(self.payload, LARGEST_PICTURE):
            raise ValueError("no picture")


class SceneNodeClickMessage(_Wire):
    """A click on something in the scene."""

    name: Name
    instance_index: float | None
    ray_origin: Point
    ray_direction: Point
    screen_pos: tuple[Coordinate, Coordinate]
    modifier: Name | None
    owner: Name = ""


class TransformControlsDragStartMessage(_Wire):
    """A handle in the scene that was taken hold of."""

    name: Name
    owner: Name = ""


class TransformControlsUpdateMessage(_Wire):
    """Where it was dragged to."""

    name: Name
    wxyz: Quaternion
    position: Point
    owner: Name = ""

    def __post_init__(self) -> None:
        if not any(self.wxyz):
            raise ValueError("no orientation")


class TransformControlsDragEndMessage(_Wire):
    """A handle that was let go."""

    name: Name
    owner: Name = ""


class CommandTriggerMessage(_Wire):
    """A key or a command that was chosen."""

    uuid: Name


class FileTransferPartAck(_Wire):
    """Word that a part of a file has come."""

    source_component_uuid: Name | None
    transfer_uuid: Name
    transferred_bytes: Count
    total_bytes: Count


class FileTransferStartUpload(_Wire):
    """Word that a file is to come."""

    source_component_uuid: Name
    transfer_uuid: Name
    filename: Name
    mime_type: Name
    part_count: Count
    size_bytes: Count


class FileTransferPart(_Wire):
    """A part of it."""

    source_component_uuid: Name
    transfer_uuid: Name
    part_index: Count
    content: Annotated[bytes, msgspec.Meta(max_length=PART)]


_decoder = msgspec.msgpack.Decoder(
    GuiUpdateMessage
    | ViewerCameraMessage
    | GetRenderResponseMessage
    | SceneNodeClickMessage
    | TransformControlsDragStartMessage
    | TransformControlsUpdateMessage
    | TransformControlsDragEndMessage
    | CommandTriggerMessage
    | FileTransferPartAck
    | FileTransferStartUpload
    | FileTransferPart
)


def checked(raw: bytes | str) -> bytes:
    """The message that viser is to read instead of what came from a page.

    Raises:
        MessageError: no page sends that.
        TooMuchError: it is as deep or as large as no message has reason to be.
    """
    if isinstance(raw, str):
        raise MessageError("found text, expected msgpack")
    try:
        return msgspec.msgpack.encode(_decoder.decode(raw))
    except RecursionError:
        raise TooMuchError("too deep") from None
    except (msgspec.MsgspecError, UnicodeDecodeError) as error:
        refused = MessageError if len(raw) <= LARGEST_WRONG else TooMuchError
        raise refused(str(error)) from None
