"""Spectra of loads averaged around lines, so that sums over lines hold what tables say between them.

Lines resolve a response H(f); they do not resolve a road met slowly, nor a spike or a notch of a
force's table. So in ∫ |H|² S df it is |H|² f'(t) that is interpolated between lines, by the polynomials
of `ride.integration`, and S is integrated against these as it is (product integration: P. J. Davis,
P. Rabinowitz, "Methods of Numerical Integration", 2nd ed., 1984, section 2.5.6). What each line counts
then, over what it counts of a flat spectrum, is the average that stands for S there.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from modeviz.ride.excitation import Load, input_spectrum, table_hz
from modeviz.ride.integration import N_CELL, integration_weights, is_graded, line_distances
from modeviz.vehicle.arrays import Complexes, Floats

GAUSS = np.polynomial.legendre.leggauss(4)
"""Places between two values of a table or lines, and weights, from -1 to 1."""

N_STEPS = 3
"""Of Newton's method, to find where in its cell a frequency is."""


def averaged_spectrum(load: Load, lines: Floats, speed: float) -> Complexes:
    """The spectrum of a load's inputs around lines, (n_lines, n_inputs, n_inputs).

    Beside a narrow spike it may be negative: polynomials swing.

    Args:
        load: whose table holds all lines; a harmonic load has one that is flat.
        lines: (n_lines,), Hz, rising.
        speed: on a road, m/s.

    Raises:
        ModevizError: as `input_spectrum`.
    """
    if not table_hz(load, speed).size or len(lines) < 2:
        return input_spectrum(load, lines, speed)
    x, weights = _places(table_hz(load, speed), lines)
    cell = np.clip(np.searchsorted(lines, x, "right") - 1, 0, len(lines) - 2)
    graded = is_graded(lines)
    shares, per_t = _graded(lines, x, cell) if graded else _linear(lines, x, cell)
    S = input_spectrum(load, x, speed) * (weights / per_t)[:, None, None]
    starts = np.searchsorted(cell, np.arange(len(lines) - 1))
    by_cell = np.add.reduceat(shares[:, :, None, None] * S[:, None], starts, axis=0)
    sums = np.zeros((len(lines), *S.shape[1:]), complex)
    np.add.at(sums, _first(len(lines), shares.shape[1])[:, None] + np.arange(shares.shape[1]), by_cell)
    counts = integration_weights(lines, (lines[0], lines[-1]))
    if graded:
        sums *= line_distances(lines)[:, None, None]
    return (sums / counts[:, None, None]).astype(complex)


def _places(table: Floats, lines: Floats) -> tuple[Floats, Floats]:
    """Places between the values of a table and lines, rising, and Gauss's weights, (n,) each, Hz."""
    inside = table[(table > lines[0]) & (table < lines[-1])]
    ends = np.union1d(lines, inside)
    nodes, weights = GAUSS
    middle, half = (ends[1:] + ends[:-1]) / 2, np.diff(ends) / 2
    return (middle[:, None] + half[:, None] * nodes).ravel(), (half[:, None] * weights).ravel()


def _linear(lines: Floats, x: Floats, cell: NDArray[np.intp]) -> tuple[Floats, Floats]:
    """The shares (n, 2) of a cell's lines in what is between them, on a polygon; and one."""
    t = (x - lines[cell]) / np.diff(lines)[cell]
    return np.column_stack([1 - t, t]), np.ones(len(x))


def _graded(lines: Floats, x: Floats, cell: NDArray[np.intp]) -> tuple[Floats, Floats]:
    """The shares (n, N_CELL) of the lines around in what is between two, and f'(t) there, (n,)."""
    slope = line_distances(lines)
    f0, rise = lines[cell], np.diff(lines)[cell]
    p, q = slope[cell], slope[cell + 1]
    c, d = 3 * rise - 2 * p - q, p + q - 2 * rise
    t = (x - f0) / rise
    for _ in range(N_STEPS):
        t -= (f0 + t * (p + t * (c + t * d)) - x) / (p + t * (2 * c + 3 * t * d))
    offset = cell - _first(len(lines), N_CELL)[cell]
    powers = t[:, None] ** np.arange(N_CELL)
    shares = np.empty((len(x), N_CELL))
    for each in np.unique(offset).tolist():
        own = offset == each
        shares[own] = powers[own] @ _cardinals(each)
    return shares, p + t * (2 * c + 3 * t * d)


def _first(n_lines: int, n_around: int) -> NDArray[np.intp]:
    """The first of the lines that tell what is in each cell, (n_lines - 1,)."""
    return np.clip(np.arange(n_lines - 1) - n_around // 2 + 1, 0, n_lines - n_around)


@lru_cache(maxsize=N_CELL)
def _cardinals(offset: int) -> Floats:
    """Coefficients (N_CELL powers of t, N_CELL lines) of Lagrange's polynomials, t from one of them."""
    nodes = np.arange(N_CELL, dtype=float) - offset
    return np.asarray(np.linalg.inv(nodes[:, None] ** np.arange(N_CELL)), np.float64)
