"""What can be done here, on one screen: shown to the first page of a session, and when asked for."""

import threading
from collections.abc import Iterator, Sequence
from html import escape

import viser

from modeviz.viewer.page.people.looking import let_all_use
from modeviz.viewer.page.widgets.handles import GuiModalHandle
from modeviz.viewer.page.widgets.hotkeys import Hotkey, Hotkeys
from modeviz.viewer.page.widgets.html import FOR_ALL, block

TOPICS = (
    (
        "Change",
        "Left: softer or stiffer mounts. Everything follows while you drag; each rate says what ten "
        "percent of it would do. Place, in the details of a group, moves and turns its mounts, by "
        "numbers or by a handle in the scene.",
    ),
    (
        "Look",
        "Middle: drag to turn the vehicle, scroll to come closer, click a mount to get to its rates. "
        "The card plays and stops the motion; its second tab shows damped modes, the shape at one "
        "frequency, or one body alone.",
    ),
    (
        "Read",
        "Right: ride figures, spectra and their peaks. Click a mode in a peak or in the table to see "
        "it move; Energy tells which mounts hold it, Forces and Paths what gets through them. Click "
        "in a spectrum to put the cursor there, at which they tell it.",
    ),
    (
        "Compare and keep",
        "Pin the present rates under a name, compare any two sets, and take pictures, films and "
        "reports away.",
    ),
)


class Guide:
    """One window that says what can be done, opened on one page at a time."""

    def __init__(self, server: viser.ViserServer, hotkeys: Hotkeys) -> None:
        """Adds the button and the key that open it.

        Args:
            server: of the pages; the button stands where its widgets go now.
            hotkeys: listed in the window; its own key is added.
        """
        self._server, self._hotkeys = server, hotkeys
        self._lock = threading.Lock()
        self._is_welcome_due = False
        self._open: dict[int, GuiModalHandle] = {}
        server.gui.add_html(FOR_ALL)
        button = server.gui.add_button_group(
            "Help", ("What can I do here?",), hint="A short guide, and all keys"
        )
        button.on_click(lambda event: event.client and self.open(event.client))
        let_all_use(button)
        hotkeys.add(
            "This guide", "H", lambda event: event.client and self.open(event.client), is_for_all=True
        )
        server.on_client_connect(self._welcome)
        server.on_client_disconnect(self._forget)

    def welcome_first(self) -> None:
        """Opens the guide on the next page that comes, and on no other."""
        self._is_welcome_due = True

    def open(self, client: viser.ClientHandle) -> None:
        """Opens the guide on a page, unless it is open there."""
        with self._lock:
            if client.client_id in self._open:
                return
            self._open[client.client_id] = window = client.gui.add_modal("What you can do here")
        with window:
            client.gui.add_html(block(*_text(self._hotkeys.listed)))
            close = client.gui.add_button(
                "Start", hint="Closes the guide, as Esc does; H brings it back"
            )
        close.on_click(lambda _: self._close(client))

    def _close(self, client: viser.ClientHandle) -> None:
        window = self._open.pop(client.client_id, None)
        if window is not None:
            window.close()

    def _forget(self, client: viser.ClientHandle) -> None:
        self._open.pop(client.client_id, None)

    def _welcome(self, client: viser.ClientHandle) -> None:
        with self._lock:
            is_due, self._is_welcome_due = self._is_welcome_due, False
        if is_due:
            self.open(client)


def _text(hotkeys: Sequence[Hotkey]) -> Iterator[str]:
    """The topics, then the keys in two columns."""
    yield from (f'<p class="topic"><b>{topic}</b><br>{words}</p>' for topic, words in TOPICS)
    yield '<div class="keys">'
    for hotkey in hotkeys:
        keys = "".join(f"<kbd>{escape(key)}</kbd>" for key in hotkey.keys)
        yield f"<span>{keys}</span><span>{escape(hotkey.label)}</span>"
    yield "</div>"
