"""The searches of a study: from many starts, or everywhere at once, and then for parts that scatter."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.compute.cancel import CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.files.problem_file import ENDING, read_problem
from modeviz.optimise.multistart import optimise_on
from modeviz.optimise.pareto import Front, FrontProgress, find_front
from modeviz.optimise.run import Optimum, Progress, optimise, search_globally
from modeviz.optimise.search import Search
from modeviz.optimise.starts import start_points
from modeviz.optimise.trade_off import TradeOff
from modeviz.scatter.robust import optimise_robustly, robust_search
from modeviz.scatter.tolerance import Tolerance
from modeviz.study.telling import Tell
from modeviz.text.wording import significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class SearchOptions:
    """How a search goes."""

    starts: int
    """Of these the first is the present rates."""
    seed: int
    """Of the random designs that starts are chosen from."""
    budget: int
    """The most evaluations, besides those that choose where to start."""
    everywhere: bool
    """Whether to search everywhere at once instead of from starts."""
    tolerance: Tolerance | None
    """Of the parts over which the 95th percentile is then made small; None: parts are as drawn."""
    scheduler: str | None
    """Address of the dask cluster where searches are computed; None: here."""


@dataclass
class Follower:
    """Follows a search: keeps how the best objective fell, and tells how far the search is."""

    tell: Tell
    token: CancelToken
    history: list[tuple[int, float]] = field(default_factory=list)
    """After how many evaluations a better design was found, and its objective."""

    def __call__(self, where: Progress) -> None:
        """Keeps and tells where a search is."""
        if not self.history or where.value < self.history[-1][1]:
            self.history.append((where.evaluations, where.value))
        if self.token.is_cancelled:
            return
        if where.is_checking:
            self.tell("checking with the full model", 1.0)
            return
        what = f"search {where.start} of {where.n_starts}, objective {significant(where.value)}"
        self.tell(what, (where.start - 1) / where.n_starts)

    @property
    def steps(self) -> Floats:
        """(n, 2): the history as an array."""
        return np.array(self.history, np.float64).reshape(-1, 2)


def chosen_problem(vehicle: Vehicle, problem: "str | Path | Problem | None") -> Problem:
    """Return a problem of the vehicle or of a file by its name, or the vehicle's usual one.

    Args:
        vehicle: that has it.
        problem: itself, its name, or that of a .toml file; None: the usual one.

    Raises:
        VehicleError: there is none of that name, or not in that file, or nothing to make one of.
    """
    if problem is None:
        return problems(vehicle)[0]
    if isinstance(problem, Problem):
        vehicle.check_problem(problem)
        return problem
    path = Path(problem)
    return read_problem(path, vehicle) if path.suffix == ENDING else vehicle.problem(str(problem))


def find_best(
    search: Search, rates: Rates, options: SearchOptions, token: CancelToken, follower: Follower
) -> tuple[Search, Optimum]:
    """Return the last search and the best that it found until its end, or until it is cancelled.

    Args:
        search: what is sought.
        rates: the first start, of every group.
        options: how.
        token: ends it.
        follower: told every evaluation.

    Raises:
        SolveError: as `optimise`, and where a robust search is asked for and the goal does not scatter.
    """
    robustly = robust_search(search, options.tolerance) if options.tolerance else None
    found = _find_as_drawn(search, rates, options, token, follower)
    if robustly is None or token.is_cancelled:
        return search, found
    follower.history.clear()
    return robustly, optimise_robustly(robustly, found, options.budget, token, follower)


def _find_as_drawn(
    search: Search, rates: Rates, options: SearchOptions, token: CancelToken, follower: Follower
) -> Optimum:
    if options.everywhere:
        return search_globally(search, options.seed, options.budget, token, follower)
    follower.tell("choosing where to start", 0.0)
    starts = start_points(search, rates, options.starts, options.seed, token)
    if options.scheduler is None:
        return optimise(search, starts, options.budget, token, follower)
    with runner_at(options.scheduler) as runner:
        return optimise_on(runner, search, starts, options.budget, token, follower)


def find_designs(
    trade_off: TradeOff, rates: Rates, options: SearchOptions, token: CancelToken, tell: Tell
) -> Front:
    """Return designs between two goals, or those that were found until it is cancelled.

    Args:
        trade_off: both goals.
        rates: to begin with, of every group.
        options: how.
        token: ends it.
        tell: told how far it is.

    Raises:
        SolveError: a design that cannot be solved.
    """

    def follow(where: FrontProgress) -> None:
        if not token.is_cancelled:
            tell(f"searching, {len(where.designs)} designs on the front", where.done)

    return find_front(
        trade_off,
        [rates],
        n_starts=options.starts,
        seed=options.seed,
        budget=options.budget,
        control=token,
        tell=follow,
    )
