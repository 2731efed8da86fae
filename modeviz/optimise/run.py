"""Better mount rates for a problem: many starts or a global search, and why it ended."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from modeviz.compute.cancel import CancelToken
from modeviz.compute.threads import one_thread
from modeviz.errors import SolveError
from modeviz.optimise.active_limits import ActiveConstraint, active_constraints
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET, Descent, Step
from modeviz.optimise.evolution import evolve
from modeviz.optimise.search import Search
from modeviz.optimise.verification import Verification, verify
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates

BUDGET = 5_000
"""Evaluations that a search may take, all starts together, besides those that choose these."""

LEFT = "a mode leaves its window in the full model"
"""Why an optimum is none, whatever the search said."""

FIRST = 2
"""So many starts are looked at even if the search is cancelled: the present rates, and the best of the
spread designs."""

EVOLVING = 0.8
"""The part of them that a global search has before its best design is improved."""


@dataclass(frozen=True)
class Progress:
    """Where an optimisation is."""

    evaluations: int
    rates: Rates
    """Of every group: the best design so far."""
    value: float
    """Of that."""
    start: int
    """The number of the start that is searched from, from one; of a global search the part, of two."""
    n_starts: int
    is_checking: bool = False
    """Whether the search is over and its best design now held against the full model."""


@dataclass(frozen=True, eq=False)
class Optimum:
    """The best design that was found, and how the search ended."""

    x: Floats
    rates: Rates
    """Of every group."""
    value: float
    """Of the goal."""
    reason: str
    """Why it ended: "converged", "cancelled", "out of budget", or the solver's own word."""
    evaluations: int
    """By all searches, besides those that chose where to start."""
    active: tuple[ActiveConstraint, ...]
    verification: Verification
    """What the full model says of it."""
    descents: tuple[Descent, ...]
    """The end of the search from each start that was come to."""

    @property
    def converged(self) -> bool:
        """Whether the search that found it came to its end, and none was cut short."""
        return self.reason == CONVERGED


def optimise(
    search: Search,
    starts: Sequence[Floats],
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The best of the designs down from each start.

    Args:
        search: what is sought.
        starts: (n_variables,) each, see `start_points`.
        budget: the most evaluations, all starts together.
        token: lets somebody hold or end it; the best design so far is kept.
        tell: told every evaluation, once there is a feasible design, and before the full model is
            solved.

    Raises:
        SolveError: a design that cannot be solved, or none that keeps a mode where it has to be.
    """
    descents: list[Descent] = []
    for i, start in enumerate(starts, 1):
        used = sum(d.evaluations for d in descents)
        is_cancelled = i > FIRST and CANCELLED in (d.reason for d in descents)
        if used >= budget or is_cancelled:
            break
        teller = _teller(search, descents, used, i, len(starts), tell)
        descents.append(descend(search, start, budget - used, token, teller))
    return best_of(search, descents, why_ended(descents, len(starts)), len(starts), tell)


def search_globally(
    search: Search,
    seed: int = 0,
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The best design of an evolution, and down from there.

    Args:
        search: what is sought.
        seed: of the evolution; the same finds the same.
        budget: the most evaluations.
        token: lets somebody hold or end it; the best design so far is kept.
        tell: as of `optimise`.

    Raises:
        SolveError: as `optimise`.
    """
    teller = _teller(search, [], 0, 1, 2, tell)
    evolved = evolve(search, seed, max(1, int(EVOLVING * budget)), token, teller)
    rest = budget - evolved.evaluations
    if evolved.x is None or evolved.reason == CANCELLED or not rest:
        return best_of(search, [evolved], evolved.reason, 2, tell)
    teller = _teller(search, [evolved], evolved.evaluations, 2, 2, tell)
    descent = descend(search, evolved.x, rest, token, teller)
    return best_of(search, [evolved, descent], descent.reason, 2, tell)


def why_ended(descents: Sequence[Descent], n_starts: int) -> str:
    """Why searches from so many starts ended, of which the last may not have been come to."""
    reasons = [descent.reason for descent in descents]
    if CANCELLED in reasons:
        return CANCELLED
    if OUT_OF_BUDGET in reasons or len(descents) < n_starts:
        return OUT_OF_BUDGET
    return min(descents, key=lambda d: d.value).reason


@one_thread
def best_of(
    search: Search,
    descents: Sequence[Descent],
    reason: str,
    n_starts: int,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The optimum of several searches, held against the full model.

    Args:
        search: what was sought.
        descents: the end of each search.
        reason: why there are no more of them, see `why_ended`.
        n_starts: how many of them there might have been.
        tell: told before the full model is solved, which may take seconds.

    Raises:
        SolveError: as `optimise`.
    """
    best = min(descents, key=lambda d: d.value)
    if best.x is None:
        windows = "; ".join(search.windows.spoken) if search.windows else ""
        kept = f"no design was found that keeps the frequency windows ({windows})"
        if reason == CANCELLED:
            raise SolveError(f"cancelled: {kept}")
        raise SolveError(f"{kept}: widen them, free more rates or take more starts")
    rates = search.space.rates(best.x)
    n_evaluations = sum(d.evaluations for d in descents)
    tell(Progress(n_evaluations, rates, best.value, len(descents), n_starts, is_checking=True))
    verification = verify(search, best.x, best.value)
    return Optimum(
        x=best.x,
        rates=rates,
        value=best.value,
        reason=reason if verification.are_kept else LEFT,
        evaluations=n_evaluations,
        active=active_constraints(search, best.x),
        verification=verification,
        descents=tuple(descents),
    )


def _teller(
    search: Search,
    before: Sequence[Descent],
    used: int,
    number: int,
    n_starts: int,
    tell: Callable[[Progress], None],
) -> Callable[[Step], None]:
    """What tells the best so far, of this search and those before."""
    best = min(before, key=lambda d: d.value, default=None)

    def told(step: Step) -> None:
        x, value = step.x, step.value
        if best is not None and best.value <= value:
            x, value = best.x, best.value
        if x is not None:
            rates = search.space.rates(x)
            tell(Progress(used + step.evaluations, rates, value, number, n_starts))

    return told
