"""What mounts that scatter do to the present rates: computed beside, drawn as bands."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from modeviz.analysis.results import AXIS, Conditions
from modeviz.compute.cancel import CancelToken
from modeviz.report.records import Record
from modeviz.report.scatter import scatter_record
from modeviz.scatter.driving import Scattered, ScatterOptions, drive_many
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

LOW, HIGH = (f"p{percent:g}" for percent in PERCENT)
"""What records call them."""


@dataclass(frozen=True, eq=False)
class Built:
    """Vehicles that were built with some rates."""

    rates: Rates
    conditions: Conditions

    def is_of(self, state: State) -> bool:
        """Return whether they have the rates of a state, on its road at its speed."""
        return self.rates == state.design.rates and self.conditions == state.conditions


@dataclass(frozen=True, eq=False)
class Build(Built):
    """Vehicles that are built with some rates, and what is looked at."""

    problem: Problem
    """Whose goal is looked at."""
    options: ScatterOptions


@dataclass(frozen=True, eq=False)
class ScatterOutcome:
    """The responses of these vehicles."""

    record: Record
    """Of their quantities, see `scatter_record`."""
    frequency_hz: Floats
    """(n_freqs,)."""
    points: tuple[str, ...]
    """Names of response points."""
    percentiles: Floats
    """The band of the PSDs, (2, n_freqs, n_points, 3), g²/Hz."""


def outcome(told: Scattered) -> ScatterOutcome:
    """Return what is kept of a scatter: not every vehicle's spectrum."""
    found = told.scatter
    percentiles = found.psd_percentiles(PERCENT)
    return ScatterOutcome(scatter_record(told), found.frequency_hz, found.points, percentiles)


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
        self._task = BackgroundTask[Job[Built, ScatterOutcome]](
            "scatter", self._scatter, self._tell, report
        )

    @property
    def job(self) -> Job[Built, ScatterOutcome] | None:
        """The newest scatter, or one of before that is shown; None before the first."""
        return self._task.job

    def watch(self, watcher: Callable[[Job[Built, ScatterOutcome]], None]) -> None:
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

    def show(self, job: Job[Built, ScatterOutcome]) -> None:
        """Shows what was found before; raises ModevizError while it is scattered."""
        self._task.show(job)

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
        point, found = self._session.vehicle.response_points[curve.point].name, job.found
        if point not in found.points:
            return None
        band = found.percentiles[:, :, found.points.index(point), AXIS[curve.direction]]
        return found.frequency_hz, band

    def _scatter(
        self, job: Job[Built, ScatterOutcome], token: CancelToken, tell: Tell
    ) -> ScatterOutcome:
        build, session = job.asked, self._session
        assert isinstance(build, Build)
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
        return outcome(told)

    def _tell(self) -> None:
        """Has the charts drawn again once there is a band."""
        self._changed()
        if self.job and self.job.found:
            self._session.draw_again()
