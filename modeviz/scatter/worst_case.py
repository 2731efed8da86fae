"""The worst that parts within their tolerance can do together: each at one end of it."""

from dataclasses import dataclass

import numpy as np

from modeviz.optimise.goals import ResponseGoal
from modeviz.scatter.tolerance import Parts
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True, eq=False)
class WorstCase:
    """All parts at an end of their tolerance."""

    deviations: Floats
    """(n_deviations,), each -1 or 1, see `Parts`."""
    goal: float


def worst_corner(objective: ResponseGoal, parts: Parts, sampled: Floats) -> WorstCase:
    """The corner where the goal is largest, of those that a local search comes to.

    From the corner that the goal's derivatives point to with parts as drawn, and from the one next to a
    bad sample, one part after the other is moved to its other end as long as that makes the goal worse,
    the one that does most first. No single part can make the corner found any worse; two together
    might.

    Args:
        objective: whose value is the goal.
        parts: of the vehicle.
        sampled: (n_deviations,), the worst of some samples.

    Raises:
        SolveError: an undamped resonance on a frequency.
    """
    drawn = np.zeros(parts.n_deviations)
    _, slope = objective.of_springs(parts.stiffness(drawn), parts.slopes(drawn))
    ends = (_climb(objective, parts, np.where(d < 0, -1.0, 1.0)) for d in (slope, sampled))
    return max(ends, key=lambda corner: corner.goal)


def _climb(objective: ResponseGoal, parts: Parts, start: Floats) -> WorstCase:
    """The corner that moving single parts leads to."""
    corner = WorstCase(start, float(goals(objective, parts, start[None])[0]))
    while True:
        neighbours = corner.deviations * (1 - 2 * np.eye(parts.n_deviations))
        values = goals(objective, parts, neighbours)
        best = int(values.argmax())
        if not values[best] > corner.goal * (1 + 1e-12):
            return corner
        corner = WorstCase(neighbours[best], float(values[best]))


def goals(objective: ResponseGoal, parts: Parts, deviations: Floats) -> Floats:
    """The goal of vehicles of some deviations, (n,), at all of its frequencies."""
    return objective.totals(parts.stiffness(deviations))
