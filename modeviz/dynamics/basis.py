"""A basis that holds the modes of a vehicle at any rates of its mounts, for Rayleigh and Ritz.

A shape of the vehicle with changed mounts is (K - ω²M)⁻¹ times forces in the changed springs. Of that,
the base modes hold what is in resonance; the rest hardly depends on frequency, and two static shapes of
every spring, at zero frequency and at the top of the band, hold it (the residual vectors of component
mode synthesis; D. J. Rixen, "A dual Craig-Bampton method for dynamic substructuring", 2004). No rates
enter, so the basis serves every rate from zero to rigid.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import rounding, solve_modes
from modeviz.dynamics.spring_law import SpringLaw, spring_law
from modeviz.vehicle.arrays import Complexes, Floats

TOP_HZ = 40.0
"""The band in which modes are wanted, as the paper's RMS values."""

REACH = 1.75
"""Base modes go this many times as high as the band."""

ZERO_HZ = 1.0
"""Where "zero frequency" is taken, on the imaginary side, so that a free vehicle has static shapes."""

DEPENDENT = 1e-9
"""What is less than this part of a vector is rounding: a residual vector that is new to the modes and
the others by no more is left out."""

CLEAR = 1e-4
"""How far, relative in ω², the top of the band stays from a base mode."""


@dataclass(frozen=True, eq=False)
class EnrichedBasis:
    """A vehicle's modes and the residual vectors of its mount springs, orthonormal in mass."""

    system: System
    """With the base rates."""
    top_hz: float
    """The top of the band."""
    vectors: Floats
    """V, (n_dofs, n_vectors), VᵀMV = I; base modes first, then residual vectors."""
    n_modes: int
    """How many of them are base modes."""
    stiffness: Floats
    """VᵀKV, (n_vectors, n_vectors), at the base rates."""
    damping: Floats
    """VᵀCV."""
    structural_damping: Floats
    """VᵀK_gV, at the base rates."""
    spring_motions: Floats
    """RV, (n_springs, n_vectors)."""
    remainder: Floats
    """What of KV lies outside of the basis, (n_outside, n_vectors), as forces of unit norm in M⁻¹, at
    most as many as springs."""
    spring_remainder: Floats
    """What of Rᵀ lies outside, in the same forces, (n_outside, n_springs)."""
    remainder_compliance: Floats
    """QᵀK⁻¹Q of these forces Q, (n_outside, n_outside), s²/rad². No rates change it, because the basis
    holds K⁻¹Rᵀ."""
    top_receptance: Floats
    """R(K - ω²M)⁻¹Rᵀ undamped, at the top of the band, (n_springs, n_springs)."""
    n_below: int
    """How many modes the base has in the band, counted without solving for them."""

    @property
    def mount_stiffness(self) -> Complexes:
        """The base rates, (n_springs,), complex, N/m."""
        return self.system.mount_stiffness

    @cached_property
    def law(self) -> SpringLaw:
        """How rates depend on frequency."""
        return spring_law(self.system.vehicle)

    def change(self, stiffness: Complexes, frequency_hz: Floats) -> Complexes:
        """Return Δ of the springs' complex rates, none of dampers, (n_freqs or 1, n_springs), N/m.

        Args:
            stiffness: (n_springs,), complex rates at the reference, N/m.
            frequency_hz: (n_freqs,).
        """
        law = self.law
        if law.is_constant:
            return law.springs(stiffness - self.mount_stiffness)[None]
        return law.stiffness(law.springs(stiffness), frequency_hz) - law.springs(self.mount_stiffness)

    def damping_change(self, stiffness: Complexes) -> Floats:
        """Return Δc of the dampers that are tuned, (n_springs,), N s/m; of springs zero."""
        return self.law.dampers(stiffness - self.mount_stiffness)

    def damping_at(self, stiffness: Complexes) -> Floats:
        """Return VᵀCV with complex rates, (n_springs,), N/m."""
        if not self.law.has_dampers:
            return self.damping
        R = self.spring_motions
        return self.damping + (R.T * self.damping_change(stiffness)) @ R

    @property
    def n_bytes(self) -> int:
        """The memory that the arrays take."""
        return sum(a.nbytes for a in vars(self).values() if isinstance(a, np.ndarray))

    @cached_property
    def rounding(self) -> float:
        """The error that arithmetic makes in ω², rad²/s²."""
        return rounding(self.system)

    @property
    def top(self) -> float:
        """The top of the band, ω², rad²/s²."""
        return (2 * np.pi * self.top_hz) ** 2


