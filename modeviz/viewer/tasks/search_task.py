"""A search for better rates in a tuning session: its thread, what it tells, and what comes of it."""

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import count
from typing import Literal

import numpy as np

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import ModevizError
from modeviz.optimise.run import Optimum, Progress, optimise
from modeviz.optimise.search import Search, prepare_search
from modeviz.optimise.starts import start_points
from modeviz.report.optimum import compared_outside
from modeviz.scatter.robust import optimise_robustly, robust_search
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State, rate_sets
from modeviz.viewer.tasks.background_task import OUR_MISTAKE, TELL_EVERY

PATIENCE = 3.0
"""s that a session waits for the end of its search: the full model may take longer."""

Phase = Literal["preparing", "searching", "paused", "checking", "ended", "failed"]
RUNNING: tuple[Phase, ...] = ("preparing", "searching", "paused", "checking")


@dataclass(frozen=True, eq=False)
class SearchStatus:
    """What there is to know of a search at some moment."""

    problem: Problem
    before: Rates
    """The rates that it began with."""
    phase: Phase = "preparing"
    is_robust: bool = False
    """Whether the goal is a percentile over parts that scatter by now."""
    original: float = np.nan
    """The goal with the vehicle's own rates."""
    reference: float = np.nan
    """With the problem's set to compare with; NaN if it has none."""
    outside: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Why these two, by name, could not be found; nothing for what could."""
    progress: Progress | None = None
    """The best design so far; None while there is none."""
    history: tuple[tuple[int, float], ...] = ()
    """Every better design: the number of the evaluation, and its goal."""
    optimum: Optimum | None = None
    """What was found, once the search has ended."""
    failure: str = ""
    """Why it failed, if so."""

    @property
    def is_running(self) -> bool:
        return self.phase in RUNNING


class SearchTask:
    """One search in a thread of its own, which the session's rates follow.

    They follow as long as nobody else changes them: no slider is taken out of anybody's hand.
    """

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], None]
    ) -> None:
        """Starts it.

        Args:
            session: whose state says what is sought, and from where.
            changed: told that there is something new to look at.
            report: told what is our mistake.

        Raises:
            VehicleError: the state's plan asks for what cannot be.
        """
        state, vehicle = session.state, session.vehicle
        assert state.plan is not None
        self.look: SearchStatus = SearchStatus(planned(vehicle, state.plan), state.rates)
        self._session, self._changed, self._report = session, changed, report
        self._state, self._plan = state, state.plan
        self._token, self._lock = CancelToken(), threading.Lock()
        self._followed: Rates = state.rates
        self._told = 0.0
        self._thread = threading.Thread(target=self._run, name="optimiser", daemon=True)
        self._thread.start()

    def pause(self) -> None:
        """Holds it, with the session at the best design so far."""
        if self._turn("paused", "preparing", "searching"):
            self._token.pause()
            self._follow()

    def resume(self) -> None:
        """Lets it go on."""
        if self._turn("searching", "paused"):
            self._token.resume()

    def cancel(self) -> None:
        """Ends it with the session at the best design so far; while it prepares it is over at once."""
        self._token.cancel()
        self._turn("ended", "preparing")
        if self._turn("checking", "searching", "paused"):
            self._follow()

    def join(self) -> None:
        """Waits for the end of the thread, but not longer than anybody would."""
        self._thread.join(PATIENCE)

    def change(self, change: Callable[[State], State]) -> None:
        """Changes the session's state as a part of the search, which is undone as a whole."""
        self._session.update(change, kind=self, within=np.inf)

    def _run(self) -> None:
        try:
            optimum = self._search()
        except CancelledError:
            self._put(phase="ended")
        except ModevizError as error:
            self._fail(str(error))
        except Exception as error:
            self._report(error)
            self._fail(OUR_MISTAKE)
        else:
            self._end(optimum)

    def _search(self) -> Optimum:
        """What is found as drawn or, from there, for parts that scatter."""
        vehicle, state, token = self._session.vehicle, self._state, self._token
        speed = state.conditions.speed
        search = prepare_search(vehicle, self.look.problem, state.rates, speed, state.locked)
        robustly = robust_search(search, Tolerance()) if self._plan.is_robust else None
        self._begin(search)
        starts = start_points(search, self.look.before, self._plan.n_starts, token=token)
        optimum = optimise(search, starts, token=token, tell=self._note)
        if robustly is None or token.is_cancelled:
            return optimum
        try:
            self._begin(robustly, is_robust=True, progress=None, history=())
        except CancelledError:
            return optimum
        return optimise_robustly(robustly, optimum, token=token, tell=self._note)

    def _begin(self, search: Search, **news) -> None:
        """Says what its goal is with the rates compared with; raises CancelledError if it is over."""
        reference = self.look.problem.reference
        rates = self._session.vehicle.rate_sets[reference] if reference else None
        compared = np.nan if rates is None else search.goal.value(rates)
        original = search.goal.value({})
        self._token.check()
        outside = compared_outside(self.look.problem, search)
        self._put(phase="searching", original=original, reference=compared, outside=outside, **news)

    def _note(self, progress: Progress) -> None:
        """Takes down an evaluation, and now and then tells and brings the session after it."""
        history = self.look.history
        if not history or progress.value < history[-1][1]:
            history = (*history, (progress.evaluations, progress.value))
        with self._lock:
            self.look = replace(self.look, progress=progress, history=history)
        if progress.is_checking:
            self._follow()
            self._turn("checking", "searching", "paused")
        elif time.monotonic() - self._told > TELL_EVERY:
            self._follow()
            self._changed()
            self._told = time.monotonic()

    def _end(self, optimum: Optimum) -> None:
        self._follow()
        self._put(phase="ended", optimum=optimum)

    def _fail(self, failure: str) -> None:
        """Says why there is no result; the session goes back to the rates before."""
        if self._token.is_cancelled:
            self._put(phase="ended")
            return
        self._go_to(self.look.before)
        self._put(phase="failed", failure=failure)

    def _follow(self) -> None:
        """Brings the session to the best design so far."""
        if self.look.progress is not None:
            self._go_to(self.look.progress.rates)

    def _go_to(self, rates: Rates) -> None:
        def followed(state: State) -> State:
            if state.rates != self._followed:
                return state
            self._followed = rates
            return replace(state, rates=rates)

        self.change(followed)

    def _turn(self, phase: Phase, *before: Phase) -> bool:
        """Goes on to a phase from one of some others; whether it still was in one of them."""
        with self._lock:
            if self.look.phase not in before:
                return False
            self.look = replace(self.look, phase=phase)
        self._changed()
        return True

    def _put(self, **news) -> None:
        with self._lock:
            self.look = replace(self.look, **news)
        self._changed()


