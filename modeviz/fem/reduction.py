"""Reduction: a body in a few of its degrees of freedom, which the rest follows as in statics.

Guyan's, A. E. Duncan's first step from a finite-element model to one small enough to be solved for its
modes, and Craig and Bampton's, which adds modes of the rest. The built-in truck does without: its full
models take seconds.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg as sl
import scipy.sparse as sp
import scipy.sparse.linalg as spl

from modeviz.errors import SolveError, quoted
from modeviz.fem.free import N_RIGID, ModalBasis, factorised, most_independent, rigid_modes
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats

LOOSE = 1e-12
"""Of a stiffness, what elimination leaves where nothing but rounding is left."""

N_HELD = 30
"""How many modes with the retained degrees of freedom held are looked at together."""


@dataclass(frozen=True, eq=False)
class GuyanReduction:
    """A body condensed to its retained degrees of freedom, and what that costs.

    Rigid motion and the static deflection under loads on what is retained are exact, natural
    frequencies too high, the more so the closer they are to those of what is left out.
    """

    retained: np.ndarray
    """(n_retained,), indices of degrees of freedom in the full model."""
    matrices: Matrices
    """In the retained ones: Tᵀ M T and Tᵀ K T, which still move all nodes."""
    static_modes: Floats
    """T (n_dofs, n_retained): the full motion when the retained ones move slowly."""
    residual: Floats
    """Q (n_retained, n_retained), kg s²: K - ω² M lacks ω⁴ Q, and terms in ω⁶."""
    omitted_hz: float
    """The lowest natural frequency of the rest with these held; infinite where that has no mass."""

    def too_high(self, modes: ModalBasis) -> Floats:
        """The part by which each natural frequency is too high, to first order, (n_modes,).

        ω² φᵀ Q φ / 2: what the inertia of the omitted degrees of freedom bends them further. It is too
        little by up to 1 / (1 - (f / `omitted_hz`)²).

        Args:
            modes: of the reduced matrices.
        """
        phi = modes.shapes
        return modes.omega_n_squared * np.einsum("ij,ij->j", phi, self.residual @ phi) / 2

    def at_least_hz(self, frequency_hz: Floats) -> Floats:
        """Lower bounds of the full model's frequencies: 1 / f² = 1 / f_reduced² + 1 / f_omitted².

        Of the flexibility K⁻¹M the retained coordinates and the omitted ones, held, are diagonal
        blocks, and no eigenvalue of a positive matrix exceeds that of one block by more than the
        largest of the other (N. Aronszajn, 1948). At most they are the reduced ones (Rayleigh).

        Args:
            frequency_hz: (n_modes,), of the reduced matrices.
        """
        return frequency_hz / np.sqrt(1 + (frequency_hz / self.omitted_hz) ** 2)


def guyan_reduction(matrices: Matrices, retained: Sequence[int] | np.ndarray) -> GuyanReduction:
    """The body condensed to what is retained, m; the rest, s, follows as in statics.

    T = [I; -K_ss⁻¹ K_sm] (R. J. Guyan, 1965), Q = Nᵀ K_ss⁻¹ N with N the rows s of M T.

    Args:
        matrices: of the body.
        retained: (n_retained,), indices of degrees of freedom; `retained_up_to` chooses some.

    Raises:
        SolveError: an index is repeated or does not exist, the retained ones don't hold the body, or
            a part that is left out is loose.
    """
    retained = np.asarray(retained, int)
    _check_retained(matrices, retained)
    omitted = _others(matrices, retained)
    M, K = matrices.mass, matrices.stiffness
    T = np.zeros((matrices.n_dofs, len(retained)))
    T[retained, np.arange(len(retained))] = 1.0
    residual, omitted_hz = np.zeros((len(retained), len(retained))), np.inf
    if len(omitted):
        factors = _factorised_if_held(K[omitted][:, omitted])
        T[omitted] = -factors.solve(K[omitted][:, retained].toarray())
        N = (M @ T)[omitted]
        residual = _symmetric(N.T @ factors.solve(N))
        omitted_hz = float(_held_modes(matrices, omitted)[0].min())
    reduced = _reduced(matrices, T, matrices.rigid[retained])
    return GuyanReduction(retained, reduced, T, residual, omitted_hz)


def craig_bampton_reduction(
    matrices: Matrices, boundary: Sequence[int] | np.ndarray, frequency_hz: float
) -> Matrices:
    """The body in its boundary, b, and the modes of the rest, i, up to a frequency with that held.

    T = [[I, 0], [-K_ii⁻¹ K_ib, Φ]] (R. R. Craig and M. C. C. Bampton, 1968): rigid motion and static
    deflection under loads on the boundary are exact, natural frequencies too high, by some hundredths
    at half of that frequency.

    Args:
        matrices: of the body.
        boundary: (n_boundary,), indices of degrees of freedom, which come first in the reduced ones.
        frequency_hz: above zero.

    Raises:
        SolveError: an index is repeated or does not exist, the boundary doesn't hold it, or a part
            of the body is loose.
    """
    guyan = guyan_reduction(matrices, boundary)
    inner = _others(matrices, guyan.retained)
    held = _held_modes_up_to(matrices, inner, frequency_hz) if len(inner) else np.zeros((0, 0))
    phi = np.zeros((matrices.n_dofs, held.shape[1]))
    phi[inner] = held
    T = np.hstack([guyan.static_modes, phi])
    rigid = np.vstack([guyan.matrices.rigid, np.zeros((T.shape[1] - len(guyan.retained), N_RIGID))])
    return _reduced(matrices, T, rigid)


def retained_up_to(
    matrices: Matrices, frequency_hz: float, always: Sequence[int] | np.ndarray = ()
) -> np.ndarray:
    """Degrees of freedom to retain so that all others, held there, vibrate above a frequency, rising.

    First six that carry the mass in rigid motion. Then, again and again, as many as there are modes
    with these held below the frequency: those in which such modes, weighed by mass, are the most
    independent (QR with pivoting). The frequency is then about what `GuyanReduction.omitted_hz` says:
    three times that of a mode leaves 5 % of its frequency in doubt. The pickup's cab needs 78 of 18 420
    for 200 Hz; its modes at a third of that are then 1 to 2 % too high.

    Args:
        matrices: of the body.
        frequency_hz: above zero.
        always: indices to retain in any case, such as those at which other bodies pull.

    Raises:
        SolveError: a part of the body is loose.
    """
    inertia = np.sqrt(matrices.mass.diagonal())[:, None]
    retained = np.union1d(most_independent(inertia * rigid_modes(matrices)), np.asarray(always, int))
    while len(omitted := _others(matrices, retained)):
        held_hz, shapes = _held_modes(matrices, omitted)
        low = held_hz < frequency_hz
        if not low.any():
            break
        retained = np.r_[retained, omitted[most_independent(inertia[omitted] * shapes[:, low])]]
    return np.sort(retained)


def _reduced(matrices: Matrices, T: Floats, rigid: Floats) -> Matrices:
    """The matrices in coordinates that move a body by T, and are `rigid` as it moves as a whole."""
    return Matrices(
        nodes=matrices.nodes,
        mass=sp.csc_array(_symmetric(T.T @ (matrices.mass @ T))),
        stiffness=sp.csc_array(_symmetric(T.T @ (matrices.stiffness @ T))),
        motion=matrices.motion @ T,
        rigid=rigid,
    )


def _others(matrices: Matrices, retained: np.ndarray) -> np.ndarray:
    return np.setdiff1d(np.arange(matrices.n_dofs), retained)


def _check_retained(matrices: Matrices, retained: np.ndarray) -> None:
    if (
        len(np.unique(retained)) != len(retained)
        or not np.isin(retained, np.arange(matrices.n_dofs)).all()
    ):
        raise SolveError(
            f"retained: found {quoted(retained.tolist())}, expected different indices from 0 to "
            f"{matrices.n_dofs - 1}"
        )
    shown = rigid_modes(matrices)[retained]
    if np.linalg.matrix_rank(shown / np.linalg.norm(shown, axis=1, keepdims=True)) < N_RIGID:
        raise SolveError(
            f"retained: the {len(retained)} found don't hold the body, expected some that show every "
            "rigid motion"
        )


def _factorised_if_held(stiffness: sp.csc_array) -> spl.SuperLU:
    """The factors of the omitted stiffness, if nothing omitted moves without strain."""
    try:
        factors = factorised(stiffness)
    except SolveError:  # exactly singular
        factors = None
    diagonal = stiffness.diagonal()
    if factors is None or (factors.U.diagonal()[factors.perm_c] <= LOOSE * diagonal).any():
        raise SolveError(
            "retained: something that is left out moves without strain: a part of the body is loose "
            "or has to be retained"
        )
    return factors


def _held_modes(
    matrices: Matrices, omitted: np.ndarray, n_modes: int = N_HELD
) -> tuple[Floats, Floats]:
    """The lowest natural frequencies with all but these held, rising, and their shapes.

    Infinite where nothing has mass: what Lanczos and the dense solution find is 1 / ω², of K⁻¹ M.
    """
    M, K = (A[omitted][:, omitted] for A in (matrices.mass, matrices.stiffness))
    n, factors = len(omitted), _factorised_if_held(K)
    if n <= 2 * n_modes or not M.nnz:
        flexibility, phi = sl.eigh(M.toarray(), K.toarray())
        flexibility, phi = flexibility[::-1][:n_modes], phi[:, ::-1][:, :n_modes]
    else:
        start = np.random.default_rng(0).standard_normal(n)
        solve = spl.LinearOperator((n, n), factors.solve)
        omega_squared, phi = spl.eigsh(K, n_modes, M=M, sigma=0, OPinv=solve, v0=start)
        flexibility = 1 / omega_squared
    with np.errstate(divide="ignore"):
        return 1 / np.sqrt(np.maximum(flexibility, 0.0)) / (2 * np.pi), phi


def _held_modes_up_to(matrices: Matrices, inner: np.ndarray, frequency_hz: float) -> Floats:
    """The shapes of all modes up to a frequency with all but these held."""
    n_modes = N_HELD
    while True:
        held_hz, shapes = _held_modes(matrices, inner, n_modes)
        if held_hz.max() > frequency_hz or n_modes >= len(inner):
            return shapes[:, held_hz <= frequency_hz]
        n_modes *= 2


def _symmetric(A: Floats) -> Floats:
    return (A + A.T) / 2
