"""The search from one start: scipy's SLSQP with analytic derivatives, feasible at every step."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import minimize

from modeviz.errors import SolveError
from modeviz.tuning.control import CancelledError, Control
from modeviz.tuning.design import DesignSpace, design_space
from modeviz.tuning.goals import Goal, prepare_goal
from modeviz.tuning.preparation import prepare_modes
from modeviz.tuning.sensitivity import rate_variables
from modeviz.tuning.threads import one_thread
from modeviz.tuning.windows import Windows, prepare_windows
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

TOLERANCE = 1e-12
"""A search has converged when a step gains less of the goal that it started with: then the derivatives
along what is free are some 1e-7 of the rest, with 1e-8 they are 1e-4, for a tenth less evaluations."""

MOST_STEPS = 500
"""Of one search; the budget of evaluations ends it before."""

FORBIDDEN = 1e12
"""Stands for the goal of a design that leaves a window, where there must be a number."""

CONVERGED, CANCELLED, OUT_OF_BUDGET = "converged", "cancelled", "out of budget"
"""Why a search ends; else it is the solver's own word."""


@dataclass(frozen=True, eq=False)
class Search:
    """A goal, and the designs among which it is to become small."""

    space: DesignSpace
    goal: Goal
    windows: Windows | None = None

    def evaluate(self, x: Floats) -> tuple[float, Floats]:
        """The goal of a design, and its derivatives, (n_variables,).

        Raises:
            SolveError: it has none, with the rates.
        """
        rates = self.space.rates(x)
        with self._naming(x):
            value, by_rate = self.goal.value_and_gradient(rates)
            gradient = self._by_x(rates, by_rate)
            _check_finite(value, gradient)
        return value, gradient

    def value(self, x: Floats) -> float:
        """The goal of a design; raises as `evaluate`."""
        with self._naming(x):
            value = self.goal.value(self.space.rates(x))
            _check_finite(value)
        return value

    def margins(self, x: Floats) -> tuple[Floats, Floats]:
        """What is left to the ends of windows, (n_ends,), and derivatives, (n_ends, n_variables)."""
        if self.windows is None:
            return np.zeros(0), np.zeros((0, self.space.n_variables))
        rates = self.space.rates(x)
        values, by_rate = self.windows.margins(rates)
        return values, self._by_x(rates, by_rate)

    def allows(self, x: Floats) -> bool:
        """Whether all modes of a design are where the windows want them."""
        return self.windows is None or bool((self.margins(x)[0] >= 0).all())

    @contextmanager
    def _naming(self, x: Floats) -> Iterator[None]:
        """Says with which rates something cannot be solved."""
        try:
            yield
        except SolveError as error:
            raise SolveError(f"{error}; with {self.space.spoken(x)}") from None

    def _by_x(self, rates: Rates, by_rate: Floats) -> Floats:
        """Derivatives to x of what has derivatives to rates, (..., n_rates): dk = k dx."""
        k = [getattr(rates[v.group], v.direction) for v in rate_variables(self.space.vehicle)]
        return (by_rate * k) @ self.space.members


def _check_finite(value: float, gradient: Floats | float = 0.0) -> None:
    if not (np.isfinite(value) and np.isfinite(gradient).all()):
        raise SolveError(f"the goal is {value} and its derivatives are {gradient}")


@one_thread
def prepare_search(
    vehicle: Vehicle,
    problem: Problem,
    rates: Rates,
    speed: float,
    locked: frozenset[tuple[str, str]] = frozenset(),
) -> Search:
    """The search for better rates that a problem asks for.

    Args:
        vehicle: with the rates that the goal is normalised with.
        problem: which rates may change, within what, and what is to become small.
        rates: of every group: what others keep, what fixed ratios are of, and from which a change is
            measured.
        speed: on the roads, m/s.
        locked: rates, (group, field of `MountRates`), that may not change.

    Raises:
        VehicleError: as `prepare_goal`, `design_space` and `prepare_windows`.
        SolveError: as `prepare_goal`.
    """
    space = design_space(vehicle, problem.groups, rates, locked)
    goal = prepare_goal(vehicle, problem, rates, speed)
    windows = prepare_windows(prepare_modes(vehicle), problem.windows) if problem.windows else None
    return Search(space, goal, windows)


@dataclass(frozen=True, eq=False)
class Step:
    """An evaluation of a search."""

    evaluations: int
    """So many by now."""
    x: Floats | None
    """The best design so far; None while none is within the windows."""
    value: float
    """Of that; infinite while there is none."""


