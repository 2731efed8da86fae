"""What mounts that scatter do to the present rates: computed beside, drawn as bands."""

import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.errors import ModevizError
from modeviz.tuning.control import CancelledError, Control
from modeviz.tuning.goals import prepare_goal
from modeviz.tuning.objective import Objective
from modeviz.tuning.parts import Tolerance, scattered_parts
from modeviz.tuning.results import AXIS, Conditions
from modeviz.tuning.scatter import Scatter, scatter
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Goal, Problem
from modeviz.viewer.plan import planned
from modeviz.viewer.session import Session
from modeviz.viewer.state import Curve, State

PERCENT = (5.0, 95.0)
"""Between these percentiles a band is drawn."""

NOT_SUMS: tuple[Goal, ...] = ("peak", "change")
"""Goals that no part scatters, or that are no sum; the accelerations are looked at in their place."""

TELL_EVERY = 0.25
"""s between two words on how far it is."""


@dataclass(frozen=True, eq=False)
class Scattered:
    """A scatter of the mounts at some rates, done or on its way."""

    rates: Rates
    conditions: Conditions
    problem: Problem
    """Whose goal is looked at."""
    done: float = 0.0
    """The fraction that is done."""
    result: Scatter | None = None
    failure: str = ""
    is_cancelled: bool = False

    @property
    def is_running(self) -> bool:
        return self.result is None and not self.failure and not self.is_cancelled

    def is_of(self, state: State) -> bool:
        """Whether it is of the rates, the road and the speed of a state."""
        return self.rates == state.rates and self.conditions == state.conditions

    @cached_property
    def percentiles(self) -> Floats | None:
        """Of the PSDs, (2, n_freqs, n_points, 3), g²/Hz."""
        return None if self.result is None else self.result.psd_percentiles(PERCENT)


class Scatterer:
    """Scatters the mounts of a session's present rates, in a thread of its own."""

    def __init__(self, session: Session, changed: Callable[[], None]) -> None:
        """Starts nothing.

        Args:
            session: whose rates, road and speed.
            changed: told that there is something new to look at.
        """
        self._session, self._changed = session, changed
        self._lock = threading.Lock()
        self._control = Control()
        self._told = 0.0
        self.look: Scattered | None = None
        """The newest scatter; None before the first."""

    def start(self, n_samples: int) -> None:
        """Begins with so many vehicles.

        Raises:
            ModevizError: another one is running, or the state's plan asks for what cannot be.
        """
        with self._lock:
            if self.look and self.look.is_running:
                raise ModevizError("a scatter is running: cancel it first")
            state = self._session.state
            assert state.plan is not None
            problem = planned(self._session.vehicle, state.plan)
            if problem.goal in NOT_SUMS:
                problem = replace(problem, goal="accelerations")
            self.look = Scattered(state.rates, state.conditions, problem)
            self._control = Control()
        arguments = problem, state, n_samples, self._control
        threading.Thread(target=self._run, args=arguments, name="scatter", daemon=True).start()
        self._changed()

    def cancel(self) -> None:
        """Ends what is running, at once; nothing of it is kept."""
        self._control.cancel()
        if self.look and self.look.is_running:
            self._put(self._control, is_cancelled=True)

    def band(self, state: State, curve: Curve) -> Floats | None:
        """Between what a curve scatters, (2, n_freqs), g²/Hz, if that is known for a state."""
        look = self.look
        if look is None or look.percentiles is None or state.load or not look.is_of(state):
            return None
        return look.percentiles[:, :, curve.point, AXIS[curve.direction]]

    def _run(self, problem: Problem, state: State, n_samples: int, control: Control) -> None:
        try:
            found = self._scatter(problem, state, n_samples, control)
            self._put(control, result=found, done=1.0)
        except CancelledError:
            return
        except ModevizError as error:
            self._put(control, failure=str(error))
        except Exception as error:
            traceback.print_exception(error)
            self._put(control, failure="This is our mistake: the terminal says more.")
        else:
            self._session.show_again()

    def _scatter(self, problem: Problem, state: State, n_samples: int, control: Control) -> Scatter:
        vehicle, prepared = self._session.vehicle, self._session.prepared
        goal = prepare_goal(vehicle, problem, state.rates, state.conditions.speed)
        assert isinstance(goal, Objective)
        control.check()
        return scatter(
            prepared,
            scattered_parts(prepared, state.rates, Tolerance()),
            state.conditions,
            goal,
            n_samples,
            points=[point.name for point in vehicle.response_points],
            control=control,
            tell=lambda done: self._tell(control, done),
        )

    def _tell(self, control: Control, done: float) -> None:
        if time.monotonic() - self._told > TELL_EVERY:
            self._told = time.monotonic()
            self._put(control, done=done)

    def _put(self, control: Control, **news) -> None:
        """Keeps news of the newest scatter; those of one that was cancelled are nobody's."""
        with self._lock:
            if control is not self._control or (self.look and self.look.is_cancelled):
                return
            assert self.look is not None
            self.look = replace(self.look, **news)
        self._changed()


def between(values: Floats) -> tuple[float, float]:
    """Its two percentiles of `PERCENT`."""
    low, high = np.percentile(values, PERCENT)
    return float(low), float(high)
