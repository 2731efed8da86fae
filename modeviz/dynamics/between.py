"""Receptances at any frequency from those at lines: rational interpolation between these.

All receptances of a vehicle share their poles. So G(x) times (x - p) of the poles near x is a smooth
function of frequency, which a polynomial through the nearest lines gives. Lines a few widths of the
sharpest mode apart are enough, because the poles are known (J.-P. Berrut, H. D. Mittelmann, "Rational
interpolation through the optimal attachment of poles to the interpolating polynomial", Numerical
Algorithms 23, 2000).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.basis import EnrichedBasis
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.dynamics.poles import poles_near, ritz_poles
from modeviz.dynamics.reanalysis import Receptances
from modeviz.vehicle.arrays import Complexes, Floats

N_NODES = 16
"""Lines through which a polynomial goes."""

N_POLES = 10
"""The most poles that are taken out at once."""

LOCAL = 14.0
"""Distances of lines within which a pole is near."""


@dataclass(frozen=True, eq=False)
class Between:
    """Receptances at lines, and the poles with which they are known between these."""

    known: Receptances
    poles: Complexes
    """(n_poles,), Hz: those near the lines."""

    @property
    def n_bytes(self) -> int:
        """The memory that the arrays take."""
        return self.known.n_bytes + self.poles.nbytes

    def at(
        self,
        frequency_hz: Floats | Complexes,
        springs: NDArray[np.intp] | None = None,
        inputs: NDArray[np.intp] | None = None,
    ) -> Receptances:
        """The receptances at other frequencies within the lines.

        Args:
            frequency_hz: (n_freqs,), rising; complex ones are close to the real axis.
            springs: which are wanted, all if None.
            inputs: which are wanted, all if None.
        """
        x: Any = np.asarray(frequency_hz)
        lines = self.known.frequency_hz
        n_nodes = min(N_NODES, len(lines))
        first = np.searchsorted(lines, x.real) - n_nodes // 2
        first = np.clip(first, 0, len(lines) - n_nodes)
        used = np.unique(first[:, None] + np.arange(n_nodes))
        first = np.searchsorted(used, first)
        wanted = self.known.part(used, springs, inputs)
        arrays = wanted.springs, wanted.outputs, wanted.inputs, wanted.direct
        flat = np.concatenate([a.reshape(len(a), -1) for a in arrays], axis=1)
        nodes = wanted.frequency_hz[first[:, None] + np.arange(n_nodes)]
        weights = self._weights(nodes, x)
        found = np.empty((len(x), flat.shape[1]), complex)
        starts, places = np.unique(first, return_index=True)
        for start, own in zip(starts.tolist(), pairwise([*places.tolist(), len(x)]), strict=True):
            found[slice(*own)] = weights[slice(*own)] @ flat[start : start + n_nodes]
        ends = np.cumsum([a[0].size for a in arrays])[:-1]
        values = (
            part.reshape(len(x), *a.shape[1:])
            for part, a in zip(np.split(found, ends, axis=1), arrays, strict=True)
        )
        return Receptances(x, wanted.mount_stiffness, *values)

    def _weights(self, nodes: Floats, x: NDArray) -> Complexes:
        """What values at even nodes count, (n_x, n_nodes), by the poles near the nodes' middle."""
        n_nodes = nodes.shape[1]
        middle, step = (nodes[:, :1] + nodes[:, -1:]) / 2, nodes[:, 1:2] - nodes[:, :1]
        distance = np.abs(middle - self.poles)
        n_poles = min(N_POLES, max(n_nodes - 4, 0), len(self.poles))
        nearest = np.argsort(distance, axis=1)[:, :n_poles]
        is_local = np.take_along_axis(distance, nearest, 1) < LOCAL * step
        poles = self.poles[nearest]
        with_poles = np.where(is_local[:, None], nodes[:, :, None] - poles[:, None], 1).prod(axis=2)
        with_poles /= np.where(is_local, x[:, None] - poles, 1).prod(axis=1)[:, None]
        away = x[:, None] - nodes
        on_node = away == 0
        away[on_node] = 1
        weights = with_poles * _lagrange(n_nodes) / away
        weights *= (away / step).prod(axis=1)[:, None] * step
        weights[on_node.any(axis=1)] = on_node[on_node.any(axis=1)]
        return weights


@lru_cache(maxsize=N_NODES)
def _lagrange(n_nodes: int) -> Floats:
    """1/∏(i - j) over all other j of equidistant nodes, (n_nodes,)."""
    apart = np.subtract.outer(np.arange(n_nodes), np.arange(n_nodes)).astype(float)
    np.fill_diagonal(apart, 1)
    return 1 / apart.prod(axis=1)


def prepare_between(
    known: Receptances,
    basis: EnrichedBasis,
    rows: tuple[Floats, Floats],
    along: Callable[[Complexes, Complexes], Complexes],
) -> Between:
    """What is needed to know receptances between their lines.

    Args:
        known: the receptances.
        basis: holds the modes at their mount rates.
        rows: of the outputs (n_outputs, n_dofs) and the inputs (n_inputs, n_dofs).
        along: their values at complex frequencies, see `poles_near`; directions are those of the
            mount springs, the outputs and the inputs.
    """
    f = known.frequency_hz
    reach = LOCAL * (f[-1] - f[0]) / max(len(f) - 1, 1)
    poles, shapes = ritz_poles(basis, known.mount_stiffness)
    is_free = np.abs(poles) < RESOLVED_HZ
    is_near = (np.abs(poles.imag) < reach) & (f[0] - reach < poles.real) & (poles.real < f[-1] + reach)
    wanted = is_near & ~is_free
    motions = np.vstack([basis.system.mount_motions, *rows]) @ shapes[:, wanted]
    found = poles_near(poles[wanted], motions.T, along)
    return Between(known, np.concatenate([np.zeros(2 if is_free.any() else 0, complex), found]))


def modified_between(
    between: Between, stiffness: Complexes, basis: EnrichedBasis, rows: tuple[Floats, Floats]
) -> Between:
    """The same at other mount rates, (n_springs,), complex, N/m; rows as of `prepare_between`.

    Raises:
        SolveError: with these rates an undamped resonance lies on a line.
    """

    def along(frequency_hz: Complexes, directions: Complexes) -> Complexes:
        order = np.argsort(frequency_hz.real)
        G = between.at(frequency_hz[order]).modified(stiffness, pole=np.inf)
        n_springs, n_outputs = G.outputs.shape[1:]
        s, o, i = np.split(directions[order], [n_springs, n_springs + n_outputs], axis=1)
        values = np.empty(len(order), complex)
        values[order] = (
            _between(s, G.springs, s)
            + 2 * _between(s, G.outputs, o)
            + 2 * _between(s, G.inputs, i)
            + 2 * _between(o, G.direct, i)
        )
        return values

    return prepare_between(between.known.modified(stiffness), basis, rows, along)


def _between(left: Complexes, matrices: Complexes, right: Complexes) -> Complexes:
    """leftᵀ A right of each, (n,)."""
    return np.einsum("ni,nij,nj->n", left, matrices, right)
