"""Giving viser's handles new values, cheaply enough to do it while a slider is dragged.

viser takes 0.1 ms to assign a value, even one that it already has, mostly to look up types. Here a
value is compared first, and one that viser would store as it is goes straight to its `_queue_update`.
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
            setattr(handle._impl.props, name, value)
            handle._queue_update(name, value)
