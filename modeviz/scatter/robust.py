"""A goal that holds for nearly all vehicles that are built: a percentile over parts that scatter."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.special import betainc

from modeviz.analysis.sensitivity import spring_shares
from modeviz.compute.cancel import CancelToken
from modeviz.errors import SolveError
from modeviz.optimise.evaluator import CANCELLED, OUT_OF_BUDGET
from modeviz.optimise.goals import ResponseGoal, exact_goal
from modeviz.optimise.run import BUDGET, Optimum, Progress, optimise
from modeviz.optimise.search import Search
from modeviz.scatter.tolerance import Parts, Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

LEAST_WEIGHT = 1e-5
"""Samples that count less are left out: at the 95th percentile of 100, eighty of them."""


@dataclass(frozen=True, eq=False)
class Robust:
    """A percentile of an objective over parts within their tolerance, a goal for a search.

    The same parts are tried with every design, so that designs differ by what they are and not by luck
    (common random numbers). The percentile is that of F. E. Harrell and C. E. Davis ("A new
    distribution-free quantile estimator", Biometrika 69(3), 1982), Σ w_i F_(i) over the sorted values
    with weights of a beta distribution: unlike one value of the sample it changes smoothly.
    """

    objective: ResponseGoal
    tolerance: Tolerance
    deviations: Floats
    """(n_samples, n_deviations), see `Parts`."""
    percent: float
    """Of which percentile, above 0 and below 100."""
    weights: Floats
    """(n_samples,): of the smallest value, the next, and so on; they sum to one."""
    probed: tuple[int, ...] = ()
    """The numbers of the mounts of which those are parts that a search adds, see `Probes`."""

    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.weights @ np.sort(goals(self.objective, self._parts(rates), self._of_mounts)))

    def exact_value(self, rates: Rates) -> float:
        """Return the value from the equations of motion, for the samples that count here.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: as `direct_response`.
        """
        objective, parts = self.objective, self._parts(rates)
        counted, weights = self._counted(goals(objective, parts, self._of_mounts))
        exact = [self._exact(parts.stiffness(self._of_mounts[i])) for i in counted]
        return float(weights @ exact)

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """Return the value and its derivatives to each of `rate_variables`, (n_rates,), per N/m."""
        parts = self._parts(rates)
        values = goals(self.objective, parts, self._of_mounts)
        counted, weights = self._counted(values)
        has_rate = spring_shares(self.objective.prepared, rates).real
        gradient = np.zeros(has_rate.shape[1])
        for i, weight in zip(counted, weights, strict=True):
            own = self._of_mounts[i]
            shares = parts.factor(own)[:, None] * has_rate
            gradient += weight * self.objective.of_springs(parts.stiffness(own), shares)[1]
        return float(weights @ values[counted]), gradient

    def of_vehicle(self, vehicle: Vehicle) -> "Robust":
        """Return the same parts in the vehicle with mounts elsewhere, or with `probed` ones as well."""
        return replace(self, objective=self.objective.of_vehicle(vehicle))

    @cached_property
    def _of_mounts(self) -> Floats:
        """The deviations of the mounts that the objective has, those of `probed` ones as of theirs."""
        hardness, loss = np.split(self.deviations, 2, axis=-1)
        n_more = len(self.objective.prepared.vehicle.mounts) - hardness.shape[-1]
        mounts = [*range(hardness.shape[-1]), *self.probed[:n_more]]
        return np.hstack([hardness[:, mounts], loss[:, mounts]])

    def _parts(self, rates: Rates) -> Parts:
        return scattered_parts(self.objective.prepared, rates, self.tolerance)

    def _counted(self, values: Floats) -> tuple[np.ndarray, Floats]:
        """Return which samples have a weight, and the weights."""
        has_weight = self.weights > 0
        return np.argsort(values, kind="stable")[has_weight], self.weights[has_weight]

    def _exact(self, stiffness: Complexes) -> float:
        """The objective of parts, from the full model."""
        return exact_goal(self.objective, stiffness)


def robust(
    objective: ResponseGoal,
    tolerance: Tolerance,
    percent: float = 95.0,
    n_samples: int = 100,
    seed: int = 0,
) -> Robust:
    """The goal of a robust optimum; searched from the optimum for parts as drawn.

    On the built-in truck an evaluation of the paper's problem takes 40 times as long as for parts as
    drawn.

    Args:
        objective: of parts as drawn.
        tolerance: of the parts.
        percent: above 0, below 100.
        n_samples: vehicles that are tried with every design, two or more.
        seed: of these; the same gives the same.

    Raises:
        SolveError: fewer samples, or no such percentile.
    """
    if n_samples < 2:
        raise SolveError(f"samples: found {n_samples}, expected 2 or more")
    if not 0 < percent < 100:
        raise SolveError(f"percentile: found {percent:g}, expected more than 0 and less than 100")
    deviations = scattered_parts(objective.prepared, {}, tolerance).samples(n_samples, seed)
    return Robust(objective, tolerance, deviations, percent, percentile_weights(n_samples, percent))


def robust_search(search: Search, tolerance: Tolerance, percent: float = 95.0) -> Search:
    """Return the search for a percentile over parts that scatter, to begin at the optimum as drawn.

    Raises:
        SolveError: the goal does not scatter, or as `robust`.
    """
    if not isinstance(search.goal, ResponseGoal):
        raise SolveError(
            "the goal does not scatter with parts: a robust search needs one that is made of "
            "accelerations, such as accelerations, peak or rating"
        )
    goal = robust(search.goal, tolerance, percent)
    probed = tuple(probe.mount for probe in search.probes.probes)
    return replace(search, goal=replace(goal, probed=probed))


def optimise_robustly(
    robustly: Search,
    before: Optimum,
    budget: int = BUDGET,
    token: CancelToken | None = None,
    tell: Callable[[Progress], None] = lambda _: None,
) -> Optimum:
    """The optimum for parts that scatter, from that for parts as drawn on.

    Args:
        robustly: see `robust_search`.
        before: what was found as drawn; its evaluations and its end count, too.
        budget: the most evaluations of both searches; the second has one at least.
        token: as of `optimise`, as are `tell` and what it raises.
        tell: told of the second search alone.
    """
    after = optimise(robustly, [before.x], max(1, budget - before.evaluations), token, tell)
    was_cut_short = before.reason in (CANCELLED, OUT_OF_BUDGET)
    return replace(
        after,
        reason=before.reason if after.converged and was_cut_short else after.reason,
        evaluations=before.evaluations + after.evaluations,
        descents=(*before.descents, *after.descents),
    )


def percentile_weights(n_samples: int, percent: float) -> Floats:
    """Weights (n_samples,) of sorted values whose sum is Harrell's and Davis's percentile."""
    p = percent / 100
    edges = np.arange(n_samples + 1) / n_samples
    weights = np.diff(betainc((n_samples + 1) * p, (n_samples + 1) * (1 - p), edges))
    weights[weights < LEAST_WEIGHT] = 0
    return weights / weights.sum()
