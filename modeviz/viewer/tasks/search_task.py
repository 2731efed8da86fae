"""A search for better rates in a tuning session: what it tells, and what comes of it."""

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import count

import numpy as np

from modeviz.compute.cancel import CancelToken
from modeviz.optimise.run import History, Optimum, Progress
from modeviz.optimise.search import Search, prepare_search
from modeviz.report.optimum import compared_outside
from modeviz.scatter.searching import SearchOptions, find_best
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.alterations import Alterations, altered
from modeviz.vehicle.decoupling import USUAL, Decoupling
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.commands.decisions import TakeDesign
from modeviz.viewer.session.design import rate_sets
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State
from modeviz.viewer.tasks.background_task import BackgroundTask, Job, Tell


@dataclass(frozen=True, eq=False)
class Sought:
    """The problem that a search is to solve, and its start."""

    problem: Problem
    before: Rates
    """The rates that it begins with."""
    speed: float
    """On the roads, m/s."""
    locked: frozenset[tuple[str, str]]
    """Rates, (group, field of `MountRates`), that may not change."""
    options: SearchOptions
    decoupling: Decoupling = USUAL
    """What modes of bodies on their mounts are held against."""
    alterations: Alterations = field(default_factory=Alterations)
    """With which it begins; where mounts are that no problem moves they stay."""


@dataclass(frozen=True, eq=False)
class SearchStatus(Job[Sought, Optimum]):
    """The state of a search at some moment."""

    has_begun: bool = False
    """Whether it is prepared."""
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

    @property
    def stage(self) -> str:
        """The step it is at while it runs: "preparing", "searching" or "checking"; else its phase."""
        if self.phase == "ending":
            return "checking"
        if self.phase != "running":
            return self.phase
        if self.progress is not None and self.progress.is_checking:
            return "checking"
        return "searching" if self.has_begun else "preparing"

    @property
    def is_awaited(self) -> bool:
        """Whether there is a best design to end with."""
        return self.has_begun

    @property
    def problem(self) -> Problem:
        return self.asked.problem

    @property
    def history(self) -> History:
        """The best goals so far, by evaluation."""
        return () if self.progress is None else self.progress.history


@dataclass(frozen=True, eq=False)
class SearchStep(Command):
    """A part of a search, which is undone as a whole."""

    sought: Sought
    rates: Rates
    """Of every group, to be taken over."""
    placements: Placements
    """Of all mounts, likewise."""

    @property
    def step(self) -> Hashable:
        return self.sought

    @property
    def within(self) -> float:
        return math.inf


@dataclass(frozen=True, eq=False)
class FollowSearch(SearchStep):
    """Take over the design that a search is at, unless somebody moved a rate or a mount meanwhile."""

    last: tuple[Rates, Placements]
    """The design that it was at before."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if design_of(state) != self.last:
            return state
        design = replace(state.design, rates=self.rates).with_placements(self.placements)
        return replace(state, design=design)


@dataclass(frozen=True, eq=False)
class AcceptOptimum(SearchStep):
    """Take over the design that was found, and pin it as the first free of "Optimised 1" ..."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        taken = rate_sets(vehicle, state.design)
        name = next(n for n in (f"Optimised {i}" for i in count(1)) if n not in taken)
        design = state.design.with_placements(self.placements).with_variant(name, self.rates)
        return replace(state, design=replace(design, rates=dict(self.rates)))


def design_of(state: State) -> tuple[Rates, Placements]:
    """Return what a search chooses of a state: its rates, and where its mounts are."""
    return state.design.rates, state.design.alterations.placements


