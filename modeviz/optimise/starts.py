"""Where searches begin: designs that a few steps show to be worth going on with."""

from collections.abc import Sequence

import numpy as np

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.optimise.descent import descend
from modeviz.optimise.search import Search
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates

MOST_STARTS = 1_000
"""More take minutes to choose, and an hour to search from."""

SCREENED = 40
"""Spread designs for each start."""

ROUNDS = (6, 6), (2, 6)
"""Of these designs, the best for each start that take some steps, and the evaluations of each; then the
best of these that take some more."""


def start_points(
    search: Search, rates: Rates, n_starts: int, seed: int = 0, token: CancelToken | None = None
) -> list[Floats]:
    """Return where to search from: some rates, and the best of many spread designs after some steps.

    The goal of a spread design says little about the minimum below it: a deep one may be narrow, with
    high walls, and the best designs lie around a few wide ones. Some steps of the search say more. So
    the least are spent on most designs and the most on the best: successive halving (K. Jamieson,
    A. Talwalkar, "Non-stochastic best arm identification and hyperparameter optimization", AISTATS
    2016), after steps that concentrate a sample around its minima (A. A. Törn, "Cluster analysis using
    seed points and density-determined hyperspheres as an aid to global optimization", IEEE
    Transactions on Systems, Man and Cybernetics 7(8), 1977).

    The paper's problem on the built-in truck has some 60 minima, from 0.265 to 0.99 of the original's
    objective, and 2 in 100 spread designs lead to the best.

    Args:
        search: among whose designs.
        rates: the first start.
        n_starts: how many in all.
        seed: of the others; the same gives the same.
        token: lets somebody hold it, or end it with those that it has.

    Raises:
        SolveError: a design that cannot be solved, with its rates.
    """
    n_others, token = n_starts - 1, token or CancelToken()
    spread = search.space.samples(SCREENED * n_others, seed)
    values: list[float] = []
    try:
        for x in spread:
            token.check()
            values.append(search.value(x))
    except CancelledError:
        pass
    designs = _best(spread[: len(values)], values)
    return [search.space.to_x(rates), *_gone_on_with(search, designs, n_others, token)[:n_others]]


def _gone_on_with(search: Search, designs: list[Floats], n: int, token: CancelToken) -> list[Floats]:
    """Return the designs that some steps show to be the best, the best first, as far as that came."""
    for n_each, n_evaluations in ROUNDS:
        ends = []
        for x in designs[: n_each * n]:
            try:
                token.check()
            except CancelledError:
                return designs
            ends.append(_stepped(search, x, n_evaluations, token))
        designs = _best([x for x, _ in ends], [value for _, value in ends])
    return designs


def _best(designs: Sequence[Floats] | Floats, values: list[float]) -> list[Floats]:
    """Return the same designs, the best first."""
    return [designs[i] for i in np.argsort(values, kind="stable")]


def _stepped(search: Search, x: Floats, n_evaluations: int, token: CancelToken) -> tuple[Floats, float]:
    """A design after some steps, and its goal; where windows allow none on the way, the same."""
    end = descend(search, x, n_evaluations, token)
    return x if end.x is None else end.x, end.value
