"""Signals that end a program, and what a computation keeps then."""

import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from types import FrameType

from modeviz.compute.cancel import CancelToken


@contextmanager
def cancelled_by(
    signals: Sequence[signal.Signals], tell: Callable[[signal.Signals], None]
) -> Iterator[CancelToken]:
    """Gives what a signal cancels; a second one does what it did before.

    A signal that is ignored, as `nohup` has it, stays so. Only the main thread hears signals: elsewhere
    nothing is changed.

    Args:
        signals: which cancel.
        tell: told the one that came.
    """
    token = CancelToken()
    before = {}

    def cancel(number: int, _frame: FrameType | None) -> None:
        for ending, handler in before.items():
            signal.signal(ending, handler)
        tell(signal.Signals(number))
        token.cancel()

    if threading.current_thread() is threading.main_thread():
        before = {s: h for s in signals if (h := signal.getsignal(s)) is not signal.SIG_IGN}
    for ending in before:
        signal.signal(ending, cancel)
    try:
        yield token
    finally:
        for ending, handler in before.items():
            signal.signal(ending, handler)
