"""What a problem wants small, as one number of the rates, with its derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np

from modeviz.analysis.results import AXIS, Conditions
from modeviz.analysis.sensitivity import rate_variables
from modeviz.errors import VehicleError
from modeviz.optimise.decoupling import prepare_decoupling
from modeviz.optimise.integral import BandCase, Integral, prepare_integral
from modeviz.optimise.mount_goals import MountGoal, prepare_mount_goal
from modeviz.optimise.objective import LoadCase, Objective, prepare_objective
from modeviz.optimise.peak import PeakGoal, prepare_peak
from modeviz.ride.psd import RIDE_BAND
from modeviz.ride.rating import COMFORT_FACTORS
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS, Rates
from modeviz.vehicle.problem import MOUNTED, VARIABLES, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

DRIVER = 0
"""The response point that is rated."""

ResponseGoal = Objective | Integral | PeakGoal
"""A goal that is made of responses, and so scatters with parts."""


class Goal(Protocol):
    """One number that is to become small."""

    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""
        ...

    def exact_value(self, rates: Rates) -> float:
        """Return the same from the equations of motion of the full model."""
        ...

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """Return the number and its derivatives to each of `rate_variables`, (n_rates,), per N/m."""
        ...

    def of_vehicle(self, vehicle: Vehicle) -> Self:
        """Return the same goal, weights too, of the vehicle with mounts elsewhere or more of them."""
        ...


@dataclass(frozen=True, eq=False)
class LeastChange:
    """The mean of ln(k/k₀)² over the rates that are tuned and differ from zero."""

    vehicle: Vehicle
    base: Rates
    """k₀, of every group."""

    def value(self, rates: Rates) -> float:
        return self.value_and_gradient(rates)[0]

    def exact_value(self, rates: Rates) -> float:
        return self.value(rates)

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        variables = rate_variables(self.vehicle)
        k, k0 = (
            np.array([getattr(every[v.group], v.direction) for v in variables])
            for every in (self.vehicle.all_rates(rates), self.base)
        )
        log = np.log(np.divide(k, k0, out=np.ones_like(k), where=(k > 0) & (k0 > 0)))
        slope = np.divide(2 * log, k, out=np.zeros_like(k), where=k > 0)
        return float(log @ log) / self.n_rates, slope / self.n_rates

    @property
    def n_rates(self) -> int:
        """How many that are tuned differ from zero, one at least."""
        tuned = (getattr(self.base[v.group], v.direction) for v in rate_variables(self.vehicle))
        return max(1, sum(k > 0 for k in tuned))

    def of_vehicle(self, vehicle: Vehicle) -> "LeastChange":
        """Return the same of the vehicle with more mounts, of no rate, which do not change."""
        return LeastChange(vehicle, {**vehicle.rates, **self.base})


def prepare_goal(vehicle: Vehicle, problem: Problem, base: Rates, speed: float) -> Goal:
    """The goal of a problem; normalised, it is 1 with the vehicle's own rates.

    Args:
        vehicle: with the rates that it is normalised with.
        problem: whose goal.
        base: rates of every group, from which a change is measured.
        speed: on the roads, m/s.

    Raises:
        VehicleError: a name that the vehicle does not have, or no road for a goal that needs one.
        SolveError: frequencies on which an undamped resonance lies.
    """
    vehicle.check_problem(problem)
    if problem.goal == "change":
        return LeastChange(vehicle, base)
    if problem.goal in ("purity", "decoupling"):
        return prepare_decoupling(vehicle, problem)
    if problem.goal in MOUNTED:
        return _normalised(prepare_mount_goal(vehicle, problem, speed), problem)
    cases = load_cases(vehicle, problem, speed)
    objective = _objective(vehicle, problem, cases)
    weights = np.array([case.weight for case in cases])
    if problem.is_normalised:
        own = objective.values({})
        weights = weights / (objective.join(weights) or 1.0)
        weights = np.divide(weights, own, out=weights.copy(), where=own > 0)
    return objective.scaled(weights)


def _normalised(goal: MountGoal, problem: Problem) -> MountGoal:
    """The goal as the mean of its cases, each by what it is with the vehicle's own rates, if asked."""
    if not problem.is_normalised:
        return goal
    weights, own = np.array([case.weight for case in goal.cases]), goal.values({})
    shares = weights / weights.sum()
    return goal.scaled(np.divide(shares, own, out=shares.copy(), where=own > 0))


def exact_goal(goal: ResponseGoal, stiffness: Complexes) -> float:
    """The goal of parts with these complex rates, (n_springs,), N/m, from the full model."""
    system = goal.prepared.system
    changed = system.with_springs(stiffness - system.mount_stiffness)
    return goal.exact_total(changed, stiffness)