@dataclass(frozen=True, eq=False)
class Descent:
    """The end of the search from one start."""

    x: Floats | None
    """The best feasible design it met; None if it met none."""
    value: float
    """Its goal; infinite if there is none."""
    reason: str
    """`CONVERGED`, `CANCELLED`, `OUT_OF_BUDGET`, or why the solver stopped."""
    evaluations: int

    @property
    def converged(self) -> bool:
        return self.reason == CONVERGED


@one_thread
def descend(
    search: Search,
    start: Floats,
    budget: int,
    control: Control | None = None,
    tell: Callable[[Step], None] = lambda _: None,
) -> Descent:
    """The best design down from a start.

    Bounds and ratio limits are linear, so that SLSQP (D. Kraft, "A software package for sequential
    quadratic programming", DFVLR-FB 88-28, 1988) keeps to them at every step; what it evaluates is put
    within them to the last bit. Of modes' windows only designs that keep to them count.

    Args:
        search: what is sought.
        start: (n_variables,), put within the limits.
        budget: the most evaluations it may take.
        control: lets somebody hold or end it.
        tell: told every evaluation.

    Raises:
        SolveError: a design that cannot be solved, with its rates.
    """
    evaluator = Evaluator(search, budget, control or Control(), tell)
    try:
        result = minimize(
            evaluator.value_and_gradient,
            search.space.admitted(start),
            jac=True,
            method="SLSQP",
            bounds=list(zip(search.space.lower, search.space.upper, strict=True)),
            constraints=_constraints(search),
            options={"ftol": TOLERANCE, "maxiter": MOST_STEPS},
        )
        reason = CONVERGED if result.success else result.message.lower()
    except CancelledError:
        reason = CANCELLED
    except OutOfBudgetError:
        reason = OUT_OF_BUDGET
    return evaluator.end(reason)


class OutOfBudgetError(Exception):
    """A search has evaluated as much as it may."""


class Evaluator:
    """Evaluates designs for a solver, counts, and remembers the best feasible one."""

    def __init__(
        self, search: Search, budget: int, control: Control, tell: Callable[[Step], None]
    ) -> None:
        self._search, self._budget, self._control, self._tell = search, budget, control, tell
        self._n_evaluations = 0
        self._x: Floats | None = None
        self._value = np.inf
        self._unit = 0.0

    def value_and_gradient(self, x: Floats) -> tuple[float, Floats]:
        """The goal of the design nearest to one, and its derivatives, relative to the first one's goal.

        Raises:
            CancelledError: it is to end.
            OutOfBudgetError: it has evaluated as much as it may.
            SolveError: as `Search.evaluate`.
        """
        self._count()
        x = self._search.space.admitted(x)
        value, gradient = self._search.evaluate(x)
        self._remember(x, value, value < self._value and self._search.allows(x))
        self._unit = self._unit or abs(value) or 1.0
        return value / self._unit, gradient / self._unit

    def value(self, x: Floats) -> float:
        """The goal of a design; of one that leaves a window `FORBIDDEN` and more, the farther it is.

        Any that keeps to the windows is then better than any that does not (K. Deb, "An efficient
        constraint handling method for genetic algorithms", Comput. Methods Appl. Mech. Engrg. 186,
        2000). Raises as `value_and_gradient`.
        """
        self._count()
        excess = -self._search.margins(x)[0].clip(max=0).sum()
        value = FORBIDDEN * (1 + excess) if excess > 0 else self._search.value(x)
        self._remember(x, value, excess == 0 and value < self._value)
        return value

    def end(self, reason: str) -> Descent:
        """What it found, and why it ended."""
        return Descent(self._x, self._value, reason, self._n_evaluations)

    def _count(self) -> None:
        # The first design is always evaluated, so that whoever ends a search has one to keep.
        if self._n_evaluations:
            self._control.check()
        if self._n_evaluations >= self._budget:
            raise OutOfBudgetError
        self._n_evaluations += 1

    def _remember(self, x: Floats, value: float, is_best: bool) -> None:
        if is_best:
            self._x, self._value = x, value
        self._tell(Step(self._n_evaluations, self._x, self._value))


def _constraints(search: Search) -> list[dict[str, Any]]:
    """Ratio limits and windows as scipy takes them, c(x) >= 0."""
    space = search.space
    rows, values = space.rows[space.ratios], space.values[space.ratios]
    constraints = []
    if len(rows):
        constraints.append({"type": "ineq", "fun": lambda x: values - rows @ x, "jac": lambda _: -rows})
    if search.windows is not None:
        constraints.append(
            {
                "type": "ineq",
                "fun": lambda x: search.margins(x)[0],
                "jac": lambda x: search.margins(x)[1],
            }
        )
    return constraints
