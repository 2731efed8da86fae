"""Notebooks: whether this runs in one, and the pages that its cells show."""

import atexit
import sys
from typing import Any, Protocol

MOST_OPEN = 8
"""Pages of one process: cells that are run again and again shall not fill the machine."""


class Closed(Protocol):
    """What can be closed, more than once."""

    def close(self) -> None:
        """Close it."""
        ...


def is_notebook() -> bool:
    """Return whether this runs in a notebook's kernel."""
    marimo = sys.modules.get("marimo")
    return hasattr(_shell(), "kernel") or (marimo is not None and marimo.running_in_notebook())


def this_cell() -> str:
    """Return what the notebook calls the cell that runs; "" where it does not tell its kernel."""
    told = getattr(_shell(), "get_parent", dict)()
    return told.get("metadata", {}).get("cellId", "")


class OpenPages:
    """The open pages of a process, the oldest first."""

    def __init__(self) -> None:
        """Starts without any; closes what is open when the process ends."""
        self._pages: list[tuple[str, Closed]] = []
        atexit.register(self.close)

    def add(self, page: Closed, cell: str) -> None:
        """Keeps a page; closes what that cell showed before, and the oldest where there are many."""
        stale = [each for each in self._pages if cell and each[0] == cell]
        left = [each for each in self._pages if each not in stale]
        left, stale = left[-MOST_OPEN + 1 :], stale + left[: -MOST_OPEN + 1]
        self._pages = [*left, (cell, page)]
        for _, old in stale:
            old.close()

    def forget(self, page: Closed) -> None:
        """Keeps a page no longer, which somebody else closes."""
        self._pages = [each for each in self._pages if each[1] is not page]

    def close(self) -> None:
        """Closes all."""
        pages, self._pages = self._pages, []
        for _, page in pages:
            page.close()


def _shell() -> Any:
    """Return the shell of IPython, None outside of it."""
    ipython = sys.modules.get("IPython")
    return ipython.get_ipython() if ipython else None
