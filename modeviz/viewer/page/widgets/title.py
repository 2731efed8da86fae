"""What the page is called: vehicle and variant, above the left column and on the browser's tab."""

import json

import viser
from viser import _messages

from modeviz.errors import cut

PANEL_LETTERS = 22
"""That a narrow column has room for."""


class Title:
    """The title of every page.

    viser's panel has a label; the browser's tab is named by a line of script, viser's private message,
    which is not kept for pages to come: these get it when they connect.
    """

    def __init__(self, server: viser.ViserServer) -> None:
        """Leaves the title that the server was opened with, until another is shown."""
        self._server = server
        self._text = ""
        server.on_client_connect(self._name_tab)

    def show(self, vehicle: str, variant: str) -> None:
        """Names what is shown, if that has changed."""
        text = f"{vehicle}  ·  {variant}"
        if text == self._text:
            return
        self._text = text
        self._server.gui.set_panel_label(panel_label(vehicle, variant))
        for client in self._server.get_clients().values():
            self._name_tab(client)

    def _name_tab(self, client: viser.ClientHandle) -> None:
        if self._text:
            name = json.dumps(f"{self._text} · modeviz".replace("  ", " "))
            script = _messages.RunJavascriptMessage(source=f"document.title = {name};")
            client.scene._websock_interface.queue_message(script)


def panel_label(vehicle: str, variant: str) -> str:
    """Both names in the column's width: each has half of it, or what the other leaves."""
    half = PANEL_LETTERS // 2
    variant = cut(variant, max(half, PANEL_LETTERS - len(vehicle)))
    return f"{cut(vehicle, PANEL_LETTERS - len(variant))}  ·  {variant}"
