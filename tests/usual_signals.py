"""Signals as on a terminal, also where tests run behind a script or `nohup` that has them ignored."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager

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
