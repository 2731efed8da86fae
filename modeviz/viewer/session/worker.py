"""One thread that always does the newest job, drops what was overtaken, and is left if it hangs."""

import math
import sys
import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Generic, TypeVar

Job = TypeVar("Job")

MOST_LEFT = 3
"""Threads of one worker that hang at once: no program can end them, and each takes its memory."""

LOOKS = 10
"""A worker looks so many times within its patience whether a job hangs."""

CLOSING_S = 3.0
"""s that closing waits for the job at hand."""


class StuckError(Exception):
    """A computation was silent for so long that it was given up; its traceback is where it hangs."""


class Worker(Generic[Job]):
    """Runs `work` on the last job submitted, one at a time, in a thread of its own.

    A job that arrives while another runs replaces any that waits: after a burst the last one is
    always done, those between may not be. Nobody can end a thread: one that hangs is left behind, and
    another takes its place.
    """

    def __init__(
        self,
        work: Callable[[Job], None],
        fail: Callable[[Exception], object],
        patience: float = math.inf,
        leave: Callable[[Job, StuckError, bool], None] | None = None,
    ) -> None:
        """Starts the thread.

        Args:
            work: what to do with a job.
            fail: told what went wrong with one; the next is done all the same.
            patience: s that a job may take without a `sign`.
            leave: told, in another thread, of a job that hangs, where, and whether it is left behind;
                if too many are, it is waited for. Before another thread goes on.
        """
        self._work, self._fail, self._patience, self._leave = work, fail, patience, leave
        self._changed = threading.Condition()
        self._waiting: list[Job] = []
        self._at: Job | None = None
        self._busy = self._is_stuck = False
        self._closed = threading.Event()
        self._due = math.inf
        self._left: list[threading.Thread] = []
        self._thread = self._new_thread()
        self._thread.start()
        if leave is not None:
            threading.Thread(target=self._watch, name="watch", daemon=True).start()

    @property
    def is_stuck(self) -> bool:
        """Whether it waits for a job that hangs, as too many were left behind."""
        return self._is_stuck

    @property
    def is_heard(self) -> bool:
        """Whether the calling thread is the one that works, and not one that was left behind."""
        return threading.current_thread() is self._thread

    def submit(self, job: Job) -> None:
        """Asks for a job in place of whatever waits; returns at once."""
        with self._changed:
            self._waiting[:] = [job]
            self._changed.notify_all()

    def sign(self, patience: float | None = None) -> None:
        """Tells that the job at hand goes on, and may be silent for so many s more."""
        with self._changed:
            if self.is_heard:
                self._due = time.monotonic() + (patience or self._patience)

    def wait(self, timeout: float) -> bool:
        """Waits until nothing is left to do; whether that came within `timeout` seconds.

        Of a closed one nobody waits for what it leaves undone.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._is_done() or self._closed.is_set(), timeout)
            return self._is_done()

    def close(self) -> None:
        """Ends the thread after the job it is at, for which nobody waits long."""
        self._closed.set()
        with self._changed:
            self._changed.notify_all()
            thread = self._thread
        if thread.is_alive():
            thread.join(CLOSING_S)

    def _is_done(self) -> bool:
        return not (self._busy or self._waiting)

    def _new_thread(self) -> threading.Thread:
        return threading.Thread(target=self._run, name="worker", daemon=True)

    def _run(self) -> None:
        while (job := self._next()) is not None:
            try:
                self._work(job[0])
            except Exception as error:
                if self.is_heard:
                    self._tell(error)

    def _tell(self, error: Exception) -> None:
        """Tells what went wrong; where telling does too, Python says so and the thread goes on."""
        try:
            self._fail(error)
        except Exception:
            thread = threading.current_thread()
            threading.excepthook(threading.ExceptHookArgs((*sys.exc_info(), thread)))

    def _next(self) -> list[Job] | None:
        """The next job in a list, or None when there will be no more for this thread."""
        with self._changed:
            if not self.is_heard:
                return None
            self._busy = self._is_stuck = False
            self._at = None
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._waiting or self._closed.is_set())
            if self._closed.is_set():
                return None
            job = self._waiting.pop()
            self._busy, self._at, self._due = True, job, time.monotonic() + self._patience
            return [job]

    def _watch(self) -> None:
        """Leaves jobs behind that hang, as long as there is a worker."""
        assert self._leave is not None
        while not self._closed.wait(self._patience / LOOKS):
            with self._changed:
                if not self._busy or time.monotonic() < self._due:
                    continue
                job, error = self._at, stuck(self._thread, self._patience)
                is_left = sum(thread.is_alive() for thread in self._left) < MOST_LEFT
                if is_left:
                    self._left = [*filter(threading.Thread.is_alive, self._left), self._thread]
                    self._thread = self._new_thread()
                self._is_stuck = not is_left
                self._due = math.inf  # it is told once
            assert job is not None
            try:
                self._leave(job, error, is_left)
            except Exception as mistake:
                self._tell(mistake)
            finally:
                if is_left:
                    self._thread.start()


def stuck(thread: threading.Thread, seconds: float) -> StuckError:
    """Return an error whose traceback is where a thread is that was silent for so long, s."""
    where: TracebackType | None = None
    frame = sys._current_frames().get(thread.ident or 0)
    while frame is not None:
        where = TracebackType(where, frame, frame.f_lasti, frame.f_lineno)
        frame = frame.f_back
    text = f"there was no sign of life for {seconds:.0f} s, and it was given up"
    return StuckError(text).with_traceback(where)
