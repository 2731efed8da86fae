"""Searches from many starts side by side, on other machines too."""

from collections.abc import Callable, Sequence

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.runner import Runner
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, Descent
from modeviz.optimise.run import BUDGET, FIRST, Optimum, Progress, best_of, why_ended
from modeviz.optimise.search import Search
from modeviz.vehicle.arrays import Floats


def optimise_on(
    runner: Runner,
    search: Search,
    starts: Sequence[Floats],
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The same as `optimise` finds while no search runs out of its budget.

    Args:
        runner: where searches are computed, each from its start.
        search: what is sought.
        starts: (n_variables,) each, see `start_points`.
        budget: the most evaluations; every search may take an equal part of them.
        token: lets somebody end it; the best design of the searches that have ended is kept.
        tell: told at the end of every search, once there is a feasible design, and as by `optimise`.

    Raises:
        SolveError: as `optimise`.
    """
    descents: list[Descent] = []
    shared = search, max(1, budget // len(starts))
    try:
        for descent in runner.map(_descend, shared, starts, token or CancelToken()):
            descents.append(descent)
            best = min(descents, key=lambda d: d.value)
            if best.x is not None:
                used = sum(d.evaluations for d in descents)
                rates = search.space.rates(best.x)
                tell(Progress(used, rates, best.value, len(descents), len(starts)))
    except CancelledError:
        descents += [descend(search, start, 1, token) for start in starts[:FIRST]]
        return best_of(search, descents, CANCELLED, len(starts), tell)
    return best_of(search, descents, why_ended(descents, len(starts)), len(starts), tell)


def _descend(shared: tuple[Search, int], start: Floats) -> Descent:
    search, budget = shared
    return descend(search, start, budget)
