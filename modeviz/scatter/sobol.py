"""Which parts make the spread: shares of a variance."""

from dataclasses import dataclass

import numpy as np

from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Floats

DEGREE = 2
"""Of the polynomials of each deviation."""

LEAST_PER_TERM = 4
"""Samples for every coefficient that is fitted; with fewer the noise is taken for spread."""

NOTHING = 1e-9
"""A range of values, relative to these, that is rounding."""


@dataclass(frozen=True, eq=False)
class Spread:
    """How a variance is shared."""

    shares: Floats
    """(n_deviations,): what each deviation makes by itself, Sobol's first-order index."""
    rest: float
    """What several make together, and what higher powers do: one less all shares."""


def spread(deviations: Floats, values: Floats) -> Spread:
    """The variance shares of independent deviations, each evenly spread over -1 to 1.

    A sum of Legendre polynomials P_1 and P_2 of each deviation is fitted by least squares. They are
    orthogonal with a mean square of 1/(2k + 1), so that each deviation's part of the variance is
    Σ_k c_k²/(2k + 1), and that of the residuals is the rest (B. Sudret, "Global sensitivity analysis
    using polynomial chaos expansions", Reliability Engineering and System Safety 93(7), 2008).

    Args:
        deviations: (n_samples, n_deviations).
        values: (n_samples,).

    Raises:
        SolveError: too few samples for that.
    """
    n_samples, n_deviations = deviations.shape
    least = LEAST_PER_TERM * (1 + DEGREE * n_deviations)
    if n_samples < least:
        raise SolveError(f"shares of the spread: found {n_samples} samples, expected {least} or more")
    if np.ptp(values) <= NOTHING * np.abs(values).max():
        return Spread(np.zeros(n_deviations), 0.0)
    every = np.polynomial.legendre.legvander(deviations, DEGREE)[..., 1:]
    terms = np.hstack([np.ones((n_samples, 1)), every.reshape(n_samples, -1)])
    coefficients, *_ = np.linalg.lstsq(terms, values, rcond=None)
    squares = coefficients[1:].reshape(n_deviations, DEGREE) ** 2
    parts = squares @ (1 / (2 * np.arange(1, DEGREE + 1) + 1))
    rest = np.mean((values - terms @ coefficients) ** 2)
    variance = parts.sum() + rest
    return Spread(parts / variance, float(rest / variance))
