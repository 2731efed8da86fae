"""A goal, the designs among which it is to become small, and how good one is."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.sensitivity import rate_variables
from modeviz.errors import SolveError, located
from modeviz.optimise.deflections import Deflections, prepare_deflections
from modeviz.optimise.design_space import DesignSpace, design_space
from modeviz.optimise.goals import Goal, prepare_goal
from modeviz.optimise.min_max import MinMax
from modeviz.optimise.windows import Windows, prepare_windows
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Search:
    """A goal, and the designs among which it is to become small."""

    space: DesignSpace
    goal: Goal
    windows: Windows | None = None
    deflections: Deflections | None = None

    @property
    def kept(self) -> tuple[Windows | Deflections, ...]:
        """What designs have to keep to beside bounds and ratio limits."""
        return tuple(each for each in (self.windows, self.deflections) if each is not None)

    @property
    def kept_words(self) -> list[str]:
        """What a person calls each of `margins`."""
        return [words for each in self.kept for words in each.spoken]

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

    def parts(self, x: Floats) -> tuple[Floats, Floats]:
        """Return the parts of a `MinMax`, (n,), and their derivatives, (n, n_variables).

        Raises:
            SolveError: as `evaluate`.
        """
        assert isinstance(self.goal, MinMax)
        rates = self.space.rates(x)
        with self._naming(x):
            parts, by_rate = self.goal.parts_and_gradients(rates)
            gradients = self._by_x(rates, by_rate)
            _check_finite(float(parts.max()), gradients)
        return parts, gradients

    def margins(self, x: Floats) -> tuple[Floats, Floats]:
        """Return what is left to ends of windows and to limits of deflections, and derivatives.

        (n_ends,) and (n_ends, n_variables).
        """
        if not self.kept:
            return np.zeros(0), np.zeros((0, self.space.n_variables))
        rates = self.space.rates(x)
        values, by_rate = zip(*(each.margins(rates) for each in self.kept), strict=True)
        return np.concatenate(values), self._by_x(rates, np.vstack(by_rate))

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
    with located(f"problem {problem.name!r}"):
        space = design_space(vehicle, problem.groups, rates, locked)
    goal = prepare_goal(vehicle, problem, rates, speed)
    with located(f"problem {problem.name!r}"):
        windows = prepare_windows(prepare_modes(vehicle), problem.windows) if problem.windows else None
        limits = problem.deflections
        deflections = prepare_deflections(vehicle, limits) if limits else None
    return Search(space, goal, windows, deflections)
