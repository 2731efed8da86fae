"""Putting the server's values back on the screen once a control comes to rest.

viser throttles what a page sends with one timer for all widgets, so the last value of a slider can
be lost when another moves right after it; the page then shows what nobody solved. Assigning the same
value again sends nothing, so it is queued here by viser's private message.
"""

import threading
import time

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
        self._due = 0.0

    def touch(self, widget: viser.GuiInputHandle) -> None:
        """Notes that somebody moved a widget."""
        with self._lock:
            is_first = not self._touched
            self._touched[widget._impl.uuid] = widget
            self._due = time.monotonic() + DELAY
        if is_first:
            threading.Thread(target=self._send_when_due, name="write back", daemon=True).start()

    def _send_when_due(self) -> None:
        for uuid, widget in self._settled().items():
            message = _messages.GuiUpdateMessage(uuid, {"value": widget.value})
            widget._impl.gui_api._websock_interface.queue_message(message)

    def _settled(self) -> dict[str, viser.GuiInputHandle]:
        """Waits until nothing has been touched for `DELAY`, and takes what was."""
        wait = DELAY
        while True:
            time.sleep(wait)
            with self._lock:
                wait = self._due - time.monotonic()
                if wait <= 0:
                    touched, self._touched = self._touched, {}
                    return touched
