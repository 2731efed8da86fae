"""How wide the panels of each page are: its window decides, and every page has its own.

viser sends a panel's width to all pages; here the same message goes to one of them.
"""

from collections.abc import Mapping, Sequence

import viser
from viser import _messages

WIDE, NARROW = "wide", "narrow"

NARROW_BELOW, WIDE_ABOVE = 640, 900
"""CSS pixels between wide panels below which they are made narrow, and between narrow ones above which
they are wide again."""

Widths = Mapping[str, int]
"""CSS pixels, `WIDE` and `NARROW`."""


class Layout:
    """Fits the panels of every page to its window."""

    def __init__(
        self,
        server: viser.ViserServer,
        panels: Sequence[tuple[viser.PanelHandle | viser.MainPanelHandle, Widths]],
    ) -> None:
        """Sets the widths for wide windows, and watches the pages.

        Args:
            server: with all its pages.
            panels: each with how wide it is.
        """
        self._panels = panels
        self._fitted: dict[int, str] = {}
        for panel, widths in panels:
            panel.set_width(widths[WIDE])

        @server.on_client_connect
        def _(client: viser.ClientHandle) -> None:
            self._fitted[client.client_id] = WIDE
            client.camera.on_update(lambda _: self._fit(client))

        @server.on_client_disconnect
        def _(client: viser.ClientHandle) -> None:
            self._fitted.pop(client.client_id, None)

    def _fit(self, client: viser.ClientHandle) -> None:
        """Chooses the widths of a page by the space that is left for its picture."""
        fitted = self._fitted.get(client.client_id)
        wanted = fitting(client.camera.image_width, fitted) if fitted else fitted
        if wanted is None or wanted == fitted:
            return
        self._fitted[client.client_id] = wanted
        gui = client.gui
        for panel, widths in self._panels:
            gui._websock_interface.queue_message(
                _messages.GuiSetPanelWidthMessage(
                    panel._placement_uuid,
                    widths[wanted],
                    counter=gui._next_layout_counter(),
                    run_id=gui._layout_run_id,
                )
            )


def fitting(picture_width: int, fitted: str) -> str:
    """Whether panels should be wide or narrow beside a picture of some pixels, as they are now."""
    if fitted == WIDE and picture_width < NARROW_BELOW:
        return NARROW
    if fitted == NARROW and picture_width > WIDE_ABOVE:
        return WIDE
    return fitted
