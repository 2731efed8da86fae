"""Ctrl+C as a wish to end a long computation and keep what it has."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from modeviz.commands.options import say
from modeviz.tuning.control import Control


@contextmanager
def cancelled_by_interrupt() -> Iterator[Control]:
    """A control that Ctrl+C cancels; a second Ctrl+C ends the program as ever."""
    control = Control()

    def cancel(_signal: int, _frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, before)
        say("ending; Ctrl+C again ends it at once")
        control.cancel()

    before = signal.signal(signal.SIGINT, cancel)
    try:
        yield control
    finally:
        signal.signal(signal.SIGINT, before)
