"""Free bodies: their rigid and normal modes, and how static loads deform them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
import scipy.sparse.linalg as spl

from modeviz.errors import SolveError
from modeviz.fem.matrices import Matrices
from modeviz.fem.ordering import elimination_order
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions

SHIFT = 40.0
"""rad²/s², (1 Hz)²: what shift-invert adds to ω² so that rigid motion has stiffness."""

MECHANISM_HZ = 0.01
"""Below this a seventh mode is not elastic: the mesh has a loose part."""

FREE_HZ, FREE = 0.05, 0.01
"""A body is free if no rigid motion vibrates above this, or this part of its first elastic mode."""

N_RIGID = 6

SMALL = 4
"""With so many degrees of freedom for each mode, all modes are found at once."""

FIRST_GUESS, LARGEST_COUNT = 30, 2**31
"""SuperLU begins with room for so many times the numbers of a matrix, and counts up to that."""

MASSLESS = 1e-15
"""Part of the largest flexibility, (ω² + s)⁻¹, below which there is no mass."""


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
    # One more than the rigid ones, even if none is wanted, tells whether the body is in one piece.
    solve = _solver_of_large(matrices)
    found = lowest_modes(matrices.mass, matrices.stiffness, max(n_modes, N_RIGID + 1), solve)
    return _free(matrices, *found, n_modes)


def free_modes_up_to(matrices: Matrices, frequency_hz: float, most: int) -> ModalBasis:
    """The modes of a free body up to a frequency, as `free_modes`, and the first one above it.

    Args:
        matrices: of a body in one piece.
        frequency_hz: above zero.
        most: how many there may be.

    Raises:
        SolveError: there are more, or it is no such body.
    """
    limit = (2 * np.pi * frequency_hz) ** 2
    solve = _solver_of_large(matrices)
    n_modes, whole = 4 * N_RIGID, matrices.n_dofs - 1
    while True:
        n_modes = min(n_modes, most + 1, whole)
        found = lowest_modes(matrices.mass, matrices.stiffness, n_modes, solve)
        above = np.flatnonzero(found[0] > limit)
        if len(above) or n_modes == whole or len(found[0]) < n_modes:
            break
        if n_modes > most:
            raise SolveError(
                f"more than {most} modes are below {frequency_hz:g} Hz, the last of these at "
                f"{_hz(found[0][-1]):.4g} Hz"
            )
        n_modes *= 2
    n_wanted = above[0] + 1 if len(above) else len(found[0])
    return _free(matrices, *found, max(int(n_wanted), N_RIGID))


def _solver_of_large(matrices: Matrices) -> Callable[[Floats], Floats] | None:
    """What solves by K + s M of a large body, factorised once; None of others, which are quick."""
    order = elimination_order(matrices)
    return None if order is None else solver(matrices.stiffness + SHIFT * matrices.mass, order)


def _free(matrices: Matrices, omega_n_squared: Floats, phi: Floats, n_modes: int) -> ModalBasis:
    """The modes of a free body, with exact rigid ones instead of those that were found."""
    R = rigid_modes(matrices)
    elastic = slice(N_RIGID, n_modes)
    if len(omega_n_squared) <= N_RIGID:
        raise SolveError("the body has mass in no more than its six rigid modes, expected elastic ones")
    limit = max((2 * np.pi * FREE_HZ) ** 2, FREE**2 * abs(omega_n_squared[N_RIGID]))
    if omega_n_squared[0] < -limit:
        raise SolveError(
            f"the stiffness is negative in a mode, whose ω² is {omega_n_squared[0]:.4g} rad²/s²"
        )
    if omega_n_squared[N_RIGID] < (2 * np.pi * MECHANISM_HZ) ** 2:
        raise SolveError("the body moves without strain in more than six ways: a part of it is loose")
    _check_not_held(matrices, R, limit)
    phi = without(R, phi[:, elastic], matrices.mass)
    phi = phi / norms(phi, matrices.mass)
    return ModalBasis(
        omega_n_squared=np.r_[np.zeros(N_RIGID), omega_n_squared[elastic]],
        shapes=np.hstack([R, signed(phi)]),
    )


def _check_not_held(matrices: Matrices, R: Floats, limit: float) -> None:
    """Raises SolveError for a body whose rigid motions vibrate, with ω² above a limit."""
    k = R.T @ (matrices.stiffness @ R)
    held = np.linalg.eigvalsh((k + k.T) / 2)
    if held[-1] > limit:
        raise SolveError(
            f"the body is held: moving as a whole it would vibrate at {_hz(held[-1]):.4g} Hz, expected "
            "zero of a free one; leave out its supports, or put its nodes where they belong"
        )


def _hz(omega_squared: float) -> float:
    return float(np.sqrt(omega_squared) / (2 * np.pi))


def lowest_modes(
    mass: sp.csc_array,
    stiffness: sp.csc_array,
    n_modes: int,
    solve: Callable[[Floats], Floats] | None = None,
) -> tuple[Floats, Floats]:
    """Eigenvalues ω², rad²/s², and mass-normalised shapes of the lowest modes, rising.

    Lanczos on (K + s M)⁻¹ M. At shift zero a free body's K is singular and wrong modes come back
    silently; the positive s of `SHIFT` makes it definite. The start vector is fixed, so the same
    matrices give the same shapes. Small ones are solved at once, where directions without mass have no
    mode.

    Args:
        mass: (n_dofs, n_dofs).
        stiffness: (n_dofs, n_dofs).
        n_modes: how many.
        solve: by K + s M, if it has been factorised.
    """
    n_dofs = mass.diagonal().size
    if n_dofs <= SMALL * n_modes:
        return _all_modes(mass, stiffness, n_modes)
    solve = solve or factorised(stiffness + SHIFT * mass).solve
    start = np.random.default_rng(0).standard_normal(n_dofs)
    inverse = spl.LinearOperator((n_dofs, n_dofs), solve)
    try:
        eigenvalues, phi = spl.eigsh(stiffness, n_modes, M=mass, sigma=-SHIFT, OPinv=inverse, v0=start)
    except spl.ArpackError as error:
        raise SolveError(f"the modes are not found, as of a negative stiffness ({error})") from None
    order = np.argsort(eigenvalues)
    return eigenvalues[order], phi[:, order]


def _all_modes(mass: sp.csc_array, stiffness: sp.csc_array, n_modes: int) -> tuple[Floats, Floats]:
    """As `lowest_modes`, of (K + s M) φ = (ω² + s) M φ turned round, since M may be singular."""
    try:
        flexibility, phi = sl.eigh(mass.toarray(), (stiffness + SHIFT * mass).toarray())
    except np.linalg.LinAlgError:
        raise SolveError("the stiffness is negative or zero in a motion that has no mass") from None
    flexibility, phi = flexibility[::-1][:n_modes], phi[:, ::-1][:, :n_modes]
    kept = flexibility > MASSLESS * flexibility[0]
    omega_n_squared = 1 / flexibility[kept] - SHIFT
    return omega_n_squared, phi[:, kept] / np.sqrt(flexibility[kept])


def inertia_relief(matrices: Matrices) -> Callable[[Floats], Floats]:
    """Return what gives a free body's elastic displacements under static loads, (n_dofs, n_loads).

    The body accelerates as a whole, and its inertia balances what the loads leave unbalanced:
    K u = (I - M R Rᵀ) f, with no rigid part in u, that is Rᵀ M u = 0. The stiffness is factorised once.

    Args:
        matrices: of a body in one piece.
    """
    R = rigid_modes(matrices)
    # Balanced loads leave a determinate support without reaction: holding six changes nothing.
    weights = np.sqrt(matrices.stiffness.diagonal() + SHIFT * matrices.mass.diagonal())
    support = most_independent(weights[:, None] * R)
    free = np.setdiff1d(np.arange(matrices.n_dofs), support)
    order = elimination_order(matrices)
    if order is not None:
        order = np.searchsorted(free, order[np.isin(order, free)])
    solve = solver(matrices.stiffness[free][:, free], order)

    def response(loads: Floats) -> Floats:
        u = np.zeros(loads.shape)
        u[free] = solve((loads - matrices.mass @ (R @ (R.T @ loads)))[free])
        return without(R, u, matrices.mass)

    return response


def static_response(matrices: Matrices, loads: Floats) -> Floats:
    """Elastic displacements of a free body under static loads, by `inertia_relief`.

    Args:
        matrices: of a body in one piece.
        loads: (n_dofs, n_loads), N and N m.
    """
    return inertia_relief(matrices)(loads)


def most_independent(rows: Floats) -> np.ndarray:
    """The rows, as many as there are columns, that tell the columns apart best: indices, best first.

    By QR with pivoting: each is the one that is largest beyond what the rows before it show.
    """
    by_choice = np.asarray(sl.qr(rows.T, mode="r", pivoting=True)[-1], int)
    return by_choice[: rows.shape[1]]


def solver(A: sp.csc_array, order: np.ndarray | None = None) -> Callable[[Floats], Floats]:
    """Return what solves by a symmetric definite matrix, (n,) or (n, n_loads).

    Args:
        A: (n, n).
        order: (n,), in which its rows are eliminated; None: by minimum degree.
    """
    if order is None:
        return factorised(A).solve
    factors = factorised(A[order][:, order], "NATURAL")

    def solve(loads: Floats) -> Floats:
        u = np.empty_like(loads)
        u[order] = factors.solve(loads[order])
        return u

    return solve


def factorised(A: sp.csc_array, order: str = "MMD_AT_PLUS_A") -> spl.SuperLU:
    """Sparse factors of a symmetric definite matrix, without pivoting, in an order of SuperLU.

    Raises:
        SolveError: it is singular, or takes more memory than there is or more than SuperLU counts.
    """
    try:
        return spl.splu(
            A.tocsc(), permc_spec=order, diag_pivot_thresh=0.0, options={"SymmetricMode": True}
        )
    except RuntimeError:
        raise SolveError(
            "something moves without strain and without mass, such as a node that a rod alone holds"
        ) from None
    except MemoryError:
        is_counted = A.nnz * FIRST_GUESS < LARGEST_COUNT
        reason = "memory than there is" if is_counted else "numbers than SuperLU can count"
        raise SolveError(
            f"{A.diagonal().size:,} degrees of freedom take more {reason}: reduce the model in the "
            "program that it is from, to a superelement or a substructure"
        ) from None


def norms(u: Floats, mass: sp.csc_array) -> Floats:
    """√(uᵀ M u) of each column."""
    return np.sqrt(np.einsum("ij,ij->j", u, mass @ u))


def without(phi: Floats, u: Floats, mass: sp.csc_array) -> Floats:
    """The part of `u` that is orthogonal in mass to the orthonormal `phi`."""
    return u - phi @ (phi.T @ (mass @ u))


def signed(phi: Floats) -> Floats:
    """Shapes with the sign that makes their largest entry positive, the first of several as large."""
    sizes = np.abs(phi)
    first = np.argmax(sizes > 0.99 * sizes.max(axis=0), axis=0)
    return phi * np.sign(phi[first, np.arange(phi.shape[1])])
