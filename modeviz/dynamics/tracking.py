"""Tracking of modes: which of one set of mount rates is which with another.

Modes are recognised by the modal assurance criterion weighted with mass, MAC = (φ_oldᵀ M φ_new)² of
mass-normalised shapes (R. J. Allemang, "The modal assurance criterion: twenty years of use and abuse",
2003). No rate changes M, so the shapes of either set are orthonormal in it and MACs are shares: those
of one shape in all modes of the other set sum to one, less what is above the band.

Only the two ends count, so an identity depends on no step and no way between them, and the other way
round it is the same. Modes that cross, or veer closely, go through each other; where a shape has
spread over several modes these share it, and the identity changes hands at equal shares.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from modeviz.dynamics.modes import RESOLVED_HZ, Modes
from modeviz.vehicle.arrays import Floats

MAJORITY = 0.5
"""More of a shape than this is in one mode at most, and of a mode from one shape at most."""

WEAK_MAC = 2 / 3
"""With less a shape may be as good as anywhere else: another mode may have half as much or more."""

EQUAL = 1e-6
"""Shares closer than this are equal, whatever rounding makes of them."""

REPEATED = 1e-6
"""Relative difference in frequency below which a mode has no shape of its own."""


@dataclass(frozen=True, eq=False)
class Track:
    """The place of each mode of one set of rates, the start, among those of another."""

    shares: Floats
    """(n_start, n_present), MAC: how much of each start's shape is in each present mode."""
    index: NDArray[np.intp]
    """(n_start,): which of the present modes each is; -1 if none is."""

    @property
    def mac(self) -> Floats:
        """MAC of each start's shape with the mode that it has become, (n_start,); zero if none."""
        mac, found = np.zeros(len(self.index)), np.flatnonzero(self.index >= 0)
        mac[found] = self.shares[found, self.index[found]]
        return mac

    @property
    def weak(self) -> NDArray[np.bool_]:
        """A mask of the modes whose shape others may share, or which are gone, (n_start,)."""
        return self.mac < WEAK_MAC

    def split(self, start: int, count: int = 3) -> list[tuple[int, float]]:
        """The present modes that have most of a start's shape, and how much."""
        return _largest(self.shares[start])[:count]

    def holders(self, start: int) -> list[tuple[int, float]]:
        """The present modes that may be called a start's, the likeliest first; none above the band."""
        return _leading(self.shares[start])

    def sources(self, present: int) -> list[tuple[int, float]]:
        """The start's modes that may be called a present one's, the likeliest first."""
        return _leading(self.shares[:, present])


def track_modes(momentum: Floats, start: Modes, present: Modes) -> Track:
    """Find each mode of one set of rates among those of another.

    Args:
        momentum: M φ of the start's shapes, (n_dofs, n_start).
        start: modes of a vehicle.
        present: modes of it with other rates.
    """
    rows, columns = _repeated(start.frequency_hz), _repeated(present.frequency_hz)
    products = _turned_to_each_other(momentum.T @ present.shapes, rows, columns)
    products = _turned_to_others(products, rows)
    shares = _turned_to_others(products.T, columns).T ** 2
    return Track(shares, _assigned(shares))


def likeliest(shares: Floats) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows and the columns they belong to, as many as there are of either.

    Majorities belong together; the others are assigned together, so that most of all shares is where
    it belongs. What is equal goes by the order.
    """
    n_rows, n_columns = shares.shape
    order = EQUAL * (np.arange(n_rows)[:, None] - np.arange(n_columns)) ** 2 / max(shares.shape)
    return linear_sum_assignment(order - shares - (shares > MAJORITY + EQUAL))


def _assigned(shares: Floats) -> NDArray[np.intp]:
    """The column that each row is, (n_rows,); -1 if none is leading by row and by column."""
    leads = _leads(shares) & _leads(shares.T).T
    rows, columns = likeliest(np.where(leads, shares, 0.0))
    index = np.full(len(shares), -1)
    index[rows] = np.where(leads[rows, columns], columns, -1)
    return index


def _leads(shares: Floats) -> NDArray[np.bool_]:
    """A mask of the shares that are at least half of their row's largest, (n_rows, n_columns).

    What is missing to one may be in a single mode outside and counts as that.
    """
    largest = np.maximum(shares.max(axis=1, initial=0.0), 1 - shares.sum(axis=1))
    return shares >= largest[:, None] / 2 - EQUAL


def _leading(shares: Floats) -> list[tuple[int, float]]:
    """The leading ones of a row of shares, the largest first."""
    leads = _leads(shares[None])[0]
    return [(i, share) for i, share in _largest(shares) if leads[i]]


def _largest(shares: Floats) -> list[tuple[int, float]]:
    """Places and shares, the largest first, equal ones by place."""
    first = np.argsort(-np.round(shares / EQUAL), kind="stable")
    return [(int(i), float(shares[i])) for i in first]


def _turned_to_each_other(products: Floats, rows: list[slice], columns: list[slice]) -> Floats:
    """φ_startᵀMφ_present, where repeated modes on both sides are the principal vectors of their spaces.

    Any mixture of repeated modes is as good as another; these do not depend on which the solver gave.

    Args:
        products: (n_start, n_present).
        rows: the sets of repeated modes of the start.
        columns: those of the present.
    """
    turned = products.copy()
    for r in rows:
        for c in columns:
            u, _, vt = np.linalg.svd(turned[r, c])
            turned[r] = u.T @ turned[r]
            turned[:, c] = turned[:, c] @ vt.T
    return turned


def _turned_to_others(products: Floats, rows: list[slice]) -> Floats:
    """The rows, each set of repeated ones turned as near to other shapes as can be.

    It is rotated within its own space onto as many of the others as it has members, those that lie in
    that space most (orthogonal Procrustes: P. H. Schönemann, 1966), and takes their order.
    """
    turned = products.copy()
    for members in rows:
        own = products[members]
        inside = [i for i, _ in _largest((own**2).sum(axis=0))[: len(own)]]
        target = np.zeros((len(own), len(own)))
        target[:, : len(inside)] = own[:, np.sort(np.array(inside, int))]
        u, _, vt = np.linalg.svd(target)
        turned[members] = (u @ vt).T @ own
    return turned


def _repeated(frequency_hz: Floats) -> list[slice]:
    """The runs of modes that are as good as at one frequency; what moves freely is one."""
    f = np.where(frequency_hz < RESOLVED_HZ, 0.0, frequency_hz)
    begins = np.flatnonzero(np.diff(f, prepend=-1.0) > REPEATED * f)
    return [slice(b, e) for b, e in pairwise([*begins, len(f)]) if e - b > 1]
