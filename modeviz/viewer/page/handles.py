"""Giving viser's handles new values, cheaply enough to do it while a slider is dragged.

viser takes 0.1 ms to assign a value, even one that it already has, mostly to look up types, and copies
an array five times. Here a value that viser would store as it is goes straight to its `_queue_update`.
"""

from typing import Any

from viser import _messages


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
    handle._queue_update(name, value)


def send_together(handle: Any, **values: Any) -> None:
    """Gives a widget properties that only go together, in one message; as `send`."""
    for name, value in values.items():
        setattr(handle._impl.props, name, value)
    message = _messages.GuiUpdateMessage(handle._impl.uuid, values)
    handle._impl.gui_api._websock_interface.queue_message(message)
