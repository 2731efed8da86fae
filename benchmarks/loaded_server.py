"""A server in a process of its own that tells what it takes, for pages that come in numbers."""

import gc
import io
import multiprocessing
import resource
import threading
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any
from weakref import WeakSet

from benchmarks.websocket import free_port
from modeviz.files import read_vehicle
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.study.conditions import road_conditions
from modeviz.viewer.serving import open_sessions
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.open_session import OpenSession
from modeviz.viewer.serving.serve import serve

IDLE_S, LOOKS_EVERY_S = 2.0, 0.5
"""After which a session that nobody looks at leaves memory; in use it is a quarter of an hour."""


@dataclass(frozen=True)
class Usage:
    """What a server takes."""

    memory_mb: float
    n_sessions: int
    """In memory."""
    n_threads: int
    n_files: int


class LoadedServer:
    """The server as seen from the process of its pages."""

    def __init__(self, port: int, questions: Connection) -> None:
        self.port, self._questions = port, questions

    def usage(self) -> Usage:
        """What it takes now."""
        return self._asked("usage")

    def has_answered(self) -> bool:
        """Whether every session has answered what was last asked of it."""
        return self._asked("answered")

    def shared(self, session: str) -> str:
        """The key of a review of a session."""
        return self._asked(session)

    def _asked(self, question: str) -> Any:
        self._questions.send(question)
        return self._questions.recv()


@contextmanager
def loaded_server(folder: Path, study: Path) -> Iterator[LoadedServer]:
    """A server of a vehicle's folder, whose sessions a study file remembers."""
    port, context = free_port(), multiprocessing.get_context("spawn")
    questions, far_end = context.Pipe()
    process = context.Process(target=_serve, args=(folder, study, port, far_end), daemon=True)
    process.start()
    try:
        assert questions.recv() == "ready"
        yield LoadedServer(port, questions)
    finally:
        process.terminate()
        process.join()


_sessions: WeakSet[OpenSession] = WeakSet()
"""Of this process; each leaves by itself once nothing holds it."""


class _Counted(OpenSession):
    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        _sessions.add(self)


def _serve(folder: Path, study: Path, port: int, questions: Connection) -> None:
    open_sessions.IDLE, open_sessions.LOOKS_EVERY = IDLE_S, LOOKS_EVERY_S
    open_sessions.OpenSession = _Counted
    vehicle = read_vehicle(folder)
    conditions = road_conditions(vehicle, None, vehicle.speed)
    remembering = StudyFile.open(study, vehicle.name, fingerprint_of(vehicle))
    bench = Bench(vehicle, vehicle.rates, conditions, study=remembering)
    threading.Thread(target=_answer, args=(bench, questions), daemon=True).start()
    with redirect_stdout(io.StringIO()):
        serve({vehicle.name: bench}, "127.0.0.1", port, token=None, dark=False)


def _answer(bench: Bench, questions: Connection) -> None:
    bench.prepared()
    questions.send("ready")
    while question := questions.recv():
        told = {"usage": _usage, "answered": _has_answered}.get(question)
        questions.send(told() if told else _shared(question))


def _has_answered() -> bool:
    return all(each.app.session.wait(0.0) for each in _sessions)


def _shared(session: str) -> str:
    """Shares a session that is open, as its owner does on the page, and gives the key of the review."""
    visitors = next(each for each in _sessions if each.server.link.endswith(session)).server.visitors
    return visitors.share().partition("review=")[2]


def _usage() -> Usage:
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return Usage(
        memory_mb=pages * resource.getpagesize() / 2**20,
        n_sessions=len(_sessions),
        n_threads=threading.active_count(),
        n_files=len(list(Path("/proc/self/fd").iterdir())),
    )
