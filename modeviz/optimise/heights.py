"""How high curves are between fixed lines, of many vehicles at once."""

from dataclasses import dataclass

import numpy as np

from modeviz.optimise.objective import Criterion, Objective, Term
from modeviz.vehicle.arrays import Complexes, Floats

NO_POWER = np.finfo(np.float64).tiny
"""G²/Hz: stands for zero where it is divided by."""

LOWEST = 0.5
"""Of the depth at a line: below that a parabola has nothing to say."""


@dataclass(frozen=True, eq=False)
class BetweenLines(Criterion):
    """The largest w (a - target)² of each case at its lines and between them, and of all.

    Around the highest line the inverse of what a unit of input makes is a parabola, which it is of a
    resonance; the input's spectrum itself is a power law between lines. A case has the same weights at
    all lines.
    """

    def values(self, response: Complexes) -> Floats:
        heights = [
            _largest(term, self.frequency_hz[term.lines], self.power(term, response))
            for term in self.terms
        ]
        return np.stack(heights, axis=-1)

    def join(self, values: Floats) -> Floats:
        return values.max(axis=-1)


@dataclass(frozen=True, eq=False)
class HighestBetween(Objective):
    """The largest square of responses at given lines and between them."""

    @property
    def criterion(self) -> Criterion:
        return BetweenLines(self.driven.frequency_hz, self.terms)


def _largest(term: Term, f: Floats, power: Floats) -> Floats:
    """Return the largest of a case, (...,), from a² (..., n_lines, n_outputs)."""
    squares = term.squares(power)
    at_lines = squares.max(axis=(-2, -1))
    if len(f) < 3:
        return at_lines
    given = np.maximum(np.trace(term.input_psd, axis1=1, axis2=2).real, NO_POWER)
    middle = np.clip(squares.argmax(axis=-2), 1, len(f) - 2)[..., None, :]
    left, at, right = (
        (f[middle + side], given[middle + side] / np.maximum(_at(power, middle + side), NO_POWER))
        for side in (-1, 0, 1)
    )
    place, depth = _deepest(left, at, right)
    spectrum = np.exp(np.interp(np.log(place), np.log(f), np.log(given)))
    amplitude = np.sqrt(spectrum / depth)
    between = term.weights[0] * np.maximum(amplitude - term.target, 0.0) ** 2
    return np.maximum(at_lines, between.max(axis=(-2, -1)))


def _at(power: Floats, lines: np.ndarray) -> Floats:
    return np.take_along_axis(power, lines, axis=-2)


def _deepest(
    left: tuple[Floats, Floats], at: tuple[Floats, Floats], right: tuple[Floats, Floats]
) -> tuple[Floats, Floats]:
    """Return where the parabolas through three places and depths are lowest, and how low."""
    (x0, u0), (x1, u1), (x2, u2) = left, at, right
    slope = (u1 - u0) / (x1 - x0)
    bend = ((u2 - u1) / (x2 - x1) - slope) / (x2 - x0)
    down = np.divide(slope, 2 * bend, out=np.zeros_like(slope), where=bend > 0)
    place = np.where(bend > 0, np.clip((x0 + x1) / 2 - down, x0, x2), x1)
    depth = u0 + (place - x0) * (slope + bend * (place - x1))
    return place, np.maximum(depth, LOWEST * np.minimum(np.minimum(u0, u1), u2))
