"""Word of progress on a terminal."""

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import partial

from modeviz.cli.streams import one_line, plain, printable
from modeviz.errors import LONGEST, cut
from modeviz.text.time_left import TimeLeft


def progress(what: str) -> Callable[[float], None]:
    """Return what tells a terminal how far something is, 0 to 1; nothing where errors go to a file."""
    return partial(Teller(), what)


class Teller:
    """Tells how far one of several things after each other is, and how long it still takes."""

    def __init__(self) -> None:
        """Nothing has begun."""
        self._what, self._left = "", TimeLeft()

    def __call__(self, what: str, done: float) -> None:
        """Tells the fraction of something that is done; see `progress`."""
        if what != self._what:
            self._what, self._left = what, TimeLeft()
        told = (f"{what} {done:4.0%}", self._left.words(done))
        say(", ".join(filter(None, told)) if done < 1 else "")


def announce(text: str) -> None:
    """Says what is not to be missed: on a terminal as `say`, else in a line of its own."""
    if sys.stderr.isatty():
        say(text)
    else:
        print(f"modeviz: {text}", file=sys.stderr)


def remark(text: str) -> None:
    """Says in a line of its own what is to be known of the input, and that it is no error."""
    print(f"modeviz: note: {one_line(cut(text, LONGEST))}", file=sys.stderr)


def say(text: str) -> None:
    """Puts a text in the place of the line before on a terminal; nothing where errors go to a file."""
    if sys.stderr.isatty():
        clean = plain(printable(text), sys.stderr.encoding or "utf-8")
        # Not through Python's buffer, which would refuse what an interrupt says while it is written to.
        with suppress(OSError):  # a terminal that was closed
            os.write(sys.stderr.fileno(), f"\r{clean}\x1b[K".encode(errors="replace"))
