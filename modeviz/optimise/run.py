"""Better mount rates for a problem: many starts or a global search, and why it ended."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.runner import Runner
from modeviz.errors import SolveError
from modeviz.optimise.active_limits import ActiveConstraint, active_constraints
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET, Descent, Step
from modeviz.optimise.evolution import evolve
from modeviz.optimise.search import Search
from modeviz.optimise.verification import Verification, verify
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements

BUDGET = 5_000
"""Evaluations that a search may take, all starts together, besides those that choose these."""

LEFT = "a mode leaves its window in the full model"
"""Why an optimum is none, whatever the search said."""

FIRST = 2
"""So many starts are looked at even if the search is cancelled: the present rates, and the best of the
spread designs."""

EVOLVING = 0.8
"""The part of them that a global search has before its best design is improved."""


History = tuple[tuple[int, float], ...]
"""Every better design: after how many evaluations it was found, and its goal."""


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
    history: History = ()
    """How the best goal fell."""
    is_checking: bool = False
    """Whether the search is over and its best design now held against the full model."""
    placements: Placements = field(default_factory=dict)
    """Where the mounts of that design are, of those that are not where they were given."""


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
    history: History = ()
    """How the best goal fell; of a robust search that of its own goal."""
    placements: Placements = field(default_factory=dict)
    """Where its mounts are, of those that are not where they were given."""

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
    account = _Account(search, len(starts), tell)
    for i, start in enumerate(starts, 1):
        is_cancelled = i > FIRST and CANCELLED in (d.reason for d in account.descents)
        left = budget - account.evaluations
        if left <= 0 or is_cancelled:
            break
        account.end(descend(search, start, left, token, account.follow))
    return account.optimum()


def optimise_on(
    runner: Runner,
    search: Search,
    starts: Sequence[Floats],
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """Return what `optimise` finds while no search runs out of its budget, from searches side by side.

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
    account = _Account(search, len(starts), tell)
    shared = search, max(1, budget // len(starts))
    try:
        for descent in runner.map(_descend, shared, starts, token or CancelToken()):
            account.end(descent)
            account.tell()
    except CancelledError:
        for start in starts[:FIRST]:
            account.end(descend(search, start, 1, token))
        return account.optimum(CANCELLED)
    return account.optimum()


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
    account = _Account(search, 2, tell)
    evolved = evolve(search, seed, max(1, int(EVOLVING * budget)), token, account.follow)
    account.end(evolved)
    left = budget - evolved.evaluations
    if evolved.x is None or evolved.reason == CANCELLED or not left:
        return account.optimum(evolved.reason)
    descent = descend(search, evolved.x, left, token, account.follow)
    account.end(descent)
    return account.optimum(descent.reason)


def why_ended(descents: Sequence[Descent], n_starts: int) -> str:
    """Return why searches from so many starts ended, of which the last may not have been come to."""
    reasons = [descent.reason for descent in descents]
    if CANCELLED in reasons:
        return CANCELLED
    if OUT_OF_BUDGET in reasons or len(descents) < n_starts:
        return OUT_OF_BUDGET
    return min(descents, key=lambda d: d.value).reason


def best_of(
    search: Search,
    descents: Sequence[Descent],
    reason: str,
    n_starts: int,
    history: History = (),
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The optimum of several searches, held against the full model.

    Args:
        search: what was sought.
        descents: the end of each search.
        reason: why there are no more of them, see `why_ended`.
        n_starts: how many of them there might have been.
        history: how the best goal fell.
        tell: told before the full model is solved, which may take seconds.

    Raises:
        SolveError: as `optimise`.
    """
    best = min(descents, key=lambda d: d.value)
    if best.x is None:
        what = "frequency windows" if search.windows else "limits of deflections"
        kept = f"no design was found that keeps the {what} ({'; '.join(search.kept_words)})"
        if reason == CANCELLED:
            raise SolveError(f"cancelled: {kept}")
        raise SolveError(f"{kept}: widen them, free more rates or take more starts")
    rates, placements = search.space.rates(best.x), search.space.placements(best.x)
    n_evaluations = sum(d.evaluations for d in descents)
    tell(Progress(n_evaluations, rates, best.value, len(descents), n_starts, history, True, placements))
    verification = verify((search,), best.x, (best.value,))
    return Optimum(
        x=best.x,
        rates=rates,
        value=best.value,
        reason=reason if verification.are_kept else LEFT,
        evaluations=n_evaluations,
        active=active_constraints(search, best.x),
        verification=verification,
        descents=tuple(descents),
        history=history,
        placements=placements,
    )


class _Account:
    """Keeps what several searches for the same find, and tells of it."""

    def __init__(self, search: Search, n_starts: int, tell: Callable[[Progress], None]) -> None:
        self._search, self._n_starts, self._tell = search, n_starts, tell
        self._best: Floats | None = None
        self._history: History = ()
        self.descents: list[Descent] = []

    @property
    def evaluations(self) -> int:
        """Of the searches that have ended."""
        return sum(descent.evaluations for descent in self.descents)

    def follow(self, step: Step) -> None:
        """Keeps and tells an evaluation of the search that runs."""
        evaluations = self.evaluations + step.evaluations
        self._keep(step.x, step.value, evaluations)
        self._tell_best(evaluations, len(self.descents) + 1)

    def end(self, descent: Descent) -> None:
        """Keeps the end of a search."""
        self.descents.append(descent)
        self._keep(descent.x, descent.value, self.evaluations)

    def tell(self) -> None:
        """Tells where things are after the end of a search."""
        self._tell_best(self.evaluations, len(self.descents))

    def optimum(self, reason: str = "") -> Optimum:
        """The best that was found, and why the searches ended if it is not said."""
        reason = reason or why_ended(self.descents, self._n_starts)
        return best_of(self._search, self.descents, reason, self._n_starts, self._history, self._tell)

    def _keep(self, x: Floats | None, value: float, evaluations: int) -> None:
        if x is not None and (self._best is None or value < self._history[-1][1]):
            self._best = x
            self._history = (*self._history, (evaluations, value))

    def _tell_best(self, evaluations: int, number: int) -> None:
        if self._best is not None:
            space, value = self._search.space, self._history[-1][1]
            rates, placements = space.rates(self._best), space.placements(self._best)
            self._tell(
                Progress(
                    evaluations,
                    rates,
                    value,
                    number,
                    self._n_starts,
                    self._history,
                    placements=placements,
                )
            )


def _descend(shared: tuple[Search, int], start: Floats) -> Descent:
    search, budget = shared
    return descend(search, start, budget)
