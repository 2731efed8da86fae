"""`python -m benchmarks.slow_pages`: what pages cost others that read slowly, or have gone.

A slider of the truck is dragged on one page, first alone and then beside three others of its session:
one reads nothing, one a byte a second, one 20 kB a second. Then pages come and go. Told are the times
from slider to plot and the memory of the server.
"""

import argparse
import multiprocessing
import resource
import statistics
import sys
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.page_client import session_query
from benchmarks.slow_page import slow_page
from benchmarks.websocket import PATIENCE_S, Page, move, open_page, rest, served, widgets
from modeviz.files import builtin_vehicle

SPEEDS = {"nothing": 0.0, "1 byte/s": 1.0, "20 kB/s": 20e3}
"""Bytes a second that slow pages read, by what they are called."""

LOOKS_EVERY = 0.1
STEP = 3
"""Of the slider."""

ROUNDS = 3


@dataclass(frozen=True)
class Dragged:
    """How a slider followed."""

    median_ms: float
    slow_ms: float
    """The 95th percentile."""
    server_mb: float
    """Memory of the server's process at the end."""


def drag_beside(port: int, query: str, seconds: float, speeds: Sequence[float]) -> Dragged:
    """Drags the first slider of a session for some time, beside slow pages of the same session."""
    with ExitStack() as ending:
        for speed in speeds:
            page = ending.enter_context(slow_page(port, f"/{query}"))
            thread = threading.Thread(target=_read, args=(page, speed), daemon=True)
            thread.start()
        page = ending.enter_context(open_page(port, query))
        return _dragged(page, seconds)


def _dragged(page: Page, seconds: float) -> Dragged:
    slider, spectrum = widgets(page)
    low, high = (slider["props"][end] for end in ("min", "max"))
    rest(page)
    times, begin = [], time.monotonic()
    for i in range(10**6):
        if time.monotonic() - begin > seconds:
            break
        times.append(move(page, slider, low + i * STEP % (high - low), spectrum))
    slow = float(np.percentile(times, 95))
    return Dragged(1e3 * statistics.median(times), 1e3 * slow, memory_mb())


def _read(page, bytes_per_s: float) -> None:
    """Reads so much from a socket until it is closed."""
    owed = 0.0
    try:
        while True:
            time.sleep(LOOKS_EVERY)
            owed += bytes_per_s * LOOKS_EVERY
            if owed >= 1:
                owed -= len(page.recv(int(owed)))
    except OSError:
        return


def memory_mb() -> float:
    """Return the memory of the server's process, MB."""
    (server,) = multiprocessing.active_children()
    pages = int(Path(f"/proc/{server.pid}/statm").read_text("ascii").split()[1])
    return pages * resource.getpagesize() / 2**20


def come_and_go(port: int, query: str, n_pages: int) -> float:
    """Opens and closes pages of a session; by how much the server's memory grew for each, kB."""
    before = memory_mb()
    for _ in range(n_pages):
        with open_page(port, query) as page:
            widgets(page)
    time.sleep(2.0)
    return 1024 * (memory_mb() - before) / n_pages


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints the figures and returns 0."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.slow_pages", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="of each drag, default 60")
    parser.add_argument("--pages", type=int, default=60, help="that come and go, default 60")
    options = parser.parse_args(arguments)
    with served(builtin_vehicle()) as (port, _):
        query = _new_session(port)
        with open_page(port, query) as page:  # answered once the vehicle is prepared
            move(page, *_first_move(page))
        for name, speeds in (("alone", ()), ("beside slow pages", (*SPEEDS.values(),))):
            found = drag_beside(port, query, options.seconds, speeds)
            print(
                f"{name}: {found.median_ms:.0f} ms in the median, {found.slow_ms:.0f} ms at the 95th "
                f"percentile, server {found.server_mb:.0f} MB",
                flush=True,
            )
        for _ in range(ROUNDS):  # the first ones fill caches
            grown = come_and_go(port, query, options.pages)
            print(f"{options.pages} pages that came and went: {grown:+.0f} kB each", flush=True)
    return 0


def _new_session(port: int) -> str:
    """Return what the address of a new session adds, once the server has started."""
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            return session_query(port)
        except ConnectionRefusedError:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.1)


def _first_move(page: Page):
    slider, spectrum = widgets(page)
    return slider, slider["props"]["max"], spectrum


if __name__ == "__main__":
    sys.exit(main())
