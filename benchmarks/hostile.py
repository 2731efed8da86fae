"""`python -m benchmarks.hostile`: a page used quietly while somebody else means no good.

Each attack meets a server of its own. Memory, what came on the terminal, and how long moves of a slider
on the quiet page took: before, during and after. Everything stays on this machine and ends by itself.
"""

import argparse
import math
import multiprocessing
import os
import resource
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import cycle
from multiprocessing.connection import Connection
from pathlib import Path

from websockets.exceptions import WebSocketException

from benchmarks.attacks import ATTACKS, WITH_CHROMIUM, Attack
from benchmarks.front_attacks import FRONT_ATTACKS
from benchmarks.page_client import session_query
from benchmarks.websocket import Page, free_port, open_page, say, wait_for_answer, widgets
from modeviz.analysis.results import Conditions
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.serve import serve

QUIET_S = 4.0
"""How long is looked before and after an attack."""

LONGEST_S = 90.0
"""After which an attack is ended."""

N_FILES = 1024
"""That the server may have open."""

PAUSE_S = 0.3
"""Between two moves of the quiet page."""

COLUMNS = (
    "attack",
    "memory, MB",
    "core, %",
    "terminal, B",
    "move, ms: median",
    "longest",
    "came of it",
)


@dataclass(frozen=True)
class Phase:
    """What was seen before, during or after an attack."""

    memory_mb: float
    """The most that the server and what it started took."""
    core: float
    """Processor time a second."""
    moves_s: list[float]
    """How long each of the quiet page took."""


@dataclass(frozen=True)
class Outcome:
    """What an attack came to."""

    attack: str
    phases: list[Phase]
    terminal_bytes: int
    said: str


def hostile(attack: Attack) -> Outcome:
    """Does one attack to a new server, and watches that."""
    with tempfile.NamedTemporaryFile() as terminal, _server(attack.token, terminal.name) as (port, pid):
        watch = _Watch(pid, port if attack.token is None else None)
        printed = os.path.getsize(terminal.name)
        phases, said = [], []
        for act in (_wait, lambda: said.append(_done(attack, port)), _wait):
            phases.append(watch.during(act))
        watch.end()
        return Outcome(attack.name, phases, os.path.getsize(terminal.name) - printed, said[0])


class _Watch:
    """Looks at a server, and moves a slider of it as a quiet page does."""

    def __init__(self, pid: int, port: int | None) -> None:
        """Begins to, and waits until the page is there; without a port there is none."""
        self._pid, self._most, self._is_over = pid, 0.0, False
        self._moves: list[tuple[float, float]] = []
        """When each began, and when it ended; the last may not have."""
        threading.Thread(target=self._look, daemon=True).start()
        if port is not None:
            self._begin_to_use(port)

    def _begin_to_use(self, port: int) -> None:
        """Returns once the quiet page has made two moves; another begins where one got nowhere."""
        while len(self._moves) < 2:
            self._moves.clear()
            using = threading.Thread(target=self._use, args=(port,), daemon=True)
            using.start()
            while using.is_alive() and len(self._moves) < 2:
                time.sleep(PAUSE_S)

    def during(self, act: Callable[[], None]) -> Phase:
        """What is seen while something is done."""
        self._most, begin, used = 0.0, time.monotonic(), _processor_s(self._pid)
        act()
        now = time.monotonic()
        moves = [min(end, now) - start for start, end in self._moves if end > begin and start < now]
        return Phase(self._most, (_processor_s(self._pid) - used) / (now - begin), moves)

    def end(self) -> None:
        """Ends the page and the looking."""
        self._is_over = True

    def _look(self) -> None:
        while not self._is_over:
            self._most = max(self._most, sum(map(_memory_mb, _family(self._pid))))
            time.sleep(0.05)

    def _use(self, port: int) -> None:
        """Moves a slider; another page sees when it was heard, and the spectrum after that."""
        broken = WebSocketException, TimeoutError, OSError
        query = session_query(port)
        with suppress(*broken), open_page(port, query) as page, open_page(port, query) as other:
            slider, spectrum = widgets(page)
            widgets(other)
            threading.Thread(target=_read, args=(page,), daemon=True).start()
            low, high = (slider["props"][end] for end in ("min", "max"))
            for part in cycle((0.2, 0.5, 0.8, 0.35, 0.65)):
                begin, value = time.monotonic(), round(low + part * (high - low))
                self._moves.append((begin, math.inf))
                say(page, slider, value)
                wait_for_answer(other, slider, value, spectrum)
                self._moves[-1] = begin, time.monotonic()
                if self._is_over:
                    return
                time.sleep(PAUSE_S)


