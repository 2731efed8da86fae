"""Which limits a design sits on, and what it would gain without them."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from modeviz.tuning.search import Search
from modeviz.vehicle.arrays import Floats

ACTIVE = 1e-6
"""A limit whose logarithm is this close is one that the design sits on."""

RELAXED = 0.1
"""The part by which a limit is moved to say what that would gain."""

LEAST = 1e-6
"""A multiplier below this, relative to the goal, gains nothing."""


@dataclass(frozen=True)
class ActiveConstraint:
    """A limit that a design sits on."""

    name: str
    """As people say it: "C2 fore-aft: lower ratio limit"."""
    multiplier: float
    """λ of the Lagrangian: the goal's loss for each unit that the limit's logarithm is moved."""
    gain: float
    """What relaxing the limit by 10 % would take off the goal, a part of it, to first order."""


def active_constraints(search: Search, x: Floats) -> tuple[ActiveConstraint, ...]:
    """The limits that a design sits on, those that cost most first.

    At a minimum the goal's derivatives are ∇F = -Aᵀλ, with the rows A of the limits it sits on and
    λ >= 0 (W. Karush, H. W. Kuhn and A. W. Tucker); λ is found by non-negative least squares, which for
    limits that depend on each other is one of several ways to share.
    """
    value, gradient = search.evaluate(x)
    names, rows = _met(search, x)
    if not names:
        return ()
    multipliers, _ = nnls(np.transpose(rows), -gradient)
    found = [
        ActiveConstraint(name, float(m), float(m * np.log(1 + RELAXED) / value) if value else 0.0)
        for name, m in zip(names, multipliers, strict=True)
    ]
    return tuple(sorted(found, key=lambda c: -c.multiplier))


def _met(search: Search, x: Floats) -> tuple[list[str], list[Floats]]:
    """The limits that a design sits on, and the row of each."""
    space = search.space
    on = np.flatnonzero(space.rows @ x - space.values > -ACTIVE)
    names = [space.limits[i].spoken for i in on]
    rows = list(space.rows[on])
    if search.windows is not None:
        margins, slopes = search.margins(x)
        ends = np.flatnonzero(margins < ACTIVE)
        names += [search.windows.spoken[i] for i in ends]
        rows += list(-slopes[ends])
    return names, rows
