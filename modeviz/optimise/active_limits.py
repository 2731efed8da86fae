"""Which limits a design sits on, and what it would gain without them."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from modeviz.optimise.min_max import MinMax
from modeviz.optimise.search import Search
from modeviz.vehicle.arrays import Floats

ACTIVE = 1e-6
"""A limit whose logarithm is this close is one that the design sits on."""

RELAXED = 0.1
"""The part by which a limit is moved to say what that would gain."""


@dataclass(frozen=True)
class ActiveConstraint:
    """A limit that a design sits on."""

    name: str
    """As people say it: "C2 fore-aft: lower ratio limit"."""
    multiplier: float
    """λ of the Lagrangian: the goal's loss for each unit that the limit's logarithm is moved; of a
    place's bound, for each width of its bounds."""
    gain: float
    """What relaxing the limit by 10 %, of a place by 10 % of the width, would take off the goal, a part
    of it, to first order."""


def active_constraints(search: Search, x: Floats) -> tuple[ActiveConstraint, ...]:
    """The limits that a design sits on, those that cost most first.

    At a minimum the goal's derivatives are ∇F = -Aᵀλ, with the rows A of the limits it sits on and
    λ >= 0 (W. Karush, H. W. Kuhn and A. W. Tucker); λ is found by non-negative least parts, which for
    limits that depend on each other is one of several ways to share.
    """
    value, slopes = _slopes(search, x)
    names, rows, steps = _met(search, x)
    if not names:
        return ()
    # Of a min-max's largest parts the goal has a mean: as many more multipliers, whose sum is one.
    size = np.abs(slopes).max(initial=1.0)
    means = np.pad(slopes, ((0, 0), (0, 1)), constant_values=size)
    limits = np.pad(rows, ((0, 0), (0, 1)))
    wanted = np.append(np.zeros(len(x)), size)
    multipliers, _ = nnls(np.vstack([limits, means]).T, wanted)
    found = [
        ActiveConstraint(name, float(m), float(m * step / value) if value else 0.0)
        for name, m, step in zip(names, multipliers[: len(names)], steps, strict=True)
    ]
    return tuple(sorted(found, key=lambda c: -c.multiplier))


def _slopes(search: Search, x: Floats) -> tuple[float, Floats]:
    """The goal, and its derivatives, or those of all parts that are as large as a `MinMax`."""
    if not isinstance(search.goal, MinMax):
        value, gradient = search.evaluate(x)
        return value, gradient[None]
    parts, gradients = search.parts(x)
    largest = parts.max()
    return float(largest), gradients[parts >= largest * (1 - ACTIVE)]


def _met(search: Search, x: Floats) -> tuple[list[str], list[Floats], list[float]]:
    """The limits that a design sits on, the row of each, and by how much 10 % relax it."""
    space = search.space
    on = np.flatnonzero(space.rows @ x - space.values > -ACTIVE)
    names = [space.limits[i].spoken for i in on]
    rows, factor = list(space.rows[on]), float(np.log(1 + RELAXED))
    steps = [RELAXED if space.is_of_place(space.limits[i]) else factor for i in on]
    if search.kept:
        margins, slopes = search.margins(x)
        ends = np.flatnonzero(margins < ACTIVE)
        names += [search.kept_words[i] for i in ends]
        rows += list(-slopes[ends])
        steps += [factor] * len(ends)
    return names, rows, steps
