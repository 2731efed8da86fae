"""Two goals for the same designs: what a problem wants small, on two sides."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from modeviz.errors import ModevizError, VehicleError, unknown
from modeviz.optimise.goals import Goal
from modeviz.optimise.min_max import MinMax
from modeviz.optimise.search import Search, prepare_search
from modeviz.optimise.verification import Verification, verify
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements
from modeviz.vehicle.problem import VARIABLES, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Side:
    """One of two goals: what a problem wants small, at some points along some directions only."""

    name: str
    points: tuple[str, ...] = ()
    """Names of response points; none is all."""
    directions: tuple[str, ...] = ()
    """None is all."""


@dataclass(frozen=True, eq=False)
class ParetoPoint:
    """A design on the front."""

    x: Floats
    rates: Rates
    """Of every group."""
    values: tuple[float, float]
    """Of both goals."""
    verification: Verification | None = None
    """What the full model says of that goal which differs more; None before it is asked."""
    placements: Placements = field(default_factory=dict)
    """Where its mounts are, of those that are not where they were given."""


@dataclass(frozen=True, eq=False)
class TradeOff:
    """Two goals for the same designs."""

    names: tuple[str, str]
    searches: tuple[Search, Search]
    """In one space, within the same windows."""

    def compromise(self, x: Floats) -> ParetoPoint:
        """A design with what both goals are; raises as `Search.value`."""
        first, second = (search.value(x) for search in self.searches)
        space = self.searches[0].space
        return ParetoPoint(x, space.rates(x), (first, second), placements=space.placements(x))

    def verified(self, design: ParetoPoint) -> ParetoPoint:
        """Return the same design with what the full model says of it."""
        return replace(design, verification=verify(self.searches, design.x, design.values))

    def weighted(self, weights: Floats) -> Search:
        """The search for the least of the larger of both goals, each times its weight, (2,)."""
        first, second = (search.goal for search in self.searches)
        return replace(self.searches[0], goal=Worse((first, second), weights))


@dataclass(frozen=True, eq=False)
class Worse(MinMax):
    """The larger of two goals, each with its weight."""

    goals: tuple[Goal, Goal]
    weights: Floats
    """(2,)."""

    def value(self, rates: Rates) -> float:
        return self._larger([goal.value(rates) for goal in self.goals])

    def exact_value(self, rates: Rates) -> float:
        return self._larger([goal.exact_value(rates) for goal in self.goals])

    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        both = [goal.value_and_gradient(rates) for goal in self.goals]
        values, gradients = (np.array(part) for part in zip(*both, strict=True))
        return self.weights * values, self.weights[:, None] * gradients

    def of_vehicle(self, vehicle: Vehicle) -> "Worse":
        first, second = (goal.of_vehicle(vehicle) for goal in self.goals)
        return replace(self, goals=(first, second))

    def _larger(self, values: Sequence[float]) -> float:
        return float(np.max(self.weights * values))


def sides(vehicle: Vehicle, problem: Problem) -> dict[str, tuple[Side, Side]]:
    """The trade-offs that a problem offers, by their names: of directions, and of places.

    Points are at one place if their names differ by "left" and "right" only: "seat track against toe
    panel".
    """
    found: dict[str, tuple[Side, Side]] = {}
    used = [p.directions for p in problem.performance]
    directions = [Side(d, directions=(d,)) for d in dict.fromkeys(d for own in used for d in own)]
    names = dict.fromkeys(n for p in problem.performance for n in _points(vehicle, p))
    places: dict[str, tuple[str, ...]] = {}
    for name in names:
        place = " ".join(word for word in name.split() if word not in ("left", "right"))
        places[place] = (*places.get(place, ()), name)
    at_places = [Side(place, points) for place, points in places.items()]
    for every in (directions, at_places):
        for i, first in enumerate(every):
            for second in every[i + 1 :]:
                found[f"{first.name} against {second.name}"] = first, second
    return found


def chosen_sides(vehicle: Vehicle, problem: Problem, name: str) -> tuple[Side, Side]:
    """Return one of `sides`.

    Raises:
        ModevizError: the problem does not offer that.
    """
    offers = sides(vehicle, problem)
    if name not in offers:
        raise ModevizError(unknown("trade-off", name, offers))
    return offers[name]


def prepare_trade_off(
    vehicle: Vehicle,
    problem: Problem,
    sides: tuple[Side, Side],
    rates: Rates,
    speed: float,
    locked: frozenset[tuple[str, str]] = frozenset(),
    placements: Placements | None = None,
) -> TradeOff:
    """Two goals out of one problem; arguments and errors as `prepare_search`.

    Raises:
        VehicleError: the goal has no points and directions to choose from, or none is left of one.
    """
    first, second = (
        prepare_search(vehicle, _restricted(vehicle, problem, side), rates, speed, locked, placements)
        for side in sides
    )
    names = sides[0].name, sides[1].name
    kept = {"windows": first.windows, "deflections": first.deflections}
    return TradeOff(names, (first, replace(second, space=first.space, **kept)))


def _restricted(vehicle: Vehicle, problem: Problem, side: Side) -> Problem:
    """The problem with performance variables of one side only."""
    if problem.goal not in (*VARIABLES, "rms"):
        raise VehicleError(
            f"problem {problem.name!r}: goal {problem.goal!r} has no points and directions to trade; "
            f"expected {', '.join(VARIABLES)} or rms"
        )
    performance = []
    for own in problem.performance:
        points = tuple(n for n in _points(vehicle, own) if n in (side.points or (n,)))
        directions = tuple(d for d in own.directions if d in (side.directions or (d,)))
        if points and directions:
            performance.append(replace(own, points=points, directions=directions))
    if not performance:
        raise VehicleError(f"problem {problem.name!r}: {side.name}: has no performance variables")
    return replace(problem, performance=tuple(performance))


def _points(vehicle: Vehicle, performance: Performance) -> tuple[str, ...]:
    """Names of the response points of performance variables."""
    return performance.points or tuple(point.name for point in vehicle.response_points)
