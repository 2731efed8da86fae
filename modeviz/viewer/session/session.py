"""A tuning session: what is asked for, its history, and when it is answered. Nothing of the screen."""

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from modeviz.analysis.preparation import Prepared
from modeviz.errors import ModevizError
from modeviz.vehicle.placement import check_placements
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Answers, Solved, asks_for_the_same
from modeviz.viewer.session.author import OWNER, Author, NotOnesOwnError
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.design import Design
from modeviz.viewer.session.followed_mode import DETAILS_EVERY
from modeviz.viewer.session.history import Accepted, History, Moment, Step
from modeviz.viewer.session.inspector import Inspector
from modeviz.viewer.session.notifications import Answered, Checked, Failed, Notification, Preparing
from modeviz.viewer.session.preparations import Preparations
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State
from modeviz.viewer.session.worker import StuckError, Worker

SOLVES_WITHIN = 60.0
"""s: what takes longer hangs, as answers come in milliseconds."""

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


class Session:
    """Takes commands, keeps the newest state and its answer, and tells both on.

    Every answer is told in one thread, never two at once.

    Where we go wrong, or a solve hangs, the session goes back to the last state that was answered and
    told in whole, with the history it had then: nobody is left with what nobody can answer.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        state: State,
        notify: Callable[[Notification], None],
        patience: float = SOLVES_WITHIN,
        past: Sequence[Step] = (),
        future: Sequence[Step] = (),
        shared: Shared | None = None,
        acting: Callable[[], Author] = lambda: OWNER,
    ) -> None:
        """Nothing is solved before `start`.

        Args:
            vehicle: with the rates that are called the original ones.
            state: what to show first.
            notify: told of every answer and failure; what it raises is our mistake.
            patience: s that a solve may take.
            past: what can be undone, the next one last.
            future: what can be redone, the next one last.
            shared: what other sessions of the vehicle have in common with it, if there are any.
            acting: says who asks for what is done, in the thread in which it is.

        Raises:
            VehicleError: it cannot have the absorbers of the state.
        """
        self._notify, self._acting = notify, acting
        self._lock = threading.Lock()
        self._history = History(state, self._settled, past, future)
        self._watchers: list[Callable[[Accepted], None]] = []
        self._is_prepared = self._is_closed = False
        self._n_drawings, self._n_drawn = 0, -1
        self._told_at = 0.0
        self._answer: Solved | None = None
        self._failure: Exception | None = None
        self._good: Moment | None = None
        self._is_refused = False
        shared = shared or Shared(Preparations(vehicle))
        self._precedence = shared.precedence
        self._answers = Answers(shared, state.design.alterations.absorbers)
        self._worker: Worker[_Job] = Worker(self._work, self._tell_failure, patience, self._leave)
        self._inspector = Inspector(
            shared, self._rebase, self._is_current, self._answer_again, self._tell_failure
        )

    @property
    def vehicle(self) -> Vehicle:
        """With the rates that are called the original ones, altered as in the newest answer."""
        return self._answers.vehicle

    @property
    def original(self) -> Vehicle:
        """As in its file."""
        return self._answers.original

    @property
    def state(self) -> State:
        return self._history.state

    @property
    def answer(self) -> Solved | None:
        """The newest answer, once there is one."""
        return self._answer

    @property
    def prepared(self) -> Prepared:
        """The vehicle made ready; there is none before `start`."""
        return self._answers.prepared

    @property
    def is_stuck(self) -> bool:
        """Whether it goes on only once a solve ends that hangs."""
        return self._worker.is_stuck

    @property
    def can_undo(self) -> bool:
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        return self._history.can_redo

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, solves with its named sets of rates and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        with self._precedence.answer():
            self._answers.prepare(self.state, progress)
        with self._lock:
            self._is_prepared = True
            self._worker.submit(_Job(self._history.moment, self._n_drawings))

    def do(self, command: Command) -> None:
        """Asks for what a command makes of the newest state; returns at once.

        Raises:
            VehicleError: it asks for what the vehicle does not have.
        """
        with self._lock:
            self._is_refused = False
            state = command.apply(self.state, self.with_parts_of(self.state))
            if state.design.alterations != self.state.design.alterations:
                vehicle = self.with_parts_of(state)
                check_placements(vehicle, state.design.alterations.placements)
                state = state.with_known_parts(self.state.design, vehicle)
            self._accept(self._history.put(state, command.step, command.within, self._acting()))
            self._submit()

    def undo(self, insists: bool = False) -> None:
        """Goes back to what was decided before the last change.

        Args:
            insists: whether to go back over somebody else's, too, which the owner may.

        Raises:
            NotOnesOwnError: the last change is not one's own.
        """
        with self._lock:
            self._go(self._history.undone_next, self._history.undo, insists)

    def redo(self, insists: bool = False) -> None:
        """Takes the last undoing back; as `undo`."""
        with self._lock:
            self._go(self._history.redone_next, self._history.redo, insists)

    def with_parts_of(self, state: State) -> Vehicle:
        """Return the vehicle with the parts that a state adds, and its mounts as they were given."""
        return self._answers.with_parts(state.design.alterations)

    def draw_again(self) -> None:
        """Asks for the present state once more: something else is to be drawn with it."""
        with self._lock:
            self._submit()

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered in detail; whether that came within `timeout` s."""
        end = time.perf_counter() + timeout
        while self._worker.wait(end - time.perf_counter()):
            last = self._answer
            if last is None or last.is_detailed or not asks_for_the_same(last.state, self.state):
                return True
            time.sleep(DETAILS_EVERY / 10)
        return False

    def wait_checked(self, timeout: float) -> bool:
        """Waits until the newest answer is checked; whether that came within `timeout` seconds."""
        return self.wait(timeout) and self._inspector.wait(timeout) and self._worker.wait(timeout)

    def wait_for_answer(self, timeout: float) -> Solved:
        """Waits for the answer to what is asked for, and gives it once it was told.

        Args:
            timeout: how long to wait, s.

        Raises:
            ModevizError: there is no such answer, or not in time.
        """
        if not self.wait(timeout):
            raise ModevizError(f"there was no answer within {timeout:.0f} s")
        answer = self._answer
        is_answered = answer is not None and asks_for_the_same(answer.state, self.state)
        if self._is_refused or not is_answered:
            raise self._failure or ModevizError("there is no answer")
        assert answer is not None
        return answer

    def close(self) -> None:
        """Ends the session's threads."""
        self._is_closed = True
        self._worker.close()
        self._inspector.close()

    def watch(self, watcher: Callable[[Accepted], None]) -> None:
        """Has somebody told of all that is accepted from now on.

        Args:
            watcher: called in the thread that asked for it, before it is answered; the session waits.
        """
        with self._lock:
            self._watchers.append(watcher)

    def _accept(self, *accepted: Accepted) -> None:
        for each in accepted:
            for watcher in self._watchers:
                watcher(each)

    def _go(self, change: Step | None, step: Callable[[], Accepted | None], insists: bool) -> None:
        """Goes over a change, if there is one and it is one's own; the lock is held."""
        acting = self._acting()
        is_own = change is None or change.author == acting
        if change is not None and not is_own and not (insists and acting.is_owner):
            raise NotOnesOwnError(change.author, acting)
        self._is_refused = False
        if accepted := step():
            self._accept(accepted)
            self._submit()

    def _settled(self, before: Design, state: State) -> State:
        return state.with_known_parts(before, self.with_parts_of(state))

    def _submit(self) -> None:
        """Has the newest state answered and drawn, once the vehicle is prepared."""
        self._n_drawings += 1
        if self._is_prepared:
            self._worker.submit(_Job(self._history.moment, self._n_drawings))

    def _answer_again(self, is_to_be_drawn: bool) -> None:
        """Has the newest state answered with what is known by now, and drawn or only told."""
        with self._lock:
            self._n_drawings += is_to_be_drawn
            self._worker.submit(_Job(self._history.moment, self._n_drawings))

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
                self._go_back(job, error)
            return
        if self._worker.is_heard:
            self._worker.sign()
            self._take(job, solved)

    def _solve(self, job: _Job) -> Solved:
        if not self._answers.is_ready(job.state.design.alterations):
            self._worker.sign(PREPARES_WITHIN)
        self._told_at = time.perf_counter()
        follow = partial(self._follow_preparing, job.state)
        return self._answers.answer(job.state, self._inspector.findings, follow)

    def _take(self, job: _Job, solved: Solved) -> None:
        """Keeps an answer and tells it."""
        before, self._answer = self._answer, solved
        if not self._is_refused:
            self._failure = None
        try:
            self._notify(Answered(solved) if job.drawing > self._n_drawn else Checked(solved))
        except Exception as error:
            self._answer = before
            self._go_back(job, error)
            return
        self._n_drawn = job.drawing
        if solved.is_detailed:
            self._good = job.moment
        self._inspector.submit(solved)

    def _leave(self, job: _Job, error: StuckError, is_left: bool) -> None:
        """Goes on without a solve that hangs."""
        if is_left:
            self._go_back(job, error)
        else:
            self._tell_failure(error)

    def _go_back(self, job: _Job, error: Exception) -> None:
        """Goes on as if what went wrong had not been asked for, unless something else is by now."""
        with self._lock:
            self._answers, good = self._answers.afresh(), self._good
            is_asked = self.state is job.state
            is_back = is_asked and good is not None and good.state is not job.state
            if is_back:
                assert good is not None
                self._accept(*self._history.put_back(good))
            elif is_asked and good is None and (undone := self._history.undo()):
                self._accept(undone)
                is_back = True
            self._is_refused = is_back
            if is_back or not is_asked:
                self._submit()
        self._tell_failure(error, is_back)

    def _rebase(self, state: State) -> None:
        self._answers.rebase(state)

    def _follow_preparing(self, state: State, fraction: float) -> None:
        """Tells now and then how far a preparation is, or ends one that was overtaken."""
        if not self._worker.is_heard:
            raise _OvertakenError
        self._worker.sign(PREPARES_WITHIN if fraction < 1 else None)
        now = time.perf_counter()
        if now - self._told_at < FOLLOWS:
            return
        if state.design.alterations != self.state.design.alterations:
            raise _OvertakenError
        self._told_at = now
        self._notify(Preparing(fraction))

    def _tell_failure(self, error: Exception, is_back: bool = False) -> None:
        self._failure = error
        self._notify(Failed(error, is_back))

    def _is_current(self, solved: Solved) -> bool:
        """Whether an answer is still to what is asked for."""
        return not self._is_closed and asks_for_the_same(self.state, solved.state)
