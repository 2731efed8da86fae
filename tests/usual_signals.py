"""Signals as on a terminal, also where tests run behind a script or `nohup` that has them ignored."""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from modeviz.cli.interrupt import ENDINGS


@contextmanager
def usual_signals() -> Iterator[None]:
    """What ends a program does so inside, as far as nobody there catches it."""
    before = {number: signal.signal(number, signal.SIG_DFL) for number in ENDINGS}
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def interrupting(told: list[Any], ending: int, after: int = 1) -> Callable[[Any, Any], None]:
    """Stands for what tells of progress: notes it, and after so many times raises a signal."""

    def interrupt(_: Any, progress: Any) -> None:
        told.append(progress)
        if len(told) == after:
            signal.raise_signal(ending)

    return interrupt