class Optimiser:
    """The searches of a session, one at a time."""

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], None]
    ) -> None:
        """Starts nothing; arguments as of `SearchTask`."""
        self._session, self._changed, self._report = session, changed, report
        self._lock = threading.Lock()
        self._pursuit: SearchTask | None = None

    @property
    def look(self) -> SearchStatus | None:
        """The newest search; None before the first."""
        return None if self._pursuit is None else self._pursuit.look

    def start(self) -> None:
        """Begins a search from the present rates.

        Raises:
            ModevizError: one is running, or as `SearchTask`.
        """
        with self._lock:
            if self.look is not None and self.look.is_running:
                raise ModevizError("a search is running: cancel it first")
            self._pursuit = SearchTask(self._session, self._changed, self._report)
        self._changed()

    def pause(self) -> None:
        """Holds the search that is running."""
        if self._pursuit:
            self._pursuit.pause()

    def resume(self) -> None:
        """Lets it go on."""
        if self._pursuit:
            self._pursuit.resume()

    def cancel(self) -> None:
        """Ends it; the best design so far is kept."""
        if self._pursuit:
            self._pursuit.cancel()

    def accept(self) -> None:
        """Takes over the design that was found, and pins it as the first free of "Optimised 1" ..."""
        if (pursuit := self._pursuit) is None or (optimum := pursuit.look.optimum) is None:
            return

        def accepted(state: State) -> State:
            taken = rate_sets(self._session.vehicle, state)
            name = next(n for n in (f"Optimised {i}" for i in count(1)) if n not in taken)
            return replace(state.with_variant(name, optimum.rates), rates=dict(optimum.rates))

        pursuit.change(accepted)

    def go_back(self) -> None:
        """Takes over the rates before the search again."""
        if look := self.look:
            self._session.change(rates=dict(look.before))

    def close(self) -> None:
        """Ends the search that is running, and waits for it."""
        if self._pursuit:
            self._pursuit.cancel()
            self._pursuit.join()
