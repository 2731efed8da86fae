"""The found design held against the full model as given before it is called a result."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from modeviz.dynamics.truncation_gap import TruncationGap, gap_if_solved
from modeviz.errors import SolveError
from modeviz.optimise.search import Search
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True, eq=False)
class Verification:
    """What the full model as given says of a design, and what it cannot know."""

    value: float
    """The goal from its equations of motion; NaN if they cannot be solved exactly enough."""
    difference: float
    """Of the goal that the search found, relative to that."""
    frequency_hz: Floats
    """(n_windows,): where its eigenproblem has the mode of each window."""
    are_kept: bool
    """Whether all of these are where the windows want them, and mounts give no more than they may."""
    impossible: str = ""
    """Why its equations cannot be solved exactly enough, if they cannot."""
    gap: TruncationGap | None = None
    """How much too high frequencies are with its rates, as bodies lack residual compliance; None if
    none lacks it. Of this the model as given knows nothing."""
    deflection: Floats = field(default_factory=lambda: np.zeros(0))
    """(n_limits,), m: of the mounts whose deflections are limited."""


def verify(searches: Sequence[Search], x: Floats, values: Sequence[float]) -> Verification:
    """Return what the full model says of a design: no receptances, no reduced basis.

    Args:
        searches: what was sought, in one space and within the same windows.
        x: (n_variables,), the design.
        values: its goals, as the searches found them; said is of that which differs most.
    """
    search = searches[0]
    rates, there = search.space.rates(x), search.at(x)
    frequency_hz, are_kept = np.zeros(0), True
    if there.windows is not None:
        frequency_hz = there.windows.exact_frequencies(rates)
        pairs = zip(there.windows.windows, frequency_hz.tolist(), strict=True)
        are_kept = all(window.allows(f) for window, f in pairs)
    deflection = np.zeros(0)
    if there.deflections is not None:
        deflection = there.deflections.exact(rates)
        gives = zip(there.deflections.limits, deflection.tolist(), strict=True)
        are_kept = all(limit.allows(d) for limit, d in gives) and are_kept
    gap = gap_if_solved(search.space.built(x))
    try:
        exact = [search.exact_value(x) for search in searches]
    except SolveError as error:
        return Verification(np.nan, np.nan, frequency_hz, are_kept, str(error), gap, deflection)
    differences = [_relative(value, own) for value, own in zip(values, exact, strict=True)]
    worst = int(np.argmax(differences))
    return Verification(
        exact[worst], differences[worst], frequency_hz, are_kept, gap=gap, deflection=deflection
    )


def _relative(found: float, exact: float) -> float:
    if found == exact:
        return 0.0
    return abs(found - exact) / abs(exact) if exact else np.inf