class SearchTask:
    """Searches from a session's present rates, which follow the best design so far.

    They follow as long as nobody else changes them: no slider is taken out of anybody's hand.
    """

    def __init__(
        self, session: Session, changed: Callable[[], None], report: Callable[[Exception], str]
    ) -> None:
        """Starts nothing.

        Args:
            session: whose state says what is sought, and from where.
            changed: told that there is something new to look at.
            report: told what is our mistake; gives the number under which it is logged.
        """
        self._session, self._changed = session, changed
        self._followed: tuple[Rates, Placements] = {}, {}
        self._task = BackgroundTask[SearchStatus]("search", self._find, self._tell, report)

    @property
    def job(self) -> SearchStatus | None:
        """The newest search; None before the first."""
        return self._task.job

    def watch(self, watcher: Callable[[SearchStatus], None]) -> None:
        """Has somebody else given every job when there is something new."""
        self._task.watch(watcher)

    def start(self) -> None:
        """Begins a search from the present rates.

        Raises:
            ModevizError: another one is running, or the state's plan asks for what cannot be.
        """
        state = self._session.state
        plan = state.design.plan
        assert plan is not None
        options = SearchOptions(plan.n_starts, tolerance=Tolerance() if plan.is_robust else None)
        sought = Sought(
            planned(self._session.vehicle, plan),
            state.design.rates,
            state.conditions.speed,
            state.design.locked,
            options,
            state.design.decoupling,
            state.design.alterations,
        )
        self._task.start(SearchStatus(sought))

    def pause(self) -> None:
        """Holds the search that is running, with the session at the best design so far."""
        self._task.pause()

    def resume(self) -> None:
        """Lets it go on."""
        self._task.resume()

    def cancel(self) -> None:
        """Ends it with the session at the best design so far; while it prepares it is over at once."""
        self._task.cancel()

    def close(self) -> None:
        """Ends it, and waits for it."""
        self._task.close()

    def accept(self) -> None:
        """Takes over the design that was found, and pins it as the first free of "Optimised 1" ..."""
        if (job := self.job) and job.found:
            self._session.do(AcceptOptimum(job.asked, job.found.rates, job.found.placements))

    def go_back(self) -> None:
        """Takes over the rates and places before the search again."""
        if job := self.job:
            self._session.do(TakeDesign(job.asked.before, job.asked.alterations.placements))

    def _find(self, job: SearchStatus, token: CancelToken, tell: Tell) -> Optimum:
        """The best that is found; the session goes back to the rates before if there is none."""
        sought, placements = job.asked, job.asked.alterations.placements
        own = replace(self._session.original, decoupling=sought.decoupling)
        vehicle = altered(own, sought.alterations.placed({}))
        before = sought.before, placements
        self._followed = before

        def begin(search: Search, is_robust: bool) -> None:
            news = self._compared(sought.problem, search)
            token.check()
            tell(at_once=True, has_begun=True, is_robust=is_robust, progress=None, **news)

        def follow(progress: Progress) -> None:
            if progress.is_checking:  # nobody is to see this before the session is there
                self._go_to(sought, (progress.rates, progress.placements))
            tell(at_once=progress.is_checking, progress=progress)

        try:
            search = prepare_search(
                vehicle, sought.problem, sought.before, sought.speed, sought.locked, placements
            )
            return find_best(search, sought.before, sought.options, token, follow, begin)[1]
        except Exception:
            if not token.is_cancelled:
                self._go_to(sought, before)
            raise

    def _compared(self, problem: Problem, search: Search) -> dict[str, object]:
        """The goals of the sets that a search is compared with, and whether it could find them."""
        sets = self._session.vehicle.rate_sets
        reference = search.goal.value(sets[problem.reference]) if problem.reference else np.nan
        return {
            "original": search.goal.value({}),
            "reference": reference,
            "outside": compared_outside(problem, search),
        }

    def _tell(self) -> None:
        """Brings the session to the best design so far before somebody looks."""
        job = self.job
        if job and job.is_running and job.progress is not None:
            self._go_to(job.asked, (job.progress.rates, job.progress.placements))
        self._changed()

    def _go_to(self, sought: Sought, design: tuple[Rates, Placements]) -> None:
        """Brings the session to a design, if it still has that which the search brought it to."""
        session = self._session
        session.do(FollowSearch(sought, *design, self._followed))
        if design_of(session.state) == design:
            self._followed = design
