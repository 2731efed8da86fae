"""Opening the folder of the selected group in every page, and choosing which are open at the start.

viser opens a folder from the server only by building it anew, and what fits is each window's own. So a
script in the page clicks on folders, and reads from an element that is always there whose turn it is.
Leans on how viser's page builds folders and tabs.
"""

from html import escape

import viser

from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import assign


class FolderOpener:
    """Tells every page which mount group's folder to open."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Starts the script; to be built outside of tabs, which a page builds only when they are up."""
        self._n_asked = 0
        self._marker = gui.add_html("")
        scripts.run(gui, "panels/mounts/opener.js")

    def show(self, group: str) -> None:
        """Opens the folder of a group that was not the selected one, or of one asked for."""
        data = f'data-group="{escape(group)}" data-asked="{self._n_asked}"'
        assign(self._marker, content=f'<div class="mv-selected" {data}></div>')

    def ask(self) -> None:
        """Has the folder of the next group shown opened, even if it was selected before."""
        self._n_asked += 1
