"""Where a user's machine keeps what a program remembers from one start to the next."""

import os
import sys
from pathlib import Path

VARIABLE = "XDG_STATE_HOME"
"""Of the environment: chooses another place, if it is a whole path."""


def state_folder() -> Path:
    """Return the folder that modeviz has there; it may not exist yet."""
    chosen = Path(os.environ.get(VARIABLE, ""))
    return (chosen if chosen.is_absolute() else _usual()) / "modeviz"


def _usual() -> Path:
    """The place that the XDG base directories, Apple or Microsoft name for it."""
    home = Path.home()
    if sys.platform == "darwin":
        return home / "Library" / "Application Support"
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", home / "AppData" / "Local"))
    return home / ".local" / "state"
