"""A mode viewer and tuning bench for vehicle mounts."""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from modeviz.public import *  # noqa: F403
else:
    # Not before a name is asked for: `modeviz.cli` is to have Ctrl+C in hand before anything slow.
    def __getattr__(name):
        return getattr(import_module("modeviz.public"), name)

    def __dir__():
        return dir(import_module("modeviz.public"))
