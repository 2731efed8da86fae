"""One thread that always does the newest job and drops what was overtaken."""

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

Job = TypeVar("Job")


class Worker(Generic[Job]):
    """Runs `work` on the last job submitted, one at a time, in a thread of its own.

    A job that arrives while another runs replaces any that waits: after a burst the last one is
    always done, those between may not be.
    """

    def __init__(self, work: Callable[[Job], None], fail: Callable[[Exception], None]) -> None:
        """Starts the thread.

        Args:
            work: what to do with a job.
            fail: told what went wrong with one; the next is done all the same.
        """
        self._work, self._fail = work, fail
        self._changed = threading.Condition()
        self._waiting: list[Job] = []
        self._busy = self._closed = False
        self._thread = threading.Thread(target=self._run, name="worker", daemon=True)
        self._thread.start()

    def submit(self, job: Job) -> None:
        """Asks for a job in place of whatever waits; returns at once."""
        with self._changed:
            self._waiting[:] = [job]
            self._changed.notify_all()

    def wait(self, timeout: float) -> bool:
        """Waits until nothing is left to do; whether that came within `timeout` seconds."""
        with self._changed:
            return self._changed.wait_for(lambda: not (self._busy or self._waiting), timeout)

    def close(self) -> None:
        """Ends the thread after the job it is at."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._thread.join()

    def _run(self) -> None:
        while (job := self._next()) is not None:
            try:
                self._work(job[0])
            except Exception as error:
                self._fail(error)

    def _next(self) -> list[Job] | None:
        """The next job in a list, or None when there will be no more."""
        with self._changed:
            self._busy = False
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._waiting or self._closed)
            if self._closed:
                return None
            self._busy = True
            return [self._waiting.pop()]
