"""Ctrl+C: what it ends, and what is kept then."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from modeviz.commands.terminal import announce, say
from modeviz.tuning.control import Control

INTERRUPTED = 130
"""The exit status that shells have for it: 128 and the number of the signal."""


def interrupted() -> int:
    """Says that an interrupt ended the program, and returns its exit status."""
    say("")
    print("modeviz: interrupted", file=sys.stderr)
    return INTERRUPTED


@contextmanager
def ended_by_interrupt() -> Iterator[None]:
    """Ctrl+C ends the program at once: of an exception some imports lose track, and others fail."""

    def end(_signal: int, _frame: FrameType | None) -> None:
        os._exit(interrupted())

    before = signal.signal(signal.SIGINT, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def cancelled_by_interrupt() -> Iterator[Control]:
    """A control that Ctrl+C cancels; a second Ctrl+C ends the program as ever.

    That is said, and stays to be read if nothing is said of a computation once it is cancelled.
    """
    control = Control()

    def cancel(_signal: int, _frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, before)
        announce("ending; Ctrl+C again ends it at once")
        control.cancel()

    before = signal.signal(signal.SIGINT, cancel)
    try:
        yield control
    finally:
        signal.signal(signal.SIGINT, before)
