"""Free bodies: their rigid and normal modes, and how static loads deform them."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
import scipy.sparse.linalg as spl

from modeviz.errors import SolveError
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions

SHIFT = 40.0
"""rad²/s², (1 Hz)²: what shift-invert adds to ω² so that rigid motion has stiffness."""

MECHANISM_HZ = 0.01
"""Below this a seventh mode is not elastic: the mesh has a loose part."""

ROUNDING = 1e-9
"""Of a response, what solving and projecting may leave where nothing is left."""

N_RIGID = 6


@dataclass(frozen=True, eq=False)
class ModalBasis:
    """Vectors that are orthonormal in mass and orthogonal in stiffness."""

    omega_n_squared: Floats
    """(n_modes,), rad²/s², the stiffness of each."""
    shapes: Floats
    """(n_dofs, n_modes), columns are modes."""


def rigid_modes(matrices: Matrices) -> Floats:
    """Mass-orthonormal rigid modes x, y, z, rx, ry, rz about the centre of gravity, (n_dofs, 6).

    R G^(-1/2) with G = Rᵀ M R: of all orthonormal sets the nearest to motions along the axes, so
    they depend smoothly on the body and have no arbitrary sign.
    """
    R = matrices.rigid @ rigid_motions(-center_of_gravity(matrices))
    G = R.T @ (matrices.mass @ R)
    inertia, axes = np.linalg.eigh((G + G.T) / 2)
    if inertia[0] <= 1e-12 * inertia[-1]:
        raise SolveError("the body turns about some axis without inertia: it has no free modes")
    return R @ (axes / np.sqrt(inertia)) @ axes.T


def center_of_gravity(matrices: Matrices) -> Floats:
    """The centre of gravity, (3,), m."""
    R = matrices.rigid
    M = R.T @ (matrices.mass @ R)
    return np.array([M[1, 5], M[2, 3], M[0, 4]]) / M[0, 0]


def free_modes(matrices: Matrices, n_modes: int) -> ModalBasis:
    """The lowest modes of a free body: six rigid ones, exact, then elastic ones by frequency.

    Args:
        matrices: of a body in one piece.
        n_modes: including the rigid ones.

    Raises:
        SolveError: the body cannot have so many modes, or moves without strain in more than six
            ways, as unconnected parts do.
    """
    if not N_RIGID <= n_modes < matrices.n_dofs:
        raise SolveError(
            f"modes: found {n_modes}, expected {N_RIGID} (the rigid ones) to {matrices.n_dofs - 1}"
        )
    R = rigid_modes(matrices)
    # One more than the rigid ones, even if none is wanted, tells whether the body is in one piece.
    omega_n_squared, phi = lowest_modes(matrices.mass, matrices.stiffness, max(n_modes, N_RIGID + 1))
    elastic = slice(N_RIGID, n_modes)
    if omega_n_squared[N_RIGID] < (2 * np.pi * MECHANISM_HZ) ** 2:
        raise SolveError("the body moves without strain in more than six ways: a part of it is loose")
    phi = _without(R, phi[:, elastic], matrices.mass)
    phi = phi / _norms(phi, matrices.mass)
    return ModalBasis(
        omega_n_squared=np.r_[np.zeros(N_RIGID), omega_n_squared[elastic]],
        shapes=np.hstack([R, _signed(phi)]),
    )


def lowest_modes(mass: sp.csc_array, stiffness: sp.csc_array, n_modes: int) -> tuple[Floats, Floats]:
    """Eigenvalues ω², rad²/s², and mass-normalised shapes of the lowest modes, rising.

    Lanczos on (K + s M)⁻¹ M. At shift zero a free body's K is singular and wrong modes come back
    silently; the positive s of `SHIFT` makes it definite. The start vector is fixed, so the same
    matrices give the same shapes.
    """
    n_dofs = mass.diagonal().size
    solve = factorised(stiffness + SHIFT * mass).solve
    start = np.random.default_rng(0).standard_normal(n_dofs)
    eigenvalues, phi = spl.eigsh(
        stiffness,
        n_modes,
        M=mass,
        sigma=-SHIFT,
        OPinv=spl.LinearOperator((n_dofs, n_dofs), solve),
        v0=start,
    )
    order = np.argsort(eigenvalues)
    return eigenvalues[order], phi[:, order]


def static_response(matrices: Matrices, loads: Floats) -> Floats:
    """Elastic displacements of a free body under static loads, by inertia relief, (n_dofs, n_loads).

    The body accelerates as a whole, and its inertia balances what the loads leave unbalanced:
    K u = (I - M R Rᵀ) f, with no rigid part in u, that is Rᵀ M u = 0.

    Args:
        matrices: of a body in one piece.
        loads: (n_dofs, n_loads), N and N m.
    """
    R = rigid_modes(matrices)
    balanced = loads - matrices.mass @ (R @ (R.T @ loads))
    # Balanced loads leave a determinate support without reaction: holding six changes nothing.
    support = most_independent(np.sqrt(matrices.stiffness.diagonal())[:, None] * R)
    free = np.setdiff1d(np.arange(matrices.n_dofs), support)
    u = np.zeros(loads.shape)
    u[free] = factorised(matrices.stiffness[free][:, free]).solve(balanced[free])
    return _without(R, u, matrices.mass)


def residual_response(matrices: Matrices, modes: ModalBasis, loads: Floats) -> Floats:
    """The static displacement under loads beyond that in the given free modes, (n_dofs, n_loads).

    The inertia-relief response u less its part in the modes, Φ Φᵀ M u = Φ Ω⁻² Φᵀ f. Zero where only
    rounding is left.
    """
    u = static_response(matrices, loads)
    rest = u
    for _ in range(2):
        rest = _without(modes.shapes, rest, matrices.mass)
    return rest * (_norms(rest, matrices.mass) > ROUNDING * _norms(u, matrices.mass))


def residual_vectors(matrices: Matrices, modes: ModalBasis, loads: Floats) -> ModalBasis:
    """Vectors that make the static response to the loads exact when joined to the free modes.

    They span `residual_response`, are orthonormal in mass and orthogonal in stiffness, among
    themselves and to the modes. The stiff ones count: leaving them out of the truck costs up to 2 %
    in frequency. Only those that repeat others are left out.

    Args:
        matrices: of the body.
        modes: its free modes.
        loads: (n_dofs, n_loads), N and N m.
    """
    M, K = matrices.mass, matrices.stiffness
    u = residual_response(matrices, modes, loads)
    for _ in range(2):
        u = _orthonormal(u, M)
    k = u.T @ (K @ u)
    omega_n_squared, rotation = sl.eigh((k + k.T) / 2)
    return ModalBasis(omega_n_squared, _signed(u @ rotation))


def most_independent(rows: Floats) -> np.ndarray:
    """The rows, as many as there are columns, that tell the columns apart best: indices, best first.

    By QR with pivoting: each is the one that is largest beyond what the rows before it show.
    """
    by_choice = np.asarray(sl.qr(rows.T, mode="r", pivoting=True)[-1], int)
    return by_choice[: rows.shape[1]]


def factorised(A: sp.csc_array) -> spl.SuperLU:
    """Sparse factors of a symmetric definite matrix, which needs no pivoting."""
    return spl.splu(
        A.tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


def _norms(u: Floats, mass: sp.csc_array) -> Floats:
    """√(uᵀ M u) of each column."""
    return np.sqrt(np.einsum("ij,ij->j", u, mass @ u))


def _without(phi: Floats, u: Floats, mass: sp.csc_array) -> Floats:
    """The part of `u` that is orthogonal in mass to the orthonormal `phi`."""
    return u - phi @ (phi.T @ (mass @ u))


def _orthonormal(u: Floats, mass: sp.csc_array, dependent: float = 1e-10) -> Floats:
    """A basis, orthonormal in mass, of what the columns of `u` span."""
    norms = _norms(u, mass)
    u = u[:, norms > 0] / norms[norms > 0]
    gram, rotation = np.linalg.eigh(u.T @ (mass @ u))
    kept = gram > dependent * gram.max(initial=0.0)
    return u @ (rotation[:, kept] / np.sqrt(gram[kept]))


def _signed(phi: Floats) -> Floats:
    """Shapes with the sign that makes their largest entry positive, the first of several as large."""
    sizes = np.abs(phi)
    first = np.argmax(sizes > 0.99 * sizes.max(axis=0), axis=0)
    return phi * np.sign(phi[first, np.arange(phi.shape[1])])
