"""The order in which a large stiffness is factorised: nested dissection by the places of its nodes.

A set of nodes is cut in two across its longest side, and the nodes of one half that touch the other
come last (A. George, 1973). Of solids minimum degree, which SuperLU has, fills 1.6 times as much and
takes three times as long at 60 000 degrees of freedom, and more with more; of shells both are alike.
"""

import numpy as np
import scipy.sparse as sp

from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats

LARGE = 20_000
"""Degrees of freedom from which on this order is better than minimum degree."""

LEAF = 60
"""Sets of so few nodes are not cut."""


def elimination_order(matrices: Matrices) -> np.ndarray | None:
    """Return the order in which to eliminate degrees of freedom, (n_dofs,); None: as small ones are.

    Those of a node stand together; those that move none come last.
    """
    if matrices.n_dofs < LARGE or not sp.issparse(matrices.motion):
        return None
    n_nodes = len(matrices.nodes)
    owner = np.where(matrices.owners < 0, n_nodes, matrices.owners)
    entries = sp.coo_array(abs(matrices.stiffness) + abs(matrices.mass))
    rows, others = (owner[places] for places in entries.coords)
    inside = (rows < n_nodes) & (others < n_nodes) & (rows != others)
    pairs = np.ones(int(inside.sum()), bool), (rows[inside], others[inside])
    joined = sp.csr_array(sp.coo_array(pairs, shape=(n_nodes, n_nodes)))
    rank = np.full(n_nodes + 1, n_nodes)
    rank[dissected(matrices.nodes, joined)] = np.arange(n_nodes)
    return np.argsort(rank[owner], kind="stable")


def dissected(nodes: Floats, joined: sp.csr_array) -> np.ndarray:
    """Return an order of nodes in which what joins them is factorised with little fill, (n_nodes,).

    Args:
        nodes: (n_nodes, 3), their places.
        joined: (n_nodes, n_nodes), non-zero where two act on each other.
    """
    other = np.zeros(len(nodes), bool)
    waiting, last_first = [np.arange(len(nodes))], []
    while waiting:
        part = waiting.pop()
        if len(part) <= LEAF:
            last_first.append(part)
            continue
        left, right = _halves(nodes, part)
        other[right] = True
        touches = _touches(joined, left, other)
        other[right] = False
        last_first.append(left[touches])
        waiting += [left[~touches], right]
    return np.concatenate(last_first)[::-1]


def _halves(nodes: Floats, part: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    places = nodes[part]
    along = places[:, np.ptp(places, axis=0).argmax()]
    by_place = np.argsort(along, kind="stable")
    middle = len(part) // 2
    return part[by_place[:middle]], part[by_place[middle:]]


def _touches(joined: sp.csr_array, part: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Whether each node of a part is joined to one of the others."""
    starts, ends = joined.indptr[part], joined.indptr[part + 1]
    before = np.cumsum(ends - starts) - (ends - starts)
    entries = np.repeat(starts - before, ends - starts) + np.arange((ends - starts).sum())
    touching = np.repeat(np.arange(len(part)), ends - starts)[other[joined.indices[entries]]]
    return np.bincount(touching, minlength=len(part)) > 0
