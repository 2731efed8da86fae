"""The front of a trade-off in a tuning session, found beside it."""

from collections.abc import Callable
from dataclasses import dataclass

from modeviz.compute.cancel import CancelToken
from modeviz.optimise.pareto import FrontProgress, find_front
from modeviz.optimise.trade_off import ParetoPoint, Side, chosen_sides, prepare_trade_off, sides
from modeviz.vehicle.alterations import altered
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.viewer.session.commands.decisions import TakeDesign
from modeviz.viewer.session.design import rate_sets
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State
from modeviz.viewer.tasks.background_task import BackgroundTask, Job, Tell

N_STARTS = 3
"""For each design, besides those found before: a front is to be there while one waits."""

Designs = tuple[ParetoPoint, ...]
"""Of a front, the best in the first goal first."""


@dataclass(frozen=True, eq=False)
class Goals:
    """Two goals that were traded."""

    names: tuple[str, str]


@dataclass(frozen=True, eq=False)
class Trade(Goals):
    """Two goals to trade, and from where."""

    problem: Problem
    sides: tuple[Side, Side]
    state: State
    known: tuple[Rates, ...]
    """Designs that are known already."""


class FrontTask:
    """Finds the front between two sides of a session's problem."""

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], str]
    ) -> None:
        """Starts nothing.

        Args:
            session: whose plan, rates and speed.
            changed: told that there is something new to look at.
            report: told what is our mistake; gives the number under which it is logged.
        """
        self._session = session
        self._task = BackgroundTask[Job[Goals, Designs]](
            "search for a front", self._find, changed, report
        )

    @property
    def job(self) -> Job[Goals, Designs] | None:
        """The newest search, or one of before that is shown; None before the first."""
        return self._task.job

    def watch(self, watcher: Callable[[Job[Goals, Designs]], None]) -> None:
        """Has somebody else given every job when there is something new."""
        self._task.watch(watcher)

    def offers(self) -> tuple[str, ...]:
        """Return what can be traded, as in "lateral against vertical".

        Raises:
            VehicleError: the plan asks for what cannot be.
        """
        return tuple(sides(self._session.vehicle, self._problem(self._session.state)))

    def start(self, name: str) -> None:
        """Begins with one of `offers`.

        Raises:
            ModevizError: another one is running, the plan asks for what cannot be, or no longer
                offers that.
        """
        state, vehicle = self._session.state, self._session.vehicle
        problem = self._problem(state)
        pair = chosen_sides(vehicle, problem, name)
        own, sets = state.design.rates, rate_sets(vehicle, state.design).values()
        known = (own, *({g: rates.get(g, own[g]) for g in own} for rates in sets))
        names = pair[0].name, pair[1].name
        self._task.start(Job(Trade(names, problem, pair, state, known)))

    def show(self, job: Job[Goals, Designs]) -> None:
        """Shows a front that was found before; raises ModevizError while one is searched."""
        self._task.show(job)

    def cancel(self) -> None:
        """Ends what is running; the designs found by then are kept."""
        self._task.cancel()

    def load(self, design: ParetoPoint) -> None:
        """Takes over a design of a front."""
        self._session.do(TakeDesign(design.rates, design.placements))

    def _problem(self, state: State) -> Problem:
        assert state.design.plan is not None
        return planned(self._session.vehicle, state.design.plan)

    def _find(self, job: Job[Goals, Designs], token: CancelToken, tell: Tell) -> Designs:
        trade = job.asked
        assert isinstance(trade, Trade)
        state = trade.state
        alterations = state.design.alterations
        trade_off = prepare_trade_off(
            altered(self._session.original, alterations.placed({})),
            trade.problem,
            trade.sides,
            state.design.rates,
            state.conditions.speed,
            state.design.locked,
            alterations.placements,
        )
        token.check()

        def told(progress: FrontProgress) -> None:
            token.check()
            tell(at_once=True, done=progress.done, found=progress.designs or None)

        known = trade.known
        front = find_front(trade_off, known, n_starts=N_STARTS, token=token, tell=told)
        return front.designs
