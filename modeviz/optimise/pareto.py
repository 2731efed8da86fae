"""The front of a trade-off: designs on which neither goal can fall unless the other rises."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.runner import HERE
from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.optimise.descent import descend
from modeviz.optimise.evaluator import CANCELLED, CONVERGED, OUT_OF_BUDGET, Descent
from modeviz.optimise.run import BUDGET
from modeviz.optimise.search import Search
from modeviz.optimise.trade_off import ParetoPoint, TradeOff
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates

SCREENED = 20
"""Spread designs for each start."""

WARM = 2
"""Of the designs found so far, how many the next is searched from."""

SAME = 1e-4
"""Designs that differ by less in a goal, relative to it, are one."""


@dataclass(frozen=True, eq=False)
class Front:
    """Designs of which none is better than another in both goals, held against the full model."""

    names: tuple[str, str]
    """Of the goals."""
    designs: tuple[ParetoPoint, ...]
    """The best in the first goal first."""
    reason: str
    """Why it ended: "converged", "cancelled" or "out of budget"."""
    evaluations: int

    @property
    def converged(self) -> bool:
        """Whether every search came to its end."""
        return self.reason == CONVERGED

    @property
    def difference(self) -> float:
        """Of the full model's goals from those found, relative, the largest; see `Verification`."""
        return largest_difference(self.designs)


@dataclass(frozen=True, eq=False)
class FrontProgress:
    """Where the search for a front is."""

    evaluations: int
    designs: tuple[ParetoPoint, ...]
    """The front so far."""
    done: float
    """Of all its designs, 0 to 1; at 1 they are held against the full model, one after the other."""


def find_front(
    trade_off: TradeOff,
    known: Sequence[Rates],
    n_designs: int = 11,
    n_starts: int = 5,
    seed: int = 0,
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[FrontProgress], None] = lambda _: None,
) -> Front:
    """Designs along the front of two goals.

    The ends are the best in each goal. Between them the larger of F₁/√r and √r F₂ is made small for
    ratios r evenly spread in their logarithm: that finds a design on every ray from the origin, also
    where the front is not convex (V. J. Bowman, "On the relationship of the Tchebycheff norm and the
    efficient frontier", Lecture Notes in Economics 130, 1976). Each is searched from those that are
    best for it, of the designs found before and of some spread evenly.

        pair = sides(vehicle, problem)["lateral against vertical"]
        trade_off = prepare_trade_off(vehicle, problem, pair, vehicle.rates, vehicle.speed)
        for design in find_front(trade_off, [vehicle.rates]).designs:
            print(design.values, design.rates["C2"])

    Args:
        trade_off: see `prepare_trade_off`.
        known: rates to begin with, such as the present ones and the best that were found before.
        n_designs: how many to look for, two at least; those that another dominates are left out.
        n_starts: of the designs spread evenly, for each.
        seed: of these; the same finds the same.
        budget: the most evaluations, besides those that choose where to start.
        token: lets somebody hold or end it; what is found by then is kept.
        tell: told each design, and once more when it is held against the full model; designs that
            leave a window there are left out.

    Raises:
        SolveError: a design that cannot be solved.
    """
    walk = _Walk(trade_off, n_designs, n_starts, budget, token or CancelToken(), tell)
    space = trade_off.searches[0].space
    walk.spread([*map(space.to_x, known), *space.samples(SCREENED * n_starts, seed)])
    for search, weights in zip(trade_off.searches, np.eye(2), strict=True):
        walk.to(search, weights)
    for ratio in walk.ratios(n_designs - 2):
        weights = np.array([ratio**-0.5, ratio**0.5])
        walk.to(trade_off.weighted(weights), weights)
    return Front(trade_off.names, walk.checked(), walk.reason, walk.evaluations)


def largest_difference(designs: Sequence[ParetoPoint]) -> float:
    """Return the largest difference from the full model's goals, relative; NaN where one is unknown."""
    differences = [np.nan if d.verification is None else d.verification.difference for d in designs]
    return float(np.max(differences, initial=0.0))


def most_truncated(designs: Sequence[ParetoPoint]) -> tuple[int, TruncationGap] | None:
    """Return the design, from one, at whose rates frequencies are most too high, and by how much.

    None if of none it is known that a body lacks residual compliance.
    """
    gaps = [
        (number, design.verification.gap)
        for number, design in enumerate(designs, 1)
        if design.verification and design.verification.gap
    ]
    return max(gaps, key=lambda numbered: numbered[1].change, default=None)


class _Walk:
    """Goes from design to design and keeps them all."""

    def __init__(
        self,
        trade_off: TradeOff,
        n_designs: int,
        n_starts: int,
        budget: int,
        token: CancelToken,
        tell: Callable[[FrontProgress], None],
    ) -> None:
        self._trade_off, self._n_designs, self._n_starts = trade_off, n_designs, n_starts
        self._budget, self._token, self._tell = budget, token, tell
        self._spread: list[ParetoPoint] = []
        self._found: list[ParetoPoint] = []
        self._n_done = 0
        self.evaluations = 0
        self.reason = CONVERGED

    def spread(self, designs: Sequence[Floats]) -> None:
        """Evaluates designs to start from."""
        try:
            for x in designs:
                self._token.check()
                self._spread.append(self._trade_off.compromise(x))
        except CancelledError:
            self.reason = CANCELLED

    def to(self, search: Search, weights: Floats) -> None:
        """The best for one search down from several starts, unless it is to end.

        Args:
            search: for the larger of both goals, each times its weight.
            weights: (2,), of the goals.
        """
        for start in self._starts(weights):
            if self.reason == CONVERGED:
                self._keep(descend(search, start, self._budget - self.evaluations, self._token))
        self._n_done += 1
        done = self._n_done / self._n_designs
        self._tell(FrontProgress(self.evaluations, self.front(), done))

    def ratios(self, count: int) -> Floats:
        """Ratios of the goals between those at the ends found; none if there is but one end."""
        front = self.front()
        if len(front) < 2:
            return np.zeros(0)
        first, last = (np.divide(*front[i].values) for i in (0, -1))
        return np.geomspace(first, last, count + 2)[1:-1]

    def front(self) -> tuple[ParetoPoint, ...]:
        """The designs found that none dominates, the best in the first goal first."""
        kept: list[ParetoPoint] = []
        for design in sorted(self._found, key=lambda d: d.values):
            if not kept or design.values[1] < kept[-1].values[1] * (1 - SAME):
                kept.append(design)
        return tuple(kept)

    def checked(self) -> tuple[ParetoPoint, ...]:
        """The front, held against the full model; also what was found by the time of a cancel."""
        designs = list(self.front())
        for i, design in enumerate(
            HERE.map(TradeOff.verified, self._trade_off, designs, CancelToken())
        ):
            designs[i] = design
            self._tell(FrontProgress(self.evaluations, tuple(designs), 1.0))
        return tuple(d for d in designs if d.verification and d.verification.are_kept)

    def _starts(self, weights: Floats) -> list[Floats]:
        """The designs that are best for one search."""

        def worse(design: ParetoPoint) -> float:
            return float(np.max(weights * design.values))

        found, spread = sorted(self._found, key=worse), sorted(self._spread, key=worse)
        return [d.x for d in (*found[:WARM], *spread[: self._n_starts])]

    def _keep(self, descent: Descent) -> None:
        self.evaluations += descent.evaluations
        if descent.x is not None:
            self._found.append(self._trade_off.compromise(descent.x))
        if descent.reason in (CANCELLED, OUT_OF_BUDGET):
            self.reason = descent.reason
