"""Searches from start to end: from many starts or everywhere, and then for parts that scatter."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Protocol

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.compute.runner import Runner
from modeviz.errors import ModevizError
from modeviz.optimise.run import BUDGET, Optimum, Progress, optimise, optimise_on, search_globally
from modeviz.optimise.search import Search
from modeviz.optimise.starts import MOST_STARTS, start_points
from modeviz.scatter.robust import optimise_robustly, robust_search
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.mount_rates import Rates

FRONT_STARTS = 5
"""Usual for each design of a front, besides those found before."""


@dataclass(frozen=True)
class SearchOptions:
    """How a search goes."""

    starts: int = 20
    """Of these the first is the present rates."""
    seed: int = 0
    """Of the random designs that starts are chosen from."""
    budget: int = BUDGET
    """The most evaluations, besides those that choose where to start."""
    everywhere: bool = False
    """Whether to search everywhere at once instead of from starts."""
    tolerance: Tolerance | None = None
    """Of the parts over which the 95th percentile is then made small; None: parts are as drawn."""
    scheduler: str | None = None
    """Address of the dask cluster where searches are computed; None: here."""

    def __post_init__(self) -> None:
        check_whole("starts", self.starts, 1, MOST_STARTS)
        check_whole("budget", self.budget, 1)
        check_whole("seed", self.seed, 0)


def check_whole(name: str, value: int, low: int, high: float = inf) -> None:
    """Raises ModevizError unless a number is in its range."""
    if not low <= value <= high:
        expected = f"{low} or more" if high == inf else f"{low} to {high:.0f}"
        raise ModevizError(f"{name}: found {value}, expected {expected}")


class Begin(Protocol):
    """Told that a search begins."""

    def __call__(self, search: Search, is_robust: bool) -> None:
        """Says which, and whether its goal is a percentile over parts that scatter.

        Raises:
            CancelledError: it is not to begin.
        """
        ...


def begin_quietly(search: Search, is_robust: bool) -> None:
    """Says nothing."""


def find_best(
    search: Search,
    rates: Rates,
    options: SearchOptions,
    token: CancelToken,
    tell: Callable[[Progress], None],
    begin: Begin = begin_quietly,
) -> tuple[Search, Optimum]:
    """Return the last search and the best that it found until its end, or until it is cancelled.

    Args:
        search: what is sought.
        rates: the first start, of every group.
        options: how.
        token: lets somebody hold or end it.
        tell: told every evaluation, of a robust search from one again.
        begin: told of the search, before where to start is chosen, and of the robust one after it.

    Raises:
        CancelledError: `begin` wants no search at all.
        ModevizError: nobody answers for the scheduler.
        SolveError: as `optimise`, and where a robust search is asked for and the goal does not scatter.
    """
    robustly = robust_search(search, options.tolerance) if options.tolerance else None
    begin(search, is_robust=False)
    with runner_at(options.scheduler) as runner:
        found = _find_as_drawn(search, rates, options, runner, token, tell)
    if robustly is None or token.is_cancelled:
        return search, found
    try:
        begin(robustly, is_robust=True)
    except CancelledError:
        return search, found
    return robustly, optimise_robustly(robustly, found, options.budget, token, tell)


def _find_as_drawn(
    search: Search,
    rates: Rates,
    options: SearchOptions,
    runner: Runner,
    token: CancelToken,
    tell: Callable[[Progress], None],
) -> Optimum:
    """The best for parts as drawn: everywhere, or from starts here or side by side on a cluster."""
    if options.everywhere:
        return search_globally(search, options.seed, options.budget, token, tell)
    starts = start_points(search, rates, options.starts, options.seed, token)
    if options.scheduler:
        return optimise_on(runner, search, starts, options.budget, token, tell)
    return optimise(search, starts, options.budget, token, tell)
