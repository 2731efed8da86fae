"""Where curves are highest: from lines to the summits between them."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Floats

ROUNDS = 4
"""Parabolas on the way to a summit."""

CLOSER = 0.1
"""The width of each of them by that of the one before; errors fall with its square."""

Indices = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class Brackets:
    """Pieces of curves between two lines in which a summit may be."""

    part: Indices
    """(n,): of which cell and curve."""
    low: Floats
    high: Floats
    """(n,), Hz."""


def highest_lines(squares: Floats, edges: Indices) -> Indices:
    """The number of the line at which each curve is highest within each cell, (n_cells, n_curves).

    Args:
        squares: (n_lines, n_curves).
        edges: the lines (n_cells + 1,) at which cells end; a single one is a cell of its own.
    """
    if len(edges) == 1:
        return np.full((1, squares.shape[1]), edges[0])
    ends = pairwise(edges.tolist())
    return np.array([low + squares[low : high + 1].argmax(axis=0) for low, high in ends], np.intp)


def brackets(
    frequency_hz: Floats,
    squares: Floats,
    edges: Indices,
    bends: NDArray[np.bool_],
    highest: Indices,
    least: float,
) -> Brackets:
    """Return where the summits are that a curve's highest lines are beside.

    Args:
        frequency_hz: (n_lines,), rising.
        squares: (n_lines, n_curves).
        edges: as of `highest_lines`.
        bends: (n_lines,): where curves are not smooth.
        highest: as `highest_lines` gives.
        least: what is below is left out.
    """
    beyond = np.pad(squares, ((1, 1), (0, 0)), constant_values=-np.inf)
    is_top = (squares >= beyond[:-2]) & (squares >= beyond[2:])
    is_top &= squares >= least
    cell, curve = np.nonzero(np.take_along_axis(is_top, highest, axis=0))
    line, part = highest[cell, curve], cell * squares.shape[1] + curve
    before = np.maximum(line - 1, edges[cell])
    after = np.minimum(line + 1, edges[np.minimum(cell + 1, len(edges) - 1)])
    is_split = bends[line] & (before < line) & (line < after)
    low = np.concatenate([before, line[is_split]])
    high = np.concatenate([np.where(is_split, line, after), after[is_split]])
    part, is_wide = np.concatenate([part, part[is_split]]), low < high
    return Brackets(part[is_wide], frequency_hz[low[is_wide]], frequency_hz[high[is_wide]])


def summits(low: Floats, high: Floats, depth: Callable[[Floats], Floats]) -> tuple[Floats, Floats]:
    """The frequencies of summits, and depths there, (n,) both.

    By parabolas through three places each, closer and closer. Depths are what is smallest on a summit:
    1/S there, which for a resonance is a parabola itself.

    Args:
        low: (n,), Hz.
        high: (n,): each summit is between these.
        depth: of places (n, 3).
    """
    if not len(low):
        return low, high
    place, reach = (low + high) / 2, (high - low) / 2
    reached = np.full(len(low), np.inf)
    for _ in range(ROUNDS):
        middle = np.clip(place, low + reach, high - reach)
        left, at, right = depth(middle[:, None] + reach[:, None] * np.array([-1.0, 0.0, 1.0])).T
        bend, slope = left - 2 * at + right, (left - right) / 2
        step = np.divide(slope, bend, out=np.sign(slope), where=bend > 0)
        place, reached = np.clip(middle + step * reach, low, high), at
        reach = CLOSER * reach
    return place, reached
