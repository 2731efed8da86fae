"""Putting the server's values back on the screen once a control comes to rest.

viser throttles what a page sends with one timer for all widgets, so the last value of a slider can
be lost when another moves right after it; the page then shows what nobody solved. Assigning the same
value again sends nothing, so it is queued here by viser's private message.
"""

import threading

import viser
from viser import _messages

DELAY = 0.4
"""s: longer than the pauses within a drag."""


class WriteBack:
    """Sends the touched widgets' values to every page, `DELAY` after the last touch."""

    def __init__(self) -> None:
        """Starts with nothing touched."""
        self._lock = threading.Lock()
        self._touched: dict[str, viser.GuiInputHandle] = {}
        self._timer: threading.Timer | None = None

    def touch(self, widget: viser.GuiInputHandle) -> None:
        """Notes that somebody moved a widget."""
        with self._lock:
            self._touched[widget._impl.uuid] = widget
            if self._timer:
                self._timer.cancel()
            self._timer = threading.Timer(DELAY, self._send)
            self._timer.daemon = True
            self._timer.start()

    def _send(self) -> None:
        with self._lock:
            touched, self._touched = self._touched, {}
        for uuid, widget in touched.items():
            message = _messages.GuiUpdateMessage(uuid, {"value": widget.value})
            widget._impl.gui_api._websock_interface.queue_message(message)
