"""Ctrl+C and its like: what they end, and what is kept then."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from types import FrameType

from modeviz.cli.terminal import announce, say
from modeviz.compute.cancel import CancelToken
from modeviz.compute.interrupt import cancelled_by

INTERRUPTED = 130
"""The exit status that shells have for it: 128 and the number of the signal."""

ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""What ends a program: Ctrl+C, batch systems, a terminal that is closed."""


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


def cancelled_by_interrupt() -> AbstractContextManager[CancelToken]:
    """Return what a signal to end cancels, which is said; a second one ends the program as ever.

    What is said stays to be read if nothing is said of a computation once it is cancelled.
    """
    return cancelled_by(ENDINGS, _announce)


def _announce(ending: signal.Signals) -> None:
    again = "Ctrl+C" if ending == signal.SIGINT else ending.name
    announce(f"ending; {again} again ends it at once")
