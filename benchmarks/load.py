"""`python -m benchmarks.load`: many pages at once, each in a session of its own, and all in one review.

Every page moves a slider about once a second, or looks on while the presenter of its review does, and
at the end drags one as fast as a page can. Then each screen has to show its rates and the spectra that
a fresh solve gives for them. Times are from a move to its new spectrum; server and pages are on one
machine.
"""

import argparse
import asyncio
import contextlib
import math
import random
import secrets
import statistics
import sys
import tempfile
import time
from collections.abc import AsyncIterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from threadpoolctl import threadpool_limits
from websockets.asyncio.client import ClientConnection, connect

from benchmarks.loaded_server import LoadedServer, Usage, loaded_server
from benchmarks.page_client import CAMERA, handshake, own_origin, wire
from benchmarks.screen import Row, Screen, off_by, sharp_lines
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.ride.psd import power_decibels
from modeviz.study.conditions import road_conditions
from modeviz.viewer.panels.mounts.travel import STEP

PACE_S = 0.5, 1.5
"""Between an answer and the next move of a page."""

OPENING_S = 0.25
"""Between two pages that open: a server takes five a second."""

DRAG_STEPS, STEP_S = 20, 0.05
"""Of the drag at the end; a page sends at most one message of a widget in that time."""

QUIET_S, LONGEST_S = 1.0, 60.0
"""A screen is taken for final so long after its last spectrum, once its number is that of its slider
and its server has answered all that was asked; where that never is, after the second time."""

PATIENCE_S = 120.0

STEPS_OFF = 2
"""By which a number may differ from its slider: steps are 1 % or less, numbers have four digits."""

WITHIN_DB = 1e-3
"""By which a spectrum may miss that of a fresh solve: beside lines that are left out rounding still
shows in the fifth decimal. One step of a slider changes most lines by more."""

TITLE = (
    f"{'':16} {'pages':>5} {'moves':>7} {'median, ms':>10} {'95 %, ms':>8} {'MB a page':>9} "
    f"{'MB then':>8} {'sessions, threads, files left':>29} {'wrong':>5}"
)
"""Of the table. A page's memory is what the server has grown by; then all have left again."""


@dataclass
class Moved:
    """The newest move of a session."""

    number: int = 0
    at: float = 0.0
    """s."""
    is_timed: bool = True
    """Whether no move comes before the answer to it."""

    def note(self) -> None:
        """Keeps that there is another."""
        self.number += 1
        self.at = time.perf_counter()


