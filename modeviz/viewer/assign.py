"""Giving viser's handles new values, cheaply enough to do it while a slider is dragged.

viser takes 0.1 ms to assign a value, even one that it already has, mostly to look up types, and copies
an array five times. Here a value that viser would store as it is goes straight to its `_queue_update`.
"""

from typing import Any


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
