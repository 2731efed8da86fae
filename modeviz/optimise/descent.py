"""The search from one start: scipy's SLSQP with analytic derivatives, feasible at every step."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.optimize import OptimizeResult, minimize

from modeviz.compute.cancel import CancelToken
from modeviz.optimise.evaluator import Descent, Evaluator, Step
from modeviz.optimise.min_max import MinMax
from modeviz.optimise.search import Search
from modeviz.vehicle.arrays import Floats

TOLERANCE = 1e-12
"""A search has converged when a step gains less of the goal that it started with: then the derivatives
along what is free are some 1e-7 of the rest, with 1e-8 they are 1e-4, for a tenth less evaluations."""

MOST_STEPS = 500
"""Of one search; the budget of evaluations ends it before."""

RESTARTS = 2
"""How often a solver that got stuck begins anew where it was best, with nothing to mislead it."""

MIN_MAX_TOLERANCE = 1e-8
"""The same of a `MinMax`: many parts meet where it is smallest, and rounding keeps SLSQP from ending
with less."""


def descend(
    search: Search,
    start: Floats,
    budget: int,
    token: CancelToken | None = None,
    tell: Callable[[Step], None] = lambda _: None,
) -> Descent:
    """The best design down from a start.

    Bounds and ratio limits are linear, so that SLSQP (D. Kraft, "A software package for sequential
    quadratic programming", DFVLR-FB 88-28, 1988) keeps to them at every step; what it evaluates is put
    within them to the last bit. Of modes' windows only designs that keep to them count. A `MinMax` is
    the smallest t that none of its parts is above, which is smooth again.

    Args:
        search: what is sought.
        start: (n_variables,), put within the limits.
        budget: the most evaluations it may take.
        token: lets somebody hold or end it.
        tell: told every evaluation.

    Raises:
        SolveError: a design that cannot be solved, with its rates.
    """
    evaluator = Evaluator(search, budget, token or CancelToken(), tell)
    return evaluator.run(lambda: _past_windows(search, evaluator, search.space.admitted(start)))


def _past_windows(search: Search, evaluator: Evaluator, start: Floats) -> OptimizeResult:
    """The end of the solver without windows if they allow it, else with them from the best they do.

    On the way to a design that keeps to them modes may cross and change their names, where a window
    jumps and would stop the solver.
    """
    if not search.kept:
        return _restarted(search, evaluator, start)
    free = _restarted(replace(search, windows=None, deflections=None), evaluator, start)
    if evaluator.allows(free.x[: search.space.n_variables]):
        return free
    return _restarted(search, evaluator, start if evaluator.x is None else evaluator.x)


def _restarted(search: Search, evaluator: Evaluator, start: Floats) -> OptimizeResult:
    """The end of the solver for the goal, begun again from the best design where it got stuck."""
    solve = _smallest_largest if isinstance(search.goal, MinMax) else _smallest
    result = solve(search, evaluator, start)
    for _ in range(RESTARTS):
        if result.success or evaluator.x is None:
            break
        result = solve(search, evaluator, evaluator.x)
    return result


def _smallest(search: Search, evaluator: Evaluator, start: Floats) -> OptimizeResult:
    """SLSQP down a goal that is smooth."""
    return minimize(
        evaluator.value_and_gradient,
        start,
        jac=True,
        method="SLSQP",
        bounds=_bounds(search),
        constraints=_constraints(search, evaluator),
        options={"ftol": TOLERANCE, "maxiter": MOST_STEPS},
    )


def _smallest_largest(search: Search, evaluator: Evaluator, start: Floats) -> OptimizeResult:
    """SLSQP for (x, t): t is to become small, and nothing may be above it."""
    under = {
        "type": "ineq",
        "fun": lambda z: z[-1] - evaluator.parts(z[:-1])[0],
        "jac": lambda z: np.pad(-evaluator.parts(z[:-1])[1], ((0, 0), (0, 1)), constant_values=1.0),
    }
    return minimize(
        lambda z: z[-1],
        np.append(start, evaluator.parts(start)[0].max()),
        jac=lambda z: np.eye(len(z))[-1],
        method="SLSQP",
        bounds=[*_bounds(search), (0.0, None)],
        constraints=[under, *map(_without_last, _constraints(search, evaluator))],
        options={"ftol": MIN_MAX_TOLERANCE, "maxiter": MOST_STEPS},
    )


def _without_last(constraint: dict[str, Any]) -> dict[str, Any]:
    """Return the same constraint of all numbers but the last."""
    return {
        "type": "ineq",
        "fun": lambda z: constraint["fun"](z[:-1]),
        "jac": lambda z: np.pad(constraint["jac"](z[:-1]), ((0, 0), (0, 1))),
    }


def _bounds(search: Search) -> list[tuple[float, float]]:
    return list(zip(search.space.lower.tolist(), search.space.upper.tolist(), strict=True))


def _constraints(search: Search, evaluator: Evaluator) -> list[dict[str, Any]]:
    """Ratio limits and windows as scipy takes them, c(x) >= 0."""
    space = search.space
    rows, values = space.rows[space.ratios], space.values[space.ratios]
    constraints = []
    if len(rows):
        constraints.append({"type": "ineq", "fun": lambda x: values - rows @ x, "jac": lambda _: -rows})
    if search.kept:
        margins = evaluator.margins
        constraints.append(
            {"type": "ineq", "fun": lambda x: margins(x)[0], "jac": lambda x: margins(x)[1]}
        )
    return constraints