def _objective(
    vehicle: Vehicle, problem: Problem, cases: Sequence[LoadCase | BandCase]
) -> ResponseGoal:
    """Return what the problem's goal makes of load cases, all of which weigh one."""
    listed = [replace(case, weight=1.0) for case in cases if isinstance(case, LoadCase)]
    if not listed:
        return prepare_integral(vehicle, [case for case in cases if isinstance(case, BandCase)])
    if problem.goal == "peak":
        return prepare_peak(vehicle, listed)
    return prepare_objective(vehicle, listed)


def load_cases(
    vehicle: Vehicle, problem: Problem, speed: float
) -> Sequence[LoadCase] | Sequence[BandCase]:
    """The load cases of a goal that is made of accelerations; raises as `prepare_goal`."""
    if problem.goal in VARIABLES:
        return [case for p in problem.performance for case in _cases(vehicle, p, speed)]
    if problem.goal == "idle":
        return _idle_cases(vehicle)
    return [
        BandCase(
            Conditions(road, speed),
            _selected_squares(vehicle, problem, road),
            is_weighted=problem.goal == "iso 2631",
            highest_hz=RIDE_BAND[1] if problem.goal == "rating" else np.inf,
        )
        for road in _roads(vehicle, problem)
    ]


def _selected_squares(vehicle: Vehicle, problem: Problem, road: str) -> Floats:
    """Return what a goal over the whole band takes of mean squares on a road, (n_points, 3)."""
    selected = np.zeros((len(vehicle.response_points), 3))
    match problem.goal:
        case "rms":
            named = [p for p in problem.performance if road in p.roads]
            every = [_selected(vehicle, p.points, p.directions) for p in named]
            selected = np.max(every or [_selected(vehicle)], axis=0)
        case "rating":
            selected[DRIVER, [AXIS["lateral"], AXIS["vertical"]]] = 1.0
        case "iso 2631":
            selected[DRIVER] = np.square(COMFORT_FACTORS) * STANDARD_GRAVITY**2
    return selected


def _cases(vehicle: Vehicle, performance: Performance, speed: float) -> list[LoadCase]:
    """One for each of its loads."""
    roads = [Conditions(road, speed) for road in performance.roads]
    wheels = [vehicle.harmonic_load(load) for load in performance.wheel_loads]
    f = tuple(performance.frequency_hz.tolist())
    pattern = np.broadcast_to(
        _selected(vehicle, performance.points, performance.directions),
        (len(f), len(vehicle.response_points), 3),
    )
    return [
        LoadCase(load, f, performance.weight, pattern, performance.target) for load in [*roads, *wheels]
    ]


def _idle_cases(vehicle: Vehicle) -> list[LoadCase]:
    """Each order of the engines at idle, if that is in the band: half its squares are the mean's."""
    pattern = np.zeros((1, len(vehicle.response_points), 3))
    pattern[0, DRIVER] = 0.5
    at_idle = [(order, order.order * e.idle_hz) for e in vehicle.engines for order in e.orders]
    band = vehicle.frequency_hz[[0, -1]]
    cases = [LoadCase(o, (f,), pattern=pattern) for o, f in at_idle if band[0] <= f <= band[1]]
    if not cases:
        lowest = min((f for _, f in at_idle), default=0.0)
        raise VehicleError(
            f"goal 'idle': found the lowest order at {lowest:.3g} Hz, expected one within the band, "
            f"{band[0]:g} to {band[1]:g} Hz: see highest_frequency"
        )
    return cases


def _selected(
    vehicle: Vehicle,
    points: Sequence[str] = (),
    directions: Sequence[str] = RIDE_DIRECTIONS,
) -> Floats:
    """(n_points, 3): one for the points, none is all, and directions of performance variables."""
    names = [point.name for point in vehicle.response_points]
    numbers = [names.index(name) for name in points or names]
    selected = np.zeros((len(names), 3))
    selected[np.ix_(numbers, [AXIS[d] for d in directions])] = 1.0
    return selected


def _roads(vehicle: Vehicle, problem: Problem) -> list[str]:
    """The roads that the problem names, each once, else the one that usually shakes the vehicle."""
    named = list(dict.fromkeys(road for p in problem.performance for road in p.roads))
    if named:
        return named
    usual = vehicle.usual_load
    if usual is None:
        raise VehicleError(
            f"problem {problem.name!r}: goal {problem.goal!r} needs a [[tyre]] or another random load "
            "than a road"
        )
    return [usual.name]