def prepare_basis(system: System, top_hz: float = TOP_HZ) -> EnrichedBasis:
    """The enriched basis of a system for any rates of its mounts.

    Args:
        system: with the base rates.
        top_hz: modes below this are wanted.

    Raises:
        SolveError: as `solve_modes`.
    """
    base = solve_modes(system, below_hz=REACH * top_hz)
    top = _clear_of(base.omega_n_squared, (2 * np.pi * top_hz) ** 2)
    K, M = system.condensed(system.stiffness), system.condensed(system.mass)
    R = system.condensed_rows(system.mount_motions)
    shift = (2 * np.pi * ZERO_HZ) ** 2
    static, at_top = (scipy.linalg.solve(K + s * M, R.T, assume_a="sym") for s in (shift, -top))
    L = scipy.linalg.cholesky(M, lower=True)
    V_L = _orthonormal(L.T @ system.condensed_shapes(base.shapes), L.T @ np.hstack([static, at_top]))
    V = system.expanded(scipy.linalg.solve_triangular(L.T, V_L))
    K_L = _whitened(K, L)
    R_L = scipy.linalg.solve_triangular(L, R.T, lower=True)
    left_out = R_L - V_L @ (V_L.T @ R_L)
    Q = _directions(left_out, DEPENDENT * float(np.linalg.norm(R_L)))
    return EnrichedBasis(
        system=system,
        top_hz=float(np.sqrt(top) / (2 * np.pi)),
        vectors=V,
        n_modes=len(base.frequency_hz),
        stiffness=V.T @ system.stiffness @ V,
        damping=V.T @ system.damping @ V,
        structural_damping=V.T @ system.structural_damping @ V,
        spring_motions=system.mount_motions @ V,
        remainder=Q.T @ K_L @ V_L,
        spring_remainder=Q.T @ left_out,
        remainder_compliance=Q.T
        @ scipy.linalg.solve(K_L + shift * np.eye(len(K_L)), Q, assume_a="pos"),
        top_receptance=R @ at_top,
        n_below=_n_negative(K - top * M),
    )


def _orthonormal(first: Floats, more: Floats) -> Floats:
    """Orthonormal columns: `first`, which are so already, and what `more` adds to them."""
    given = np.linalg.norm(more, axis=0)
    more = more[:, given > 0] / given[given > 0]
    for _ in range(2):
        more = more - first @ (first.T @ more)
    size = np.linalg.norm(more, axis=0)
    more = more[:, size > DEPENDENT] / size[size > DEPENDENT]
    return np.hstack([first, _directions(more, DEPENDENT)])


def _directions(vectors: Floats, rounding: float) -> Floats:
    """Orthonormal columns that span those of `vectors`, but for what is as small as rounding."""
    U, singular, _ = np.linalg.svd(vectors, full_matrices=False)
    return U[:, singular > rounding]


def _whitened(A: Floats, L: Floats) -> Floats:
    """L⁻¹AL⁻ᵀ of a symmetric A."""
    half = scipy.linalg.solve_triangular(L, A, lower=True)
    return scipy.linalg.solve_triangular(L, half.T, lower=True)


def _n_negative(A: Floats) -> int:
    """The number of negative eigenvalues of a symmetric matrix: as many as of D in A = LDLᵀ."""
    D = scipy.linalg.ldl(A)[1]
    eigenvalues = np.asarray(scipy.linalg.eigvalsh_tridiagonal(np.diag(D), np.diag(D, 1)))
    return int((eigenvalues < 0).sum())


def _clear_of(omega_squared: Floats, top: float) -> float:
    """The least ω² from `top` up that is not near one of the modes."""
    for mode in omega_squared[omega_squared > (1 - CLEAR) * top]:
        if abs(mode - top) < CLEAR * top:
            top = mode + CLEAR * top
    return top
