"""Which values a widget can have: those that its page can produce."""

import math
from typing import TYPE_CHECKING, Any

from modeviz.viewer.page.wire.decoding import LONGEST_TEXT

if TYPE_CHECKING:
    from viser._gui_handles import _GuiInputHandle


def is_possible(widget: "_GuiInputHandle[Any]", value: Any) -> bool:
    """Return whether the widget can produce a value: of its type, in its range, of its choices."""
    props, current = widget._impl.props, widget._impl.value
    options = getattr(props, "options", None)
    if options is not None:
        return value in options
    low, high = getattr(props, "min", None), getattr(props, "max", None)
    if isinstance(current, tuple):
        return (
            isinstance(value, (tuple, list))
            and len(value) == len(current)
            and all(_is_number(v, _at(low, i), _at(high, i)) for i, v in enumerate(value))
        )
    if isinstance(current, bool):
        return isinstance(value, bool)
    if isinstance(current, (int, float)):
        return _is_number(value, low, high)
    return isinstance(current, str) and isinstance(value, str) and len(value) <= LONGEST_TEXT


def _at(bound: Any, index: int) -> float | None:
    """A bound of one component, from a bound for each or for all."""
    return bound[index] if isinstance(bound, (tuple, list)) else bound


def _is_number(value: Any, low: float | None, high: float | None) -> bool:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return False
    return (low is None or value >= low) and (high is None or value <= high)
