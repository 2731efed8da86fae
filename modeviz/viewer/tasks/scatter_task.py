"""What mounts that scatter do to the present rates: computed beside, drawn as bands."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from modeviz.analysis.results import AXIS, Conditions
from modeviz.compute.cancel import CancelToken
from modeviz.scatter.driving import Scattered, ScatterOptions, drive_many
from modeviz.scatter.monte_carlo import Scatter
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import UNFELT, Problem
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ChartCurve, ResponseCurve, State
from modeviz.viewer.tasks.background_task import BackgroundTask, Job, Tell

PERCENT = (5.0, 95.0)
"""Between these percentiles a band is drawn."""


@dataclass(frozen=True, eq=False)
class Build:
    """Vehicles that are built with some rates."""

    rates: Rates
    conditions: Conditions
    problem: Problem
    """Whose goal is looked at."""
    options: ScatterOptions

    def is_of(self, state: State) -> bool:
        """Return whether they have the rates of a state, on its road at its speed."""
        return self.rates == state.design.rates and self.conditions == state.conditions


@dataclass(frozen=True, eq=False)
class ScatterOutcome:
    """The responses of these vehicles."""

    told: Scattered

    @property
    def scatter(self) -> Scatter:
        return self.told.scatter

    @cached_property
    def percentiles(self) -> Floats:
        """The band of the PSDs, (2, n_freqs, n_points, 3), g²/Hz."""
        return self.scatter.psd_percentiles(PERCENT)


class ScatterTask:
    """Scatters the mounts of a session's present rates."""

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], str]
    ) -> None:
        """Starts nothing.

        Args:
            session: whose rates, road and speed.
            changed: told that there is something new to look at.
            report: told what is our mistake; gives the number under which it is logged.
        """
        self._session, self._changed = session, changed
        self._task = BackgroundTask[Job[Build, ScatterOutcome]](
            "scatter", self._scatter, self._tell, report
        )

    @property
    def job(self) -> Job[Build, ScatterOutcome] | None:
        """The newest scatter; None before the first."""
        return self._task.job

    def watch(self, watcher: Callable[[Job[Build, ScatterOutcome]], None]) -> None:
        """Has somebody else given every job when there is something new."""
        self._task.watch(watcher)

    def start(self, n_samples: int) -> None:
        """Begins with so many vehicles.

        Raises:
            ModevizError: another one is running, or the state's plan asks for what cannot be.
        """
        state = self._session.state
        assert state.design.plan is not None
        problem = planned(self._session.vehicle, state.design.plan)
        if problem.goal in UNFELT:  # which no part scatters
            problem = replace(problem, goal="accelerations")
        points = tuple(point.name for point in self._session.vehicle.response_points)
        options = ScatterOptions(n_samples, Tolerance(), points=points)
        self._task.start(Job(Build(state.design.rates, state.conditions, problem, options)))

    def cancel(self) -> None:
        """Ends what is running; nothing of it is kept."""
        self._task.cancel()

    def band(self, state: State, curve: ChartCurve) -> Floats | None:
        """Return between what a curve scatters, (2, n_freqs), g²/Hz, if that is known for a state."""
        shaded = self.shaded(state, curve)
        return None if shaded is None else shaded[1]

    def shaded(self, state: State, curve: ChartCurve) -> tuple[Floats, Floats] | None:
        """Return the frequencies of that band, (n_freqs,), and the band."""
        job = self.job
        if job is None or job.found is None or state.charts.load or not job.asked.is_of(state):
            return None
        if not isinstance(curve, ResponseCurve):
            return None
        axis = AXIS[curve.direction]
        return job.found.scatter.frequency_hz, job.found.percentiles[:, :, curve.point, axis]

    def _scatter(
        self, job: Job[Build, ScatterOutcome], token: CancelToken, tell: Tell
    ) -> ScatterOutcome:
        build, session = job.asked, self._session
        told = drive_many(
            session.vehicle,
            lambda: session.prepared,
            build.rates,
            build.conditions,
            build.problem,
            build.options,
            token,
            lambda done: tell(done=done),
            at_least=0,
        )
        return ScatterOutcome(told)

    def _tell(self) -> None:
        """Has the charts drawn again once there is a band."""
        self._changed()
        if self.job and self.job.found:
            self._session.draw_again()
