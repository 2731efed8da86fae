"""Ctrl+C and its like: what they end, and what is kept then."""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from types import FrameType

from modeviz.cli.terminal import announce, say
from modeviz.compute.cancel import CancelToken
from modeviz.compute.interrupt import cancelled_by
from modeviz.compute.stop import Stop

INTERRUPTED = 130
"""The exit status that shells have for it: 128 and the number of the signal."""

STOPS_WITHIN = 15.0
"""s for a server to come to its end: batch systems wait for half a minute before they kill."""

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


@contextmanager
def stopped_by_signal() -> Iterator[Stop]:
    """Gives what a signal to end tells; a second one ends the program at once.

    A signal that is ignored, as `nohup` has it, stays so. What does not come to its end by itself
    within `STOPS_WITHIN` is ended.
    """
    stop = Stop()

    def end(number: int, _frame: FrameType | None) -> None:
        if stop.is_told:
            os._exit(128 + number)
        stop.tell()
        _announce(signal.Signals(number), "stopping")
        last = threading.Timer(STOPS_WITHIN, os._exit, [128 + number])
        last.daemon = True
        last.start()

    before = {each: was for each in ENDINGS if (was := signal.getsignal(each)) is not signal.SIG_IGN}
    for each in before:
        signal.signal(each, end)
    try:
        yield stop
    finally:
        if not stop.is_told:
            for each, was in before.items():
                signal.signal(each, was)


def _announce(ending: signal.Signals, what: str = "ending") -> None:
    again = "Ctrl+C" if ending == signal.SIGINT else ending.name
    announce(f"{what}; {again} again ends it at once")
