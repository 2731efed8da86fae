"""Ctrl+C and its like: what they end, and what is kept then."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from modeviz.cli.terminal import announce, say
from modeviz.compute.cancel import CancelToken

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


@contextmanager
def cancelled_by_interrupt() -> Iterator[CancelToken]:
    """A control that a signal to end cancels; a second one ends the program as ever.

    That is said, and stays to be read if nothing is said of a computation once it is cancelled. A
    signal that is ignored, as `nohup` has it, stays so.
    """
    control = CancelToken()

    def cancel(number: int, _frame: FrameType | None) -> None:
        for ending, handler in before.items():
            signal.signal(ending, handler)
        again = "Ctrl+C" if number == signal.SIGINT else signal.Signals(number).name
        announce(f"ending; {again} again ends it at once")
        control.cancel()

    before = {n: h for n in ENDINGS if (h := signal.getsignal(n)) is not signal.SIG_IGN}
    for number in before:
        signal.signal(number, cancel)
    try:
        yield control
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
