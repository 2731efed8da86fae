"""A long computation beside a tuning session: one at a time, told of, held, cancelled at once."""

import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, Literal, Protocol, TypeVar

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import ModevizError
from modeviz.text.log import our_mistake
from modeviz.viewer.session.worker import LOOKS, stuck

TELL_EVERY = 0.25
"""s between two words on how far it is."""

SILENT_FOR = 600.0
"""s: what does not ask its token for so long hangs; preparing and checking take minutes at most."""

MOST_LEFT = 4
"""Computations that were cancelled, or given up, and whose threads have not ended."""

PATIENCE = 3.0
"""s that a session waits for the end of what it cancelled: the full model may take longer."""

Phase = Literal["running", "paused", "ending", "ended", "cancelled", "failed"]
RUNNING: tuple[Phase, ...] = ("running", "paused", "ending")

Asked = TypeVar("Asked")
Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class Job(Generic[Asked, Found]):
    """The state of a computation at some moment."""

    asked: Asked
    phase: Phase = "running"
    """Of what was cancelled and is still waited for, see `is_awaited`, it is "ending"."""
    done: float = 0.0
    """The fraction that is done."""
    found: Found | None = None
    """What was found; on the way, or once cancelled, what there is of it."""
    failure: str = ""
    """Why it failed, if so."""

    @property
    def is_running(self) -> bool:
        return self.phase in RUNNING

    @property
    def is_awaited(self) -> bool:
        """Whether it gives something worth waiting for when it is cancelled now."""
        return False


AnyJob = TypeVar("AnyJob", bound=Job[Any, Any])


class Tell(Protocol):
    """Told what is new of a computation."""

    def __call__(self, at_once: bool = False, **news: Any) -> None:
        """Keeps fields of the `Job`, and has them looked at: at once, or when it is time again."""
        ...


class BackgroundTask(Generic[AnyJob]):
    """Runs a computation in a thread of its own."""

    def __init__(
        self,
        what: str,
        work: Callable[[AnyJob, CancelToken, Tell], Any],
        changed: Callable[[], None],
        report: Callable[[Exception], str],
        patience: float = SILENT_FOR,
    ) -> None:
        """Starts nothing.

        Args:
            what: it is: "scatter".
            work: does a job and returns what it found, asks its token often and tells what is new.
            changed: told that there is something new to look at.
            report: told what is our mistake; gives the number under which it is logged.
            patience: s that the work may go on without asking its token.
        """
        self._what, self._work, self._report = what, work, report
        self._watchers: list[Callable[[AnyJob], None]] = [lambda _: changed()]
        self._patience = patience
        self._lock = threading.Lock()
        self._token = CancelToken()
        self._thread: threading.Thread | None = None
        self._left: list[threading.Thread] = []
        self.job: AnyJob | None = None
        """The newest; None before the first."""

    def watch(self, watcher: Callable[[AnyJob], None]) -> None:
        """Has somebody else given every job when there is something new, which may be over by then."""
        self._watchers.append(watcher)

    def start(self, job: AnyJob) -> None:
        """Begins, once everybody has been told of it in the calling thread.

        Raises:
            ModevizError: another one is running, or too many that were cancelled have not ended yet.
        """
        token = CancelToken()
        thread = threading.Thread(target=self._run, args=(job, token), name=self._what, daemon=True)
        with self._lock:
            if self.job and self.job.is_running:
                raise ModevizError(f"a {self._what} is running: cancel it first")
            self._left = [each for each in [*self._left, self._thread] if each and each.is_alive()]
            if len(self._left) >= MOST_LEFT:
                raise ModevizError(
                    f"{len(self._left)} computations that were cancelled have not ended: wait for them"
                )
            self.job, self._token, self._thread = job, token, thread
        self._look(job)
        thread.start()
        threading.Thread(target=self._watch, args=(token, thread), name="watch", daemon=True).start()

    def show(self, job: AnyJob) -> None:
        """Takes a job that ended before for the newest.

        Raises:
            ModevizError: one is running.
        """
        with self._lock:
            if self.job and self.job.is_running:
                raise ModevizError(f"a {self._what} is running: cancel it first, or wait for it")
            self.job = job
        self._look(job)

    def pause(self) -> None:
        """Holds what is running."""
        self._turn("running", "paused", CancelToken.pause)

    def resume(self) -> None:
        """Lets it go on."""
        self._turn("paused", "running", CancelToken.resume)

    def cancel(self) -> None:
        """Ends what is running; if it is not awaited, it is over at once, and its thread soon."""
        self._token.cancel()
        with self._lock:
            job = self.job
            if job is None or not job.is_running:
                return
            self.job = job = replace(job, phase="ending" if job.is_awaited else "cancelled")
        self._look(job)

    def close(self) -> None:
        """Ends what is running and waits for its thread, but not longer than anybody would."""
        self.cancel()
        if self._thread is not None and self._thread.is_alive():
            self._thread.join(PATIENCE)

    def _look(self, job: AnyJob) -> None:
        """Has somebody look at what is new, who may fail: that is not the computation's fault."""
        for watcher in tuple(self._watchers):
            try:
                watcher(job)
            except Exception as error:
                self._report(error)

    def _run(self, job: AnyJob, token: CancelToken) -> None:
        told = -math.inf  # then it was last said how far it is

        def tell(at_once: bool = False, **news: Any) -> None:
            nonlocal told
            is_due = time.monotonic() - told > TELL_EVERY
            kept = self._keep(token, **news)
            if kept and (is_due or at_once):
                told = told if at_once else time.monotonic()
                self._look(kept)

        try:
            found = self._work(job, token, tell)
        except Exception as error:
            tell(at_once=True, **self._ending(error, token))
        else:
            tell(at_once=True, phase="ended", done=1.0, found=found)

    def _watch(self, token: CancelToken, thread: threading.Thread) -> None:
        """Gives a computation up that hangs: its thread cannot be ended, but is not waited for."""
        while thread.is_alive() and token.silence < self._patience:
            thread.join(self._patience / LOOKS)
        if not thread.is_alive():
            return
        token.cancel()
        error = stuck(thread, self._patience)
        if self._keep(token):
            failure = f"{error}. {our_mistake(self._report(error))}"
            failed = self._keep(token, phase="failed", failure=failure)
            if failed:
                self._look(failed)

    def _ending(self, error: Exception, token: CancelToken) -> dict[str, str]:
        """Return what there is to say of a job that an error ended."""
        if not isinstance(error, ModevizError | CancelledError):
            return {"phase": "failed", "failure": our_mistake(self._report(error))}
        if token.is_cancelled:
            return {"phase": "cancelled"}
        return {"phase": "failed", "failure": str(error)}

    def _turn(self, before: Phase, after: Phase, turn: Callable[[CancelToken], None]) -> None:
        """Goes on to a phase from another one, if it is in that."""
        with self._lock:
            if self.job is None or self.job.phase != before:
                return
            turn(self._token)
            self.job = job = replace(self.job, phase=after)
        self._look(job)

    def _keep(self, token: CancelToken, **news: Any) -> AnyJob | None:
        """Keeps news of the newest while it runs, and returns it; None of one that was cancelled."""
        with self._lock:
            if token is not self._token or self.job is None or not self.job.is_running:
                return None
            self.job = job = replace(self.job, **news)
        return job
