"""Responses at all lines from those at a few, by an interpolation made from samples.

When mount rates change a little, the responses at hundreds of frequencies stay close to a space of few
dimensions, for they share their poles. So responses at a few well-chosen frequencies tell all others:
an interpolative decomposition of sampled responses chooses them and gives the matrix (H. Cheng,
Z. Gimbutas, P. G. Martinsson, V. Rokhlin, "On the compression of low rank matrices", SIAM Journal on
Scientific Computing 26(4), 2005; in model reduction: M. Barrault, Y. Maday, N. C. Nguyen, A. T. Patera,
"An empirical interpolation method", Comptes Rendus Mathématique 339(9), 2004).
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from modeviz.dynamics.galerkin import Reduced
from modeviz.dynamics.reanalysis import Receptances
from modeviz.vehicle.arrays import Complexes

TOLERANCE = 3e-5
"""What the frequencies left out may add to the sampled responses, relative to what they have."""


ROUNDING = 1e-8
"""Changes of the sampled responses below this, relative to what they are, are taken for those of
arithmetic, which is right to some 1e-10."""


@dataclass(frozen=True, eq=False)
class FewLines:
    """Receptances at a few frequencies, and what they tell about all."""

    lines: NDArray[np.intp]
    """(n_lines,): the numbers of the few frequencies."""
    receptances: Receptances | Reduced
    """At these."""
    matrix: Complexes
    """(n_freqs, n_lines): the response at every frequency per response at the few."""
    offset: Complexes
    """(n_freqs, n_outputs, n_inputs): added to that."""

    def responses(self, stiffness: Complexes) -> Complexes:
        """The responses at many sets of mount rates, close to those it was taught with.

        Args:
            stiffness: (n_sets, n_springs), complex rates, N/m.

        Returns:
            (n_sets, n_freqs, n_outputs, n_inputs).

        Raises:
            SolveError: with rates of a set an undamped resonance lies on one of the few frequencies.
        """
        H = self.receptances.responses(stiffness)
        every = self.matrix @ H.reshape(*H.shape[:2], self.offset[0].size)
        return self.offset + every.reshape(len(H), *self.offset.shape)


def few_lines(receptances: Receptances, stiffness: Complexes) -> FewLines:
    """Choose as many frequencies as sampled responses need.

    Args:
        receptances: at all frequencies.
        stiffness: (n_sets, n_springs), complex rates to learn from, N/m, the first in their midst.

    Raises:
        SolveError: with rates of a set an undamped resonance lies on a frequency.
    """
    middle, *others = receptances.responses(stiffness)
    size = np.linalg.norm(middle, axis=(1, 2))
    scale = np.divide(1, size, out=np.ones_like(size), where=size > 0)
    changes = (np.array(others) - middle) * scale[:, None, None]
    samples = changes.transpose(0, 2, 3, 1).reshape(-1, len(size))
    lines, between = _interpolation(samples)
    matrix = between * scale[lines] / scale[:, None]
    offset = middle - np.tensordot(matrix, middle[lines], 1)
    return FewLines(lines, receptances.at(lines), matrix, offset)


def _interpolation(samples: Complexes) -> tuple[NDArray[np.intp], Complexes]:
    """Some columns, rising, and the matrix (n_columns, n_some) that gives all columns from them."""
    factors = scipy.linalg.qr(samples, mode="r", pivoting=True, check_finite=False)
    R, order = np.asarray(factors[0]), np.asarray(factors[-1], np.intp)
    size = np.abs(np.diag(R))
    rank = max(1, int(np.count_nonzero(size > max(TOLERANCE * size[0], ROUNDING))))
    coefficients = np.zeros((samples.shape[1], rank), complex)
    coefficients[order[:rank]] = np.eye(rank)
    if size[0] > ROUNDING:  # else nothing changes, and any one column gives all
        coefficients[order[rank:]] = np.linalg.solve(R[:rank, :rank], R[:rank, rank:]).T
    rising = np.argsort(order[:rank])
    return order[:rank][rising], coefficients[:, rising]
