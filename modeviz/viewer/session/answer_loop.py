"""Answers the newest state that is asked for, one at a time, in a thread of its own."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from modeviz.analysis.results import Results
from modeviz.errors import ModevizError
from modeviz.viewer.session.answers import Answers, Solved, asks_for_the_same
from modeviz.viewer.session.asked import Asked
from modeviz.viewer.session.findings import Findings
from modeviz.viewer.session.followed_mode import DETAILS_EVERY
from modeviz.viewer.session.history import Moment
from modeviz.viewer.session.inspector import Inspector
from modeviz.viewer.session.notifications import Answered, Checked, Failed, Notification, Preparing
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State
from modeviz.viewer.session.worker import StuckError, Worker

PREPARES_WITHIN = 600.0
"""s between two words on how far a preparation is, whose longest step is the modes of a large body."""

FOLLOWS = 0.3
"""s: a vehicle that is prepared in less follows the hand that alters it; others wait for it to rest,
and say so often how far they are."""


class _OvertakenError(Exception):
    """The vehicle is to be altered otherwise by now."""


@dataclass(frozen=True, eq=False)
class _Job:
    """A state to be answered."""

    moment: Moment
    """With what led there."""
    drawing: int
    """The number of the drawing that is asked for; one that was drawn already is only told on."""

    @property
    def state(self) -> State:
        return self.moment.state


class AnswerLoop:
    """Answers, tells, and has every answer inspected; what goes wrong is taken back.

    Where we go wrong, or a solve hangs, it goes back to the last state that was answered and told in
    whole, with the history it had then: nobody is left with what nobody can answer.
    """

    def __init__(
        self,
        asked: Asked,
        answers: Answers,
        shared: Shared,
        notify: Callable[[Notification], None],
        patience: float,
    ) -> None:
        """Answers nothing before `start`.

        Args:
            asked: what is asked for.
            answers: to all that may be.
            shared: what the session has in common with others, whose inquiries wait for answers.
            notify: told of every answer and failure; what it raises is our mistake.
            patience: s that a solve may take.
        """
        self._asked, self.answers, self._notify = asked, answers, notify
        self._precedence = shared.precedence
        self._lock = threading.Lock()
        self._is_prepared = self._is_closed = False
        self._n_drawings, self._n_drawn = 0, -1
        self._told_at = 0.0
        self.answer: Solved | None = None
        """The newest, once there is one."""
        self._failure: Exception | None = None
        self._good: Moment | None = None
        self._worker: Worker[_Job] = Worker(self._work, self._tell_failure, patience, self._leave)
        self._inspector = Inspector(
            shared,
            self._rebase,
            self._is_current,
            self.ask,
            self._tell_failure,
        )

    @property
    def is_stuck(self) -> bool:
        """Whether it goes on only once a solve ends that hangs."""
        return self._worker.is_stuck

    def start(self, progress: Callable[[float], None] | None) -> None:
        """Prepares the vehicle and asks for the first answer; as `Session.start`."""
        with self._precedence.answer():
            self.answers.prepare(self._asked.state, progress)
        self._is_prepared = True
        self.ask()

    def ask(self, is_to_be_drawn: bool = True) -> None:
        """Has the newest state answered, and drawn or only told, once the vehicle is prepared."""
        with self._lock:
            self._n_drawings += is_to_be_drawn
            if self._is_prepared:
                self._worker.submit(_Job(self._asked.moment, self._n_drawings))

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered in detail; whether that came within `timeout` s."""
        end = time.perf_counter() + timeout
        while self._worker.wait(end - time.perf_counter()):
            last = self.answer
            if last is None or last.is_detailed or not self._answers_what_is_asked(last):
                return True
            if time.perf_counter() > end:
                return False
            time.sleep(DETAILS_EVERY / 10)
        return False

    def wait_checked(self, timeout: float) -> bool:
        """Waits until the newest answer is checked; whether that came within `timeout` seconds."""
        return self.wait(timeout) and self._inspector.wait(timeout) and self._worker.wait(timeout)

    def wait_for_answer(self, timeout: float) -> Solved:
        """Waits for the answer to what is asked for; as `Session.wait_for_answer`."""
        if not self.wait(timeout):
            raise ModevizError(f"there was no answer within {timeout:.0f} s")
        answer = self.answer
        if answer is None or self._asked.is_refused or not self._answers_what_is_asked(answer):
            raise self._failure or ModevizError("there is no answer")
        return answer

    def close(self) -> None:
        """Ends the threads."""
        self._is_closed = True
        self._worker.close()
        self._inspector.close()

    def _work(self, job: _Job) -> None:
        """Answers a job before others do what nobody waits for."""
        with self._precedence.answer():
            self._answer_job(job)

    def _answer_job(self, job: _Job) -> None:
        """Answers a job and tells the answer, or that there is none."""
        try:
            solved = self._solve(job)
        except _OvertakenError:
            return
        except ModevizError as error:
            if self._worker.is_heard:
                self._tell_failure(error)
            return
        except Exception as error:
            if self._worker.is_heard:
                self._give_up(job, error)
            return
        if self._worker.is_heard:
            self._worker.sign()
            self._take(job, solved)

    def _solve(self, job: _Job) -> Solved:
        if not self.answers.is_ready(job.state.design.alterations):
            self._worker.sign(PREPARES_WITHIN)
        self._told_at = time.perf_counter()
        follow = partial(self._follow_preparing, job.state)
        return self.answers.answer(job.state, self._findings, follow)

    def _findings(self, now: Results) -> Findings:
        """Return what is known of results; nothing to a solve that was left behind."""
        return self._inspector.findings(now) if self._worker.is_heard else Findings(now)

    def _follow_preparing(self, state: State, fraction: float) -> None:
        """Tells now and then how far a preparation is, or ends one that was overtaken."""
        if not self._worker.is_heard:
            raise _OvertakenError
        self._worker.sign(PREPARES_WITHIN if fraction < 1 else None)
        now = time.perf_counter()
        if now - self._told_at < FOLLOWS:
            return
        if state.design.alterations != self._asked.state.design.alterations:
            raise _OvertakenError
        self._told_at = now
        self._notify(Preparing(fraction))

    def _take(self, job: _Job, solved: Solved) -> None:
        """Keeps an answer and tells it."""
        before, self.answer = self.answer, solved
        if not self._asked.is_refused:
            self._failure = None
        try:
            self._notify(Answered(solved) if job.drawing > self._n_drawn else Checked(solved))
        except Exception as error:
            self.answer = before
            self._give_up(job, error)
            return
        self._n_drawn = job.drawing
        if solved.is_detailed:
            self._good = job.moment
        self._inspector.submit(solved)

    def _leave(self, job: _Job, error: StuckError, is_left: bool) -> None:
        """Goes on without a solve that hangs."""
        if is_left:
            self._give_up(job, error)
        else:
            self._tell_failure(error)

    def _give_up(self, job: _Job, error: Exception) -> None:
        """Goes on as if what went wrong had not been asked for, unless something else is by now."""
        self.answers = self.answers.afresh()
        is_back = self._asked.take_back(job.state, self._good)
        if self._asked.state is not job.state:
            self.ask()
        self._tell_failure(error, is_back)

    def _tell_failure(self, error: Exception, is_back: bool = False) -> None:
        self._failure = error
        self._notify(Failed(error, is_back))

    def _rebase(self, state: State) -> None:
        self.answers.rebase(state)

    def _is_current(self, solved: Solved) -> bool:
        """Whether an answer is still to what is asked for."""
        return not self._is_closed and self._answers_what_is_asked(solved)

    def _answers_what_is_asked(self, solved: Solved) -> bool:
        return asks_for_the_same(solved.state, self._asked.state)
