"""Guyan reduction: a body in the motions of a few of its nodes.

The truck doesn't use it: its full eigenproblems take seconds, and Guyan's frequencies are too high by
an amount nobody knows beforehand. It is for models that come with master degrees of freedom.
"""

from dataclasses import dataclass

import numpy as np

from modeviz.errors import SolveError
from modeviz.fem.free import N_RIGID, factorised
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions

CLEARLY = 0.3
"""How much of a motion must be new for it to count as independent."""


@dataclass(frozen=True, eq=False)
class ReducedMatrices:
    """Dense matrices in the master degrees of freedom."""

    masters: np.ndarray
    """(n_masters,), their indices in the full model."""
    mass: Floats
    """(n_masters, n_masters)."""
    stiffness: Floats
    """(n_masters, n_masters)."""
    transformation: Floats
    """T (n_dofs, n_masters): the full motion when the masters move slowly."""


def guyan_reduction(matrices: Matrices, masters: np.ndarray) -> ReducedMatrices:
    """The body condensed to its masters m; the rest s follows them as in statics.

    T = [I; -K_ss⁻¹ K_sm], K_r = Tᵀ K T, M_r = Tᵀ M T (R. J. Guyan, 1965). Exact for forces on masters
    at zero frequency; frequencies are upper bounds.

    Args:
        matrices: of the body.
        masters: (n_masters,), indices of degrees of freedom, 6 node + (0 to 5 for x to rz).

    Raises:
        SolveError: an index is repeated or does not exist, or the masters don't hold the body.
    """
    masters = np.asarray(masters, int)
    possible = np.arange(matrices.n_dofs)
    if len(np.unique(masters)) != len(masters) or not np.isin(masters, possible).all():
        raise SolveError(
            f"masters: found {masters.tolist()}, expected different indices from 0 to "
            f"{matrices.n_dofs - 1}"
        )
    R = _scaled_rigid_motions(matrices)
    if np.linalg.matrix_rank(R[masters]) < N_RIGID:
        raise SolveError(
            f"masters: the {len(masters)} found don't hold the body, expected some that show every "
            "rigid motion"
        )
    slaves = np.setdiff1d(possible, masters)
    K = matrices.stiffness
    T = np.zeros((matrices.n_dofs, len(masters)))
    T[masters, np.arange(len(masters))] = 1.0
    T[slaves] = -factorised(K[slaves][:, slaves]).solve(K[slaves][:, masters].toarray())
    return ReducedMatrices(masters, T.T @ (matrices.mass @ T), T.T @ (K @ T), T)


def lowest_ratio_masters(matrices: Matrices, n_masters: int) -> np.ndarray:
    """The degrees of freedom with the smallest ratio of stiffness to mass, (n_masters,), rising.

    They are the ones whose inertia the slow motions feel: held alone, each would have the frequency
    √(K_ii / M_ii), and the low ones must not be left to follow statically. Six of them, the lowest
    that can, hold the body: on a sheet all others may move across it.
    """
    mass, stiffness = matrices.mass.diagonal(), matrices.stiffness.diagonal()
    ratio = np.full(matrices.n_dofs, np.inf)
    np.divide(stiffness, mass, out=ratio, where=mass > 0)
    by_ratio = np.argsort(ratio, kind="stable")
    holding = _holding(_scaled_rigid_motions(matrices), by_ratio)
    others = by_ratio[~np.isin(by_ratio, holding)]
    return np.sort(np.r_[holding, others][:n_masters])


def _holding(rigid: Floats, candidates: np.ndarray) -> np.ndarray:
    """The first candidates that show six clearly independent rigid motions."""
    holding, shown = [], np.zeros((0, N_RIGID))
    for dof in candidates:
        new = rigid[dof] - shown.T @ (shown @ rigid[dof])
        if np.linalg.norm(new) > CLEARLY * np.linalg.norm(rigid[dof]):
            holding.append(dof)
            shown = np.vstack([shown, new / np.linalg.norm(new)])
        if len(holding) == N_RIGID:
            break
    return np.array(holding, int)


def _scaled_rigid_motions(matrices: Matrices) -> Floats:
    """Rigid motions about the middle, rotations counted as displacements at the body's size."""
    arms = matrices.nodes - matrices.nodes.mean(axis=0)
    size = np.linalg.norm(arms, axis=1).mean()
    return rigid_motions(arms / size).reshape(-1, N_RIGID)