class LoadedPage:
    """A page that has a screen and no browser."""

    def __init__(self, server: LoadedServer, query: str, moved: Moved, seed: int) -> None:
        """Opens nothing yet.

        Args:
            server: where.
            query: of its address, which says the session or the review.
            moved: of its session.
            seed: of what it moves.
        """
        self._url = f"ws://127.0.0.1:{server.port}/?{query}"
        self._origin, self._moved = own_origin(server.port), moved
        self._random = random.Random(seed)
        self._drawn = asyncio.Event()
        self._drawn_at = 0.0
        self._socket: ClientConnection
        self.screen = Screen()
        self.delays: list[float] = []
        """From each move to its new spectrum, s."""
        self._n_answered = 0
        self._begin: tuple[Row, float, int]
        """The slider that it drags at the end, with the rate and the position from which it began."""

    @property
    def n_moves(self) -> int:
        """How often sliders of its session were moved."""
        return self._moved.number

    async def __aenter__(self) -> "LoadedPage":
        options = {"max_queue": None, "open_timeout": PATIENCE_S, **handshake(self._origin)}
        self._socket = await connect(self._url, **options)
        await self._socket.send(wire("ViewerCameraMessage", **CAMERA))
        self._hearing = asyncio.create_task(self._hear())
        await self._next_spectrum()
        return self

    async def __aexit__(self, *_: object) -> None:
        self._hearing.cancel()
        await self._socket.close()

    async def tune(self, end: float) -> None:
        """Moves sliders until a time, and drags one then."""
        while time.monotonic() < end:
            await asyncio.sleep(self._random.uniform(*PACE_S))
            row = self._random.choice(self.screen.rows())
            self._drawn.clear()
            await self._move(row, self._other_position(row))
            await self._next_spectrum()
        await self._drag()

    async def follow(self, presenter: "LoadedPage") -> None:
        """Waits until the number of the slider is as the page has left it that moved it."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(LONGEST_S):
                while self._wrong_rate(presenter):
                    await asyncio.sleep(0.1)

    async def rest(self) -> None:
        """Waits until no new spectrum comes, and all is heard that the server has said by then."""
        seen = None
        while seen != self._drawn_at:
            seen = self._drawn_at
            await asyncio.sleep(QUIET_S)
            await (await self._socket.ping())  # answered behind all that was said before
            await asyncio.sleep(0.1)

    async def _drag(self) -> None:
        row = self._random.choice(self.screen.rows())
        start, target = row.slider["value"], self._other_position(row)
        self._begin = row, row.rate, start
        self._moved.is_timed = False
        for step in range(1, DRAG_STEPS + 1):
            await self._move(row, round(start + (target - start) * step / DRAG_STEPS))
            await asyncio.sleep(STEP_S)

    def _other_position(self, row: Row) -> int:
        """A position a good way from where a slider is: its spectrum is another."""
        away = self._random.randint(row.length // 8, row.length // 3)
        here = row.slider["value"]
        return int(here - away if here - away > 0 else here + away)

    async def _move(self, row: Row, position: int) -> None:
        row.slider["value"] = position
        self._moved.note()
        updates = {"value": float(position)}
        await self._socket.send(wire("GuiUpdateMessage", uuid=row.slider["uuid"], updates=updates))

    async def _next_spectrum(self) -> None:
        async with asyncio.timeout(PATIENCE_S):
            await self._drawn.wait()

    async def _hear(self) -> None:
        async for frame in self._socket:
            if self.screen.hear(frame):
                self._drawn_at = time.perf_counter()
                if self._moved.is_timed and self._moved.number != self._n_answered:
                    self.delays.append(self._drawn_at - self._moved.at)
                self._n_answered = self._moved.number
                self._drawn.set()

    def wrong(self, presenter: "LoadedPage", prepared: Prepared, conditions: Conditions) -> list[str]:
        """What its final screen shows wrongly.

        Args:
            presenter: the page that moved the sliders of its session.
            prepared: the vehicle.
            conditions: of its page.
        """
        return self._wrong_rate(presenter) + self._wrong_spectra(prepared, conditions)

    def _wrong_rate(self, presenter: "LoadedPage") -> list[str]:
        row, rate, start = presenter._begin
        rows = {(each.group, each.field): each for each in self.screen.rows()}
        here, left = rows[row.group, row.field], row.slider["value"]
        wrong = []
        if here.slider["value"] != left:
            wrong.append(f"slider at {here.slider['value']}, left at {left}")
        if abs(math.log(here.rate / rate) / math.log1p(STEP) - (left - start)) > STEPS_OFF:
            wrong.append(f"{here.rate:g} N/m, {left - start} steps from {rate:g}")
        return wrong

    def _wrong_spectra(self, prepared: Prepared, conditions: Conditions) -> list[str]:
        rates = dict(prepared.vehicle.rates)
        for row in self.screen.rows():
            rates[row.group] = replace(rates[row.group], **{row.field: row.rate})
        fresh = solve(prepared, rates, conditions)
        sharp = sharp_lines(fresh)
        wrong = []
        for direction in ("lateral", "vertical"):
            curve = power_decibels(fresh.response(0, direction))
            shown = self.screen.spectra()
            missed = min(off_by(fresh.frequency_hz, curve, each, sharp) for each in shown)
            if missed[0] > WITHIN_DB:
                wrong.append("{} spectrum off by {:.2g} dB at {:.4g} Hz".format(direction, *missed))
        return wrong


@dataclass(frozen=True)
class Load:
    """What came of many pages."""

    name: str
    n_pages: int
    n_moves: int
    delays_ms: list[float]
    before: Usage
    during: Usage
    after: Usage
    wrong: list[str]

    def line(self) -> str:
        """Return its row of the table."""
        grown = (self.during.memory_mb - self.before.memory_mb) / self.n_pages
        left = f"{self.after.n_sessions}, {self.after.n_threads}, {self.after.n_files}"
        median, late = statistics.median(self.delays_ms), _late(self.delays_ms)
        return (
            f"{self.name:16} {self.n_pages:5} {self.n_moves:7} {median:10.0f} {late:8.0f} "
            f"{grown:9.1f} {self.after.memory_mb:8.0f} {left:>29} "
            f"{len(self.wrong):5}"
        )


def _late(delays: Sequence[float]) -> float:
    """That which one of twenty is longer than."""
    return statistics.quantiles(delays, n=20, method="inclusive")[-1] if len(delays) > 1 else delays[0]


async def loaded(
    server: LoadedServer, name: str, n_pages: int, seconds: float, is_review: bool, folder: Path
) -> Load:
    """Has pages tune a vehicle, all in one review or each in a session of its own.

    Args:
        server: of the vehicle.
        name: of the load.
        n_pages: how many.
        seconds: how long sliders are moved.
        is_review: whether they are of one review, in which the first presents.
        folder: of the vehicle.
    """
    before = server.usage()
    async with contextlib.AsyncExitStack() as pages:
        opened = [page async for page in _opened(server, n_pages, is_review, pages)]
        presenters = opened[:1] if is_review else opened
        end = time.monotonic() + seconds
        await asyncio.gather(*(page.tune(end) for page in presenters))
        moved_by = opened[:1] * n_pages if is_review else opened
        await asyncio.gather(*map(LoadedPage.follow, opened, moved_by))
        await _answered(server)
        await asyncio.gather(*map(LoadedPage.rest, opened))
        during = server.usage()
    after = await _left(server)
    vehicle = read_vehicle(folder)
    prepared, conditions = prepare(vehicle), road_conditions(vehicle, None, vehicle.speed)
    wrong = [
        f"page {number}: {what}"
        for number, (page, presenter) in enumerate(zip(opened, moved_by, strict=True))
        for what in page.wrong(presenter, prepared, conditions)
    ]
    delays = [1e3 * delay for page in opened for delay in page.delays]
    n_moves = sum(page.n_moves for page in presenters)
    return Load(name, n_pages, n_moves, delays, before, during, after, wrong)


async def _opened(
    server: LoadedServer, n_pages: int, is_review: bool, pages: contextlib.AsyncExitStack
) -> AsyncIterator[LoadedPage]:
    """Opens pages one after the other: those of a review after its owner's, who has shared it."""
    session, moved = secrets.token_urlsafe(16), Moved()
    query = f"session={session}"
    for number in range(n_pages):
        yield await pages.enter_async_context(LoadedPage(server, query, moved, number))
        await asyncio.sleep(OPENING_S)
        if not is_review:
            query, moved = f"session={secrets.token_urlsafe(16)}", Moved()
        elif number == 0:
            query = f"review={server.shared(session)}"


