"""Putting the server's values back on the screen once a control comes to rest.

A value that the server makes of what a slider asked for can cross the slider's next on its way, and the
page is left with what nobody solved. Assigning the same value again sends nothing, so it is queued
here by viser's private message.
"""

import threading
import time
from collections.abc import Callable
from contextvars import copy_context
from functools import partial
from typing import Any

import viser
from viser import _messages

DELAY = 0.4
"""s: longer than the pauses within a drag, and between two digits."""

Touched = tuple[viser.GuiInputHandle[Any], Callable[[], None] | None]
"""A widget that was moved, and what to do instead of sending its value."""


class WriteBack:
    """Sends the touched widgets' values to every page, `DELAY` after the last touch."""

    def __init__(self) -> None:
        """Starts with nothing touched."""
        self._lock = threading.Lock()
        self._touched: dict[str, Touched] = {}
        self._due = 0.0

    def touch(
        self, widget: viser.GuiInputHandle[Any], instead: Callable[[], None] | None = None
    ) -> None:
        """Notes that somebody moved a widget.

        Args:
            widget: the one moved.
            instead: what to do once it rests, if its value is not to be sent: somebody may type on.
        """
        if instead:
            instead = partial(copy_context().run, instead)  # for the page that is heard now
        with self._lock:
            is_first = not self._touched
            self._touched[widget._impl.uuid] = widget, instead
            self._due = time.monotonic() + DELAY
        if is_first:
            threading.Thread(target=self._send_when_due, name="write back", daemon=True).start()

    def _send_when_due(self) -> None:
        for uuid, (widget, instead) in self._settled().items():
            if instead:
                instead()
                continue
            message = _messages.GuiUpdateMessage(uuid, {"value": widget.value})
            widget._impl.gui_api._websock_interface.queue_message(message)

    def _settled(self) -> dict[str, Touched]:
        """Waits until nothing has been touched for `DELAY`, and takes what was."""
        wait = DELAY
        while True:
            time.sleep(wait)
            with self._lock:
                wait = self._due - time.monotonic()
                if wait <= 0:
                    touched, self._touched = self._touched, {}
                    return touched
