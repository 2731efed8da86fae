"""Modes after a change of mount rates: Rayleigh and Ritz in an enriched basis.

A shape of the vehicle with changed mounts is (K - ω²M)⁻¹ times forces in the changed springs. Of that,
the base modes hold what is in resonance; the rest hardly depends on frequency, and two static shapes of
every spring, at zero frequency and at the top of the band, hold it (the residual vectors of component
mode synthesis; D. J. Rixen, "A dual Craig-Bampton method for dynamic substructuring", 2004). No rates
enter, so the basis serves every rate from zero to rigid.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System, mount_stiffness
from modeviz.dynamics.modes import RESOLVED_HZ, Modes, damping_ratio, rounding, solve_modes
from modeviz.dynamics.trust import EDGE, Trust, count_below, frequency_error, gap_error, missed
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

Method = Literal["enriched", "classic", "exact"]
"""How modes are found: in the base modes with residual vectors, in the base modes alone (the paper's
equation), or from the full matrices."""

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

    @cached_property
    def mount_stiffness(self) -> Complexes:
        """The base rates, (n_springs,), complex, N/m."""
        return mount_stiffness(self.system.vehicle)

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


@dataclass(frozen=True, eq=False)
class BandModes:
    """The modes of the band, and how good they are."""

    modes: Modes
    damping: Floats
    """φᵀCφ, (n_modes, n_modes): damping couples modes."""
    structural_damping: Floats
    """φᵀK_gφ, (n_modes, n_modes)."""
    trust: Trust


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
    R = system.mount_motions
    shift = (2 * np.pi * ZERO_HZ) ** 2
    static, at_top = (
        scipy.linalg.solve(system.stiffness + s * system.mass, R.T, assume_a="sym")
        for s in (shift, -top)
    )
    L = scipy.linalg.cholesky(system.mass, lower=True)
    V_L = _orthonormal(L.T @ base.shapes, L.T @ np.hstack([static, at_top]))
    V = scipy.linalg.solve_triangular(L.T, V_L)
    K_L = _whitened(system.stiffness, L)
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
        spring_motions=R @ V,
        remainder=Q.T @ K_L @ V_L,
        spring_remainder=Q.T @ left_out,
        remainder_compliance=Q.T
        @ scipy.linalg.solve(K_L + shift * np.eye(len(K_L)), Q, assume_a="pos"),
        top_receptance=R @ at_top,
        n_below=_n_negative(system.stiffness - top * system.mass),
    )


def band_modes(basis: EnrichedBasis, stiffness: Complexes, method: Method = "enriched") -> BandModes:
    """The modes below the top of the band at other mount rates.

    Args:
        basis: of the vehicle.
        stiffness: (n_springs,), complex rates, N/m.
        method: how.

    Raises:
        SolveError: a spring so stiff that rounding drowns the slow modes.
    """
    change = stiffness - basis.mount_stiffness
    _check_resolved(basis, change.real)
    solution = _exact(basis, change.real) if method == "exact" else _ritz(basis, change.real, method)
    omega = np.sqrt(np.maximum(solution.omega_squared, 0.0))
    stretch = solution.stretch
    viscous, structural = solution.damping, solution.structural + (stretch.T * change.imag) @ stretch
    ratio = damping_ratio(omega, np.diag(viscous), np.diag(structural))
    n_counted = count_below(basis.n_below, basis.top_receptance, change.real)
    trust = Trust(
        solution.residual,
        frequency_error(solution.omega_squared, solution.error + basis.rounding),
        missed(n_counted, solution.omega_squared, basis.top),
    )
    modes = Modes(omega / (2 * np.pi), solution.shapes, ratio)
    return BandModes(modes, viscous, structural, trust)


def natural_frequencies(basis: EnrichedBasis, stiffness: Complexes) -> Floats:
    """The lowest natural frequencies, Hz, as many as the band has at the base rates.

    At other mount rates; cheaper than `band_modes`, without shapes; arguments as there.
    """
    change = (stiffness - basis.mount_stiffness).real
    _check_resolved(basis, change)
    R = basis.spring_motions
    omega_squared = np.linalg.eigvalsh(basis.stiffness + (R.T * change) @ R)[: basis.n_below]
    return np.sqrt(np.maximum(omega_squared, 0.0)) / (2 * np.pi)


def _check_resolved(basis: EnrichedBasis, change: Floats) -> None:
    """Raises SolveError unless slow modes stand out from the rounding of the stiffest spring."""
    added = change * (basis.spring_motions**2).max(axis=1, initial=0.0)
    if np.finfo(np.float64).eps * added.max(initial=0.0) > (2 * np.pi * RESOLVED_HZ) ** 2:
        stiffest = int(added.argmax())
        mount = basis.system.vehicle.mounts[stiffest // 3]
        rate = mount.stiffness[stiffest % 3] + change[stiffest]
        raise SolveError(
            f"the slow modes drown in rounding: mount {mount.name!r} has a rate of {rate:.2g} N/m; "
            "soften it"
        )


@dataclass(frozen=True, eq=False)
class _Solution:
    """Undamped modes with what their damping and their trust are made of."""

    omega_squared: Floats
    shapes: Floats
    stretch: Floats
    """(n_springs, n_modes), of the mount springs."""
    damping: Floats
    """φᵀCφ, (n_modes, n_modes)."""
    structural: Floats
    """φᵀK_gφ at the base rates, (n_modes, n_modes)."""
    residual: Floats
    """See `Trust.residual`."""
    error: Floats
    """See `Trust`, of ω², but for rounding."""


def _ritz(basis: EnrichedBasis, change: Floats, method: Method) -> _Solution:
    """The modes within the basis, or within its base modes."""
    n = basis.n_modes if method == "classic" else basis.vectors.shape[1]
    R = basis.spring_motions
    A = basis.stiffness + (R.T * change) @ R
    roughly, y = np.linalg.eigh(A[:n, :n])
    y = y[:, roughly < 2 * basis.top]
    omega_squared, y = _lowest(basis, basis.stiffness[:n, :n], R[:, :n], change, y)
    stretch = R[:, :n] @ y
    inside = A[:, :n] @ y
    inside[:n] -= omega_squared * y
    outside = basis.remainder[:, :n] @ y + basis.spring_remainder @ (change[:, None] * stretch)
    inside_norm = np.linalg.norm(inside, axis=0)
    return _Solution(
        omega_squared,
        basis.vectors[:, :n] @ y,
        stretch,
        y.T @ basis.damping[:n, :n] @ y,
        y.T @ basis.structural_damping[:n, :n] @ y,
        np.hypot(inside_norm, np.linalg.norm(outside, axis=0)),
        gap_error(omega_squared, inside_norm) + _left_out_error(basis, omega_squared, outside),
    )


def _left_out_error(basis: EnrichedBasis, omega_squared: Floats, forces: Floats) -> Floats:
    """How much too high ω² is, (n_modes,), for the forces on what the basis leaves out.

    To second order rᵀ(K - ω²M)⁻¹r. The residual r is orthogonal to the basis, so it moves only what is
    faster than the base modes: there 1/(ω_j² - ω²) is at most 1/ω_j² times the factor taken here.
    """
    amplification = 1 / (1 - omega_squared / (REACH**2 * basis.top))
    return amplification * _quadratic(basis.remainder_compliance, forces)


def _exact(basis: EnrichedBasis, change: Floats) -> _Solution:
    """The modes of the full matrices."""
    system = basis.system
    R, M = system.mount_motions, system.mass
    K = system.stiffness + (R.T * change) @ R
    _, phi = scipy.linalg.eigh(K, M, subset_by_value=(-np.inf, (1 + EDGE) * basis.top))
    omega_squared, phi = _lowest(basis, system.stiffness, R, change, phi)
    residual = np.linalg.norm(
        scipy.linalg.solve_triangular(
            scipy.linalg.cholesky(M, lower=True), K @ phi - omega_squared * (M @ phi), lower=True
        ),
        axis=0,
    )
    return _Solution(
        omega_squared,
        phi,
        R @ phi,
        phi.T @ system.damping @ phi,
        phi.T @ system.structural_damping @ phi,
        residual,
        gap_error(omega_squared, residual),
    )


def _lowest(
    basis: EnrichedBasis, K: Floats, R: Floats, change: Floats, vectors: Floats
) -> tuple[Floats, Floats]:
    """The vectors of the band in rising order, with Rayleigh's quotient of each.

    Base and change are summed apart: a spring that is practically rigid makes the eigenvalues of the
    sum inexact, but hardly stretches.
    """
    omega_squared = _quadratic(K, vectors) + change @ (R @ vectors) ** 2
    order = np.argsort(omega_squared, kind="stable")
    order = order[omega_squared[order] < basis.top]
    return omega_squared[order], vectors[:, order]


def _quadratic(A: Floats, vectors: Floats) -> Floats:
    """xᵀAx of each column x."""
    return np.einsum("ij,ij->j", vectors, A @ vectors)


def _orthonormal(first: Floats, more: Floats) -> Floats:
    """Orthonormal columns: `first`, which are so already, and what `more` adds to them."""
    more = more / np.linalg.norm(more, axis=0)
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
    """How many eigenvalues of a symmetric matrix are negative: as many as of D in A = LDLᵀ."""
    D = scipy.linalg.ldl(A)[1]
    eigenvalues = np.asarray(scipy.linalg.eigvalsh_tridiagonal(np.diag(D), np.diag(D, 1)))
    return int((eigenvalues < 0).sum())


def _clear_of(omega_squared: Floats, top: float) -> float:
    """The least ω² from `top` up that is not near one of the modes."""
    for mode in omega_squared[omega_squared > (1 - CLEAR) * top]:
        if abs(mode - top) < CLEAR * top:
            top = mode + CLEAR * top
    return top
