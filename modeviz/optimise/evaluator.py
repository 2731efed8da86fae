"""What every search does with a design: evaluate it, count, remember the best, tell."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import OptimizeResult

from modeviz.analysis.latest import Latest
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.optimise.search import Search
from modeviz.optimise.windows import SLACK
from modeviz.vehicle.arrays import Floats

FORBIDDEN = 1e12
"""Stands for the goal of a design that leaves a window, where there must be a number."""

ROUNDING = 1e-12
"""Of the logarithm of a rate."""

CONVERGED, CANCELLED, OUT_OF_BUDGET = "converged", "cancelled", "out of budget"
"""Why a search ends; else it is the solver's own word."""


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


class OutOfBudgetError(Exception):
    """A search has evaluated as much as it may."""


class Evaluator:
    """Evaluates designs for a solver, counts, and remembers the best feasible one."""

    def __init__(
        self, search: Search, budget: int, token: CancelToken, tell: Callable[[Step], None]
    ) -> None:
        self._search, self._budget, self._token, self._tell = search, budget, token, tell
        self._n_evaluations = 0
        self.x: Floats | None = None
        self._value = np.inf
        self._unit = 0.0
        self._parts: Latest[tuple[Floats, Floats]] = Latest()
        self._margins: Latest[tuple[Floats, Floats]] = Latest()

    def value_and_gradient(self, x: Floats) -> tuple[float, Floats]:
        """The goal of the design nearest to one, and its derivatives, relative to the first one's goal.

        Raises:
            CancelledError: it is to end.
            OutOfBudgetError: it has evaluated as much as it may.
            SolveError: as `Search.evaluate`.
        """
        self._count()
        design = self._search.space.admitted(x)
        value, gradient = self._search.evaluate(design)
        unit = self._found(design, x, value)
        return value / unit, gradient / unit

    def parts(self, x: Floats) -> tuple[Floats, Floats]:
        """Return all of which a `MinMax` is the largest, likewise; asked twice it solves once."""
        return self._parts.get(x.tobytes(), lambda: self._solved_parts(x))

    def margins(self, x: Floats) -> tuple[Floats, Floats]:
        """Return what a design has left to the ends of windows, and derivatives, see `Search.margins`.

        A solver asks for these and for their derivatives, and whoever remembers the best design asks
        whether it is one: all that is one eigenproblem.
        """
        return self._margins.get(x.tobytes(), lambda: self._search.margins(x))

    def allows(self, x: Floats) -> bool:
        """Return whether all modes of the design nearest to one are where the windows want them."""
        return self._allows(self._search.space.admitted(x), x)

    def value(self, x: Floats) -> float:
        """The goal of a design; of one that leaves a window `FORBIDDEN` and more, the farther it is.

        Any that keeps to the windows is then better than any that does not (K. Deb, "An efficient
        constraint handling method for genetic algorithms", Comput. Methods Appl. Mech. Engrg. 186,
        2000). Raises as `value_and_gradient`.
        """
        self._count()
        is_allowed = self.allows(x)
        if is_allowed:
            value = self._search.value(x)
        else:
            value = FORBIDDEN * (1 - self.margins(x)[0].clip(max=0).sum())
        self._remember(x, value, is_allowed and value < self._value)
        return value

    def run(self, solve: Callable[[], OptimizeResult]) -> Descent:
        """Return what a solver that asks it found, and why that ended."""
        try:
            result = solve()
            reason = CONVERGED if result.success else str(result.message).lower()
        except CancelledError:
            reason = CANCELLED
        except OutOfBudgetError:
            reason = OUT_OF_BUDGET
        return Descent(self.x, self._value, reason, self._n_evaluations)

    def _solved_parts(self, x: Floats) -> tuple[Floats, Floats]:
        self._count()
        design = self._search.space.admitted(x)
        parts, gradients = self._search.parts(design)
        unit = self._found(design, x, float(parts.max()))
        return parts / unit, gradients / unit

    def _count(self) -> None:
        # The first design is always evaluated, so that whoever ends a search has one to keep.
        if self._n_evaluations:
            self._token.check()
        if self._n_evaluations >= self._budget:
            raise OutOfBudgetError
        self._n_evaluations += 1

    def _found(self, design: Floats, asked: Floats, value: float) -> float:
        """Remembers the design nearest to what is asked for; returns the first one's goal."""
        self._remember(design, value, value < self._value and self._allows(design, asked))
        self._unit = self._unit or abs(value) or 1.0
        return self._unit

    def _allows(self, design: Floats, asked: Floats) -> bool:
        """Return whether a design keeps to the windows, which what is asked for is near to."""
        if not self._search.kept:
            return True
        # What only rounding puts within the limits is the design that the solver asks for.
        is_asked = np.allclose(design, asked, rtol=0, atol=ROUNDING)
        return bool((self.margins(asked if is_asked else design)[0] >= -SLACK).all())

    def _remember(self, x: Floats, value: float, is_best: bool) -> None:
        if is_best:
            self.x, self._value = x, value
        self._tell(Step(self._n_evaluations, self.x, self._value))
