"""What a run has found at its end: kept, whatever fails."""

import sys
from collections.abc import Callable

from modeviz.errors import ModevizError


def keep(*steps: Callable[[], None]) -> None:
    """Takes every step, such as to write and to print, whatever becomes of the others.

    Raises:
        ModevizError: a step failed, the first to do so.
    """
    failed: list[ModevizError] = []
    for step in steps:
        try:
            step()
            sys.stdout.flush()
        except ModevizError as error:
            failed.append(error)
    if failed:
        raise failed[0]
