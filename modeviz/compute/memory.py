"""Memory that this process has freed, and the system does not know of."""

import ctypes
import sys
from functools import cache


def give_back() -> None:
    """Gives freed memory back to the system, where its allocator (glibc's) would keep it."""
    if sys.platform == "linux" and (trim := _trim()):
        trim(0)


@cache
def _trim() -> "ctypes._NamedFuncPointer | None":
    try:
        return ctypes.CDLL(None).malloc_trim
    except (AttributeError, OSError):
        return None
