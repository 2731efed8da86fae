"""A long computation beside a tuning session: one at a time, told of, cancelled at once."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, Literal, Protocol, TypeVar

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import ModevizError

OUR_MISTAKE = "This is our mistake: the terminal says more."

TELL_EVERY = 0.25
"""s between two words on how far it is."""

Asked = TypeVar("Asked")
Found = TypeVar("Found")
Found_contra = TypeVar("Found_contra", contravariant=True)


class Progress(Protocol[Found_contra]):
    """Told how far a computation is."""

    def __call__(self, done: float, found: Found_contra | None = None) -> None:
        """Told the fraction that is done and, if there is any, what is found so far."""
        ...


@dataclass(frozen=True, eq=False)
class Job(Generic[Asked, Found]):
    """What there is to know of a computation at some moment."""

    asked: Asked
    phase: Literal["running", "ended", "cancelled", "failed"] = "running"
    done: float = 0.0
    """The fraction that is done."""
    found: Found | None = None
    """What was found; on the way, or once cancelled, what there is of it."""
    failure: str = ""
    """Why it failed, if so."""

    @property
    def is_running(self) -> bool:
        return self.phase == "running"


class BackgroundTask(Generic[Asked, Found]):
    """Runs a computation in a thread of its own."""

    def __init__(
        self,
        what: str,
        work: Callable[[Asked, CancelToken, Progress[Found]], Found],
        changed: Callable[[], None],
        report: Callable[[Exception], None],
    ) -> None:
        """Starts nothing.

        Args:
            what: it is: "scatter".
            work: does it, asks its token often and tells how far it is.
            changed: told that there is something new to look at.
            report: told what is our mistake.
        """
        self._report = report
        self._what, self._work, self._changed = what, work, changed
        self._lock = threading.Lock()
        self._token = CancelToken()
        self._told = 0.0
        self.job: Job[Asked, Found] | None = None
        """The newest; None before the first."""

    def start(self, asked: Asked) -> None:
        """Begins.

        Raises:
            ModevizError: another one is running.
        """
        with self._lock:
            if self.job and self.job.is_running:
                raise ModevizError(f"a {self._what} is running: cancel it first")
            self.job, self._token = Job(asked), CancelToken()
        arguments = asked, self._token
        threading.Thread(target=self._run, args=arguments, name=self._what, daemon=True).start()
        self._changed()

    def cancel(self) -> None:
        """Ends what is running; here it is over at once, and its thread soon."""
        self._token.cancel()
        self._put(self._token, phase="cancelled")

    def _run(self, asked: Asked, token: CancelToken) -> None:
        def tell(done: float, found: Found | None = None) -> None:
            token.check()
            if found is not None or time.monotonic() - self._told > TELL_EVERY:
                self._told = time.monotonic()
                self._put(token, done=done, found=found)

        try:
            found = self._work(asked, token, tell)
        except CancelledError:
            return
        except ModevizError as error:
            self._put(token, phase="failed", failure=str(error))
        except Exception as error:
            self._report(error)
            self._put(token, phase="failed", failure=OUR_MISTAKE)
        else:
            self._put(token, phase="ended", done=1.0, found=found)

    def _put(self, token: CancelToken, **news) -> None:
        """Keeps news of the newest as long as it runs; those of one that was cancelled are nobody's."""
        with self._lock:
            if token is not self._token or self.job is None or not self.job.is_running:
                return
            self.job = replace(self.job, **news)
        self._changed()
