"""What mounts that scatter do to the present rates: computed beside, drawn as bands."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from modeviz.analysis.results import AXIS, Conditions
from modeviz.compute.cancel import CancelToken
from modeviz.optimise.goals import ResponseGoal, prepare_goal
from modeviz.scatter.monte_carlo import Scatter, scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ResponseCurve, State
from modeviz.viewer.tasks.background_task import BackgroundTask, Job, Progress

PERCENT = (5.0, 95.0)
"""Between these percentiles a band is drawn."""


@dataclass(frozen=True, eq=False)
class Build:
    """Vehicles that are built with some rates."""

    rates: Rates
    conditions: Conditions
    problem: Problem
    """Whose goal is looked at."""
    n_samples: int

    def is_of(self, state: State) -> bool:
        """Whether they have the rates of a state, on its road at its speed."""
        return self.rates == state.rates and self.conditions == state.conditions


@dataclass(frozen=True, eq=False)
class ScatterOutcome:
    """What these vehicles do."""

    scatter: Scatter

    @cached_property
    def percentiles(self) -> Floats:
        """Of the PSDs, (2, n_freqs, n_points, 3), g²/Hz."""
        return self.scatter.psd_percentiles(PERCENT)


class ScatterTask:
    """Scatters the mounts of a session's present rates."""

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], None]
    ) -> None:
        """Starts nothing.

        Args:
            session: whose rates, road and speed.
            changed: told that there is something new to look at.
            report: told what is our mistake.
        """
        self._session, self._changed = session, changed
        self._beside = BackgroundTask[Build, ScatterOutcome](
            "scatter", self._scatter, self._tell, report
        )

    @property
    def job(self) -> Job[Build, ScatterOutcome] | None:
        """The newest scatter; None before the first."""
        return self._beside.job

    def start(self, n_samples: int) -> None:
        """Begins with so many vehicles.

        Raises:
            ModevizError: another one is running, or the state's plan asks for what cannot be.
        """
        state = self._session.state
        assert state.plan is not None
        problem = planned(self._session.vehicle, state.plan)
        if problem.goal == "change":  # which no part scatters
            problem = replace(problem, goal="accelerations")
        self._beside.start(Build(state.rates, state.conditions, problem, n_samples))

    def cancel(self) -> None:
        """Ends what is running; nothing of it is kept."""
        self._beside.cancel()

    def band(self, state: State, curve: ResponseCurve) -> Floats | None:
        """Between what a curve scatters, (2, n_freqs), g²/Hz, if that is known for a state."""
        shaded = self.shaded(state, curve)
        return None if shaded is None else shaded[1]

    def shaded(self, state: State, curve: ResponseCurve) -> tuple[Floats, Floats] | None:
        """That with its frequencies, (n_freqs,)."""
        job = self.job
        if job is None or job.found is None or state.load or not job.asked.is_of(state):
            return None
        axis = AXIS[curve.direction]
        return job.found.scatter.frequency_hz, job.found.percentiles[:, :, curve.point, axis]

    def _scatter(
        self, build: Build, token: CancelToken, tell: Progress[ScatterOutcome]
    ) -> ScatterOutcome:
        vehicle, prepared = self._session.vehicle, self._session.prepared
        goal = prepare_goal(vehicle, build.problem, build.rates, build.conditions.speed)
        assert isinstance(goal, ResponseGoal)
        token.check()
        found = scatter(
            prepared,
            scattered_parts(prepared, build.rates, Tolerance()),
            build.conditions,
            goal,
            build.n_samples,
            points=[point.name for point in vehicle.response_points],
            token=token,
            tell=tell,
        )
        token.check()
        return ScatterOutcome(found)

    def _tell(self) -> None:
        """Has the charts drawn again once there is a band."""
        self._changed()
        if self.job and self.job.found:
            self._session.show_again()