async def _answered(server: LoadedServer) -> None:
    """Waits until a server has answered all that pages have asked."""
    deadline = time.monotonic() + LONGEST_S
    while not server.has_answered() and time.monotonic() < deadline:
        await asyncio.sleep(0.1)


async def _left(server: LoadedServer) -> Usage:
    """What a server takes once it has closed the sessions that nobody looks at."""
    deadline = time.monotonic() + PATIENCE_S
    while (usage := server.usage()).n_sessions and time.monotonic() < deadline:
        await asyncio.sleep(0.5)
    return usage


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints what came of each load, and returns 0 if no screen was wrong and nothing was left."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.load", description=__doc__)
    parser.add_argument("vehicle", type=Path, nargs="?", help="a folder; default: the pickup")
    parser.add_argument("--pages", type=int, default=25, help="default 25")
    parser.add_argument("--minutes", type=float, default=5.0, help="of each load; default 5")
    options = parser.parse_args(arguments)
    folder = options.vehicle or builtin_vehicle()
    seconds, wrong = 60 * options.minutes, []
    loads = (
        ("alone", 1, seconds / 5, False),
        ("private", options.pages, seconds, False),
        ("one review", options.pages, seconds, True),
        ("private again", options.pages, seconds / 5, False),
    )
    with contextlib.ExitStack() as ending:
        ending.enter_context(threadpool_limits(limits=1, user_api="blas"))
        study = Path(ending.enter_context(tempfile.TemporaryDirectory()), "load.modeviz")
        server = ending.enter_context(loaded_server(folder, study))
        print(TITLE)
        for load in loads:
            found = asyncio.run(loaded(server, *load, folder))
            print("\n".join([found.line(), *found.wrong]), flush=True)
            wrong += found.wrong
    if not wrong:
        print("every screen shows its rates and their spectra")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
