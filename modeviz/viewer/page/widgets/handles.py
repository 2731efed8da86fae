"""Giving viser's handles new values, cheaply enough to do it while a slider is dragged.

viser takes 0.1 ms to assign a value, even one that it already has, mostly to look up types, and copies
an array five times. Here a value that viser would store as it is goes straight to its `_queue_update`.
"""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any

import viser
from viser import _messages
from viser._gui_handles import GuiModalHandle as GuiModalHandle


def assign(handle: Any, **values: Any) -> None:
    """Gives properties of a handle those values that are new; not for arrays."""
    for name, value in values.items():
        if getattr(handle, name) == value:
            continue
        if isinstance(getattr(type(handle), name, None), property):
            setattr(handle, name, value)
        else:
            send(handle, name, value)


def send(handle: Any, name: str, value: Any) -> None:
    """Gives a property a value that is known to be new and of its type; nobody may change it later."""
    setattr(handle._impl.props, name, value)
    announce(handle, name, value)


def announce(handle: Any, name: str, value: Any) -> None:
    """Tells pages of a property that viser need not know."""
    handle._queue_update(name, value)


def send_together(handle: Any, **values: Any) -> None:
    """Gives a widget properties that only go together, in one message; as `send`."""
    for name, value in values.items():
        setattr(handle._impl.props, name, value)
    message = _messages.GuiUpdateMessage(handle._impl.uuid, values)
    handle._impl.gui_api._websock_interface.queue_message(message)


def mark(slider: Any, value: float | None) -> None:
    """Marks the place of one value on a slider's track, or of none."""
    assign(slider, _marks=() if value is None else (_messages.GuiSliderMark(value, None),))


def name_of(widget: Any) -> str:
    """Return the name by which pages know a widget."""
    return widget._impl.uuid


def at_once(scene: viser.SceneApi) -> AbstractContextManager[None]:
    """Lets pages have all that is said of a scene within, or nothing yet."""
    return scene._websock_interface.atomic()


def nodes(scene: viser.SceneApi) -> Mapping[str, Any]:
    """The handles of all nodes of a scene, by name."""
    return scene._handle_from_node_name
