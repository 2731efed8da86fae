"""What is in a tab of the page, which can be built anew while the tab stays where it is.

Leans on how viser keeps the elements of a container.
"""

from collections.abc import Callable

import viser


class Contents:
    """The elements of a tab, and how they are built."""

    def __init__(self, tab: viser.GuiTabHandle, build: Callable[[], None]) -> None:
        """Builds them, once for now."""
        self._tab, self._build = tab, build
        self.renew()

    def renew(self) -> None:
        """Takes out what is there, and builds it anew."""
        for element in tuple(self._tab._children.values()):
            element.remove()
        with self._tab:
            self._build()
