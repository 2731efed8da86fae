"""The search everywhere at once: scipy's differential evolution among feasible designs."""

from collections.abc import Callable

from scipy.optimize import differential_evolution

from modeviz.compute.cancel import CancelToken
from modeviz.optimise.evaluator import Descent, Evaluator, Step
from modeviz.optimise.search import Search


def evolve(
    search: Search,
    seed: int,
    budget: int,
    token: CancelToken | None = None,
    tell: Callable[[Step], None] = lambda _: None,
) -> Descent:
    """The best design that a population comes to.

    It lives in the unit cube of `DesignSpace.sampled`, where every point meets bounds and ratio limits
    (R. Storn and K. Price, "Differential evolution", J. Global Optimization 11, 1997).

    Args:
        search: what is sought.
        seed: of the population; the same finds the same.
        budget: the most evaluations it may take.
        token: lets somebody hold or end it.
        tell: told every evaluation.

    Raises:
        SolveError: a design that cannot be solved, with its rates.
    """
    evaluator = Evaluator(search, budget, token or CancelToken(), tell)
    return evaluator.run(
        lambda: differential_evolution(
            lambda fractions: evaluator.value(search.space.sampled(fractions)),
            [(0.0, 1.0)] * search.space.n_variables,
            maxiter=budget,
            rng=seed,
            polish=False,
        )
    )
