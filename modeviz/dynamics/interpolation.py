"""Receptances at any frequency from those at lines: rational interpolation between these.

All receptances of a vehicle share their poles. So G(x) times (x - p) of the poles near x is a smooth
function of frequency, which a polynomial through the nearest lines gives. Lines a few widths of the
sharpest mode apart are enough, because the poles are known (J.-P. Berrut, H. D. Mittelmann, "Rational
interpolation through the optimal attachment of poles to the interpolating polynomial", Numerical
Algorithms 23, 2000).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from modeviz.dynamics.basis import EnrichedBasis
from modeviz.dynamics.inputs import directions
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.dynamics.poles import poles_near, ritz_poles
from modeviz.dynamics.reanalysis import Receptances
from modeviz.vehicle.arrays import Array, Complexes, Floats

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
        n_lines, n_nodes = len(self.known.frequency_hz), self._n_nodes
        first = np.searchsorted(self.known.frequency_hz, x.real) - n_nodes // 2
        first = np.clip(first, 0, n_lines - n_nodes)
        used = np.unique(first[:, None] + np.arange(n_nodes))
        wanted = self.known.part(used, springs, inputs)
        arrays = wanted.springs, wanted.outputs, wanted.inputs, wanted.direct
        sizes = [math.prod(a.shape[1:]) for a in arrays]
        flat = np.concatenate(
            [a.reshape(len(a), size) for a, size in zip(arrays, sizes, strict=True)], axis=1
        )
        found = _banded_product(self._weights(first, x), np.searchsorted(used, first), flat)
        ends = np.cumsum(sizes)[:-1]
        values = (
            part.reshape(len(x), *a.shape[1:])
            for part, a in zip(np.split(found, ends, axis=1), arrays, strict=True)
        )
        return Receptances(x, wanted.mount_stiffness, *values, law=wanted.law)

    @property
    def _n_nodes(self) -> int:
        return min(N_NODES, len(self.known.frequency_hz))

    def _weights(self, first: NDArray[np.intp], x: Array) -> Complexes:
        """The weights of values at even nodes, (n_x, n_nodes), from the first node on."""
        factors, poles, is_local = (a[first] for a in self._windows)
        nodes = self.known.frequency_hz[first[:, None] + np.arange(self._n_nodes)]
        away, step = x[:, None] - nodes, nodes[:, 1] - nodes[:, 0]
        on_node = away == 0
        away[on_node] = 1
        of_poles = np.where(is_local, x[:, None] - poles, 1).prod(axis=1)
        scale = (away / step[:, None]).prod(axis=1) * step / of_poles
        weights = factors * scale[:, None] / away
        is_known = on_node.any(axis=1)
        weights[is_known] = on_node[is_known]
        return weights

    @cached_property
    def _windows(self) -> tuple[Complexes, Complexes, NDArray[np.bool_]]:
        """The part of the weights that depends on the nodes alone, for each first node.

        Returns:
            Factors of the nodes, (n_windows, n_nodes); the poles nearest to their middle, (n_windows,
            n_poles), Hz; and which of these are near enough to count.
        """
        nodes = sliding_window_view(self.known.frequency_hz, self._n_nodes)
        middle, step = (nodes[:, :1] + nodes[:, -1:]) / 2, nodes[:, 1:2] - nodes[:, :1]
        distance = np.abs(middle - self.poles)
        n_poles = min(N_POLES, max(self._n_nodes - 4, 0), len(self.poles))
        nearest = np.argsort(distance, axis=1)[:, :n_poles]
        poles, is_local = self.poles[nearest], np.take_along_axis(distance, nearest, 1) < LOCAL * step
        away = np.where(is_local[:, None], nodes[:, :, None] - poles[:, None], 1)
        return away.prod(axis=2) * _lagrange(self._n_nodes), poles, is_local


def _banded_product(band: Complexes, first: NDArray[np.intp], values: Complexes) -> Complexes:
    """Sums of neighbouring values, (n, n_columns).

    Args:
        band: (n, n_neighbours), what each counts.
        first: (n,), rising: the first neighbour's number.
        values: (n_values, n_columns).
    """
    n_neighbours = band.shape[1]
    found = np.empty((len(band), values.shape[1]), complex)
    start = 0
    while start < len(band):
        end = int(np.searchsorted(first, first[start] + n_neighbours // 2))
        own = first[start:end] - first[start]
        weights = np.zeros((len(own), own[-1] + n_neighbours), complex)
        weights[np.arange(len(own))[:, None], own[:, None] + np.arange(n_neighbours)] = band[start:end]
        found[start:end] = weights @ values[first[start] : first[start] + weights.shape[1]]
        start = end
    return found


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
    """Prepare receptances to be known between their lines.

    Args:
        known: the receptances.
        basis: holds the modes at their mount rates.
        rows: of the outputs (n_outputs, n_dofs) and the inputs (n_inputs, n_dofs), or wider; a motion
            that rigid joints are given is no direction to find poles in.
        along: their values at complex frequencies, see `poles_near`; directions are those of the
            mount springs, the outputs and the inputs.
    """
    f = known.frequency_hz
    reach = LOCAL * (f[-1] - f[0]) / max(len(f) - 1, 1)
    poles, shapes = ritz_poles(basis, known.mount_stiffness)
    is_free = np.abs(poles) < RESOLVED_HZ
    is_near = (np.abs(poles.imag) < reach) & (f[0] - reach < poles.real) & (poles.real < f[-1] + reach)
    wanted = is_near & ~is_free
    system = basis.system
    along_coordinates = directions(system, system.mount_motions, *rows)[:, : system.n_dofs]
    motions = along_coordinates @ shapes[:, wanted]
    found = poles_near(poles[wanted], motions.T, along)
    return Between(known, np.concatenate([np.zeros(2 if is_free.any() else 0, complex), found]))


def modified_between(
    between: Between, stiffness: Complexes, basis: EnrichedBasis, rows: tuple[Floats, Floats]
) -> Between:
    """Receptances between their lines at other mount rates; rows as of `prepare_between`.

    Args:
        between: at the present mount rates.
        stiffness: (n_springs,), complex, N/m, the other ones.
        basis: holds the modes at these.
        rows: of the outputs and the inputs.

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
