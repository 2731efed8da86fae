"""Who is told how far a long computation is, and what ends it."""

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from modeviz.compute.cancel import CancelToken
from modeviz.compute.interrupt import cancelled_by

Tell = Callable[[str, float], None]
"""Told what is being done, and the fraction of it that is done, 0 to 1."""


def say_nothing(what: str, done: float) -> None:
    """Tells nobody."""


@contextmanager
def cancelled_by_ctrl_c() -> Iterator[CancelToken]:
    """Gives what Ctrl+C, or a notebook's stop button, cancels; a second one interrupts as ever."""

    def say(_signal: signal.Signals) -> None:
        print("modeviz: ending; Ctrl+C again ends it at once", file=sys.stderr)

    with cancelled_by([signal.SIGINT], say) as token:
        yield token