def _read(page: Page) -> None:
    """Reads what nobody wants to know, so that the server can go on."""
    with suppress(WebSocketException, TimeoutError):
        while True:
            page.recv(timeout=LONGEST_S)


def _wait() -> None:
    time.sleep(QUIET_S)


def _done(attack: Attack, port: int) -> str:
    """Runs an attack in a process of its own; what it says, or that it had to be ended."""
    context = multiprocessing.get_context("spawn")
    ear, mouth = context.Pipe(duplex=False)
    process = context.Process(target=_attack, args=(attack.run, port, mouth), daemon=True)
    process.start()
    said = ear.recv() if ear.poll(LONGEST_S) else "ended, it took too long"
    process.terminate()
    process.join()
    return said


def _attack(run: Callable[[int], str], port: int, mouth: Connection) -> None:
    try:
        mouth.send(run(port))
    except Exception as error:
        mouth.send(f"ended by {type(error).__name__}")


@contextmanager
def _server(token: str | None, terminal: str) -> Iterator[tuple[int, int]]:
    """The port and the process of the built-in truck's page, which prints into a file."""
    port = free_port()
    context = multiprocessing.get_context("spawn")
    process = context.Process(target=_serve, args=(port, token, terminal), daemon=True)
    process.start()
    assert process.pid
    try:
        while "?token=" not in (printed := Path(terminal).read_text()) and "http://" not in printed:
            if not process.is_alive():
                raise RuntimeError(f"the server did not start: {printed}")
            time.sleep(0.1)
        yield port, process.pid
    finally:
        process.kill()
        process.join()


def _serve(port: int, token: str | None, terminal: str) -> None:
    """Serves the page with as many open files as a shell usually allows."""
    output = os.open(terminal, os.O_WRONLY | os.O_APPEND)
    os.dup2(output, sys.stdout.fileno())
    os.dup2(output, sys.stderr.fileno())
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (N_FILES, most))
    vehicle = read_vehicle(builtin_vehicle())
    conditions = Conditions(vehicle.roads[0].name, vehicle.speed)
    serve(
        {vehicle.name: Bench(vehicle, vehicle.rates, conditions)},
        "127.0.0.1",
        port,
        token=Secret(token) if token else None,
        dark=False,
    )


def _family(pid: int) -> list[int]:
    """A process and all it started."""
    children: dict[int, list[int]] = {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            fields = path.read_text().rpartition(")")[2].split()
            children.setdefault(int(fields[1]), []).append(int(path.parent.name))
    found = [pid]
    for each in found:
        found += children.get(each, [])
    return found


def _memory_mb(pid: int) -> float:
    try:
        pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    except OSError:
        return 0.0
    return pages * resource.getpagesize() / 2**20


def _processor_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def row(outcome: Outcome) -> str:
    """What an attack came to, in Markdown; before, during and after are separated by slashes."""
    phases = outcome.phases
    return _cells(
        outcome.attack,
        " / ".join(f"{phase.memory_mb:.0f}" for phase in phases),
        " / ".join(f"{100 * phase.core:.0f}" for phase in phases),
        f"{outcome.terminal_bytes}",
        " / ".join(_ms(phase, statistics.median) for phase in phases),
        " / ".join(_ms(phase, max) for phase in phases),
        outcome.said,
    )


def _cells(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def _ms(phase: Phase, of: Callable[[list[float]], float]) -> str:
    return f"{1000 * of(phase.moves_s):.0f}" if phase.moves_s else "-"


def main(arguments: Sequence[str] | None = None) -> None:
    """Does the attacks and prints what they came to."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.hostile", description=__doc__)
    parser.add_argument("--only", default="", metavar="TEXT", help="attacks whose name has this")
    parser.add_argument("--chromium", action="store_true", help="the one that starts a Chromium, too")
    options = parser.parse_args(arguments)
    attacks = (*ATTACKS, *FRONT_ATTACKS, *((WITH_CHROMIUM,) if options.chromium else ()))
    chosen = [attack for attack in attacks if options.only in attack.name]
    print(_cells(*COLUMNS), _cells(*("---" for _ in COLUMNS)), sep="\n")
    for attack in chosen:
        print(row(hostile(attack)), flush=True)


if __name__ == "__main__":
    main()
