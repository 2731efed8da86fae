"""The modes of the band at other mount rates.

In the enriched basis, in the base modes alone, or from the full matrices, and how good they are.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.linalg

from modeviz.dynamics.basis import REACH, EnrichedBasis
from modeviz.dynamics.modes import RESOLVED_HZ, Modes, damping_ratio
from modeviz.dynamics.mount_rates import mounts_of_springs
from modeviz.dynamics.trust import EDGE, ErrorEstimate, count_below, frequency_error, gap_error, missed
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

Method = Literal["enriched", "classic", "exact"]
"""How modes are found: in the base modes with residual vectors, in the base modes alone (the paper's
equation), or from the full matrices."""


@dataclass(frozen=True, eq=False)
class BandModes:
    """The modes of the band, and how good they are."""

    modes: Modes
    damping: Floats
    """φᵀCφ, (n_modes, n_modes): damping couples modes."""
    structural_damping: Floats
    """φᵀK_gφ, (n_modes, n_modes)."""
    trust: ErrorEstimate
    ritz: tuple[Floats, Floats] | None
    """ω² (n_vectors,) and vectors (n_vectors, n_vectors) of all modes of the enriched basis; None if
    the band's were found otherwise."""


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
    trust = ErrorEstimate(
        solution.residual,
        frequency_error(solution.omega_squared, solution.error + basis.rounding),
        missed(n_counted, solution.omega_squared, basis.top),
    )
    modes = Modes(omega / (2 * np.pi), solution.shapes, ratio)
    return BandModes(modes, viscous, structural, trust, solution.ritz)


def modes_above(basis: EnrichedBasis, stiffness: Complexes, band: BandModes) -> Modes:
    """The modes of the basis above those of the band, as well as it holds them, in its vectors.

    Up to `REACH` times the band they are modes of the vehicle, the others what stands for the rest.

    Args:
        basis: of the vehicle.
        stiffness: (n_springs,), complex rates, N/m.
        band: its modes at these rates.
    """
    change = stiffness - basis.mount_stiffness
    R = basis.spring_motions
    omega_squared, y = band.ritz or np.linalg.eigh(basis.stiffness + (R.T * change.real) @ R)
    n_band = len(band.modes.frequency_hz)
    omega, y = np.sqrt(np.maximum(omega_squared[n_band:], 0.0)), y[:, n_band:]
    structural = _quadratic(basis.structural_damping, y) + change.imag @ (R @ y) ** 2
    ratio = damping_ratio(omega, _quadratic(basis.damping, y), structural)
    return Modes(omega / (2 * np.pi), y, ratio)


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
        vehicle = basis.system.vehicle
        mount = vehicle.mounts[mounts_of_springs(vehicle)[stiffest]]
        rate = basis.mount_stiffness[stiffest].real + change[stiffest]
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
    """See `ErrorEstimate.residual`."""
    error: Floats
    """See `ErrorEstimate`, of ω², but for rounding."""
    ritz: tuple[Floats, Floats] | None = None
    """See `BandModes`."""


def _ritz(basis: EnrichedBasis, change: Floats, method: Method) -> _Solution:
    """The modes within the basis, or within its base modes."""
    n = basis.n_modes if method == "classic" else basis.vectors.shape[1]
    R = basis.spring_motions
    A = basis.stiffness + (R.T * change) @ R
    roughly, every = np.linalg.eigh(A[:n, :n])
    y = every[:, roughly < 2 * basis.top]
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
        _amplification(basis, omega_squared)
        * (_quadratic(basis.remainder_compliance, outside) + _compliance_of(A[n:, n:], inside[n:])),
        (roughly, every) if method == "enriched" else None,
    )


def _amplification(basis: EnrichedBasis, omega_squared: Floats) -> Floats:
    """The motion that a mode adds to the static effect of a residual, (n_modes,).

    To second order ω² is too high by rᵀ(K - ω²M)⁻¹r. The residual r is orthogonal to the vectors in
    use, so it moves only what is faster than the base modes: there 1/(ω_j² - ω²) is at most 1/ω_j²
    times this.
    """
    return 1 / (1 - omega_squared / (REACH**2 * basis.top))


def _compliance_of(A: Floats, forces: Floats) -> Floats:
    """rᵀA⁻¹r of each column, for what the classic method leaves out of the basis, (n_modes,)."""
    return np.sum(forces * np.linalg.solve(A, forces), axis=0)


def _exact(basis: EnrichedBasis, change: Floats) -> _Solution:
    """The modes of the full matrices."""
    system = basis.system
    R, M = system.mount_motions, system.condensed(system.mass)
    K = system.condensed(system.stiffness + (R.T * change) @ R)
    _, y = scipy.linalg.eigh(K, M, subset_by_value=(-np.inf, (1 + EDGE) * basis.top))
    omega_squared, phi = _lowest(basis, system.stiffness, R, change, system.expanded(y))
    y = system.condensed_shapes(phi)
    residual = np.linalg.norm(
        scipy.linalg.solve_triangular(
            scipy.linalg.cholesky(M, lower=True), K @ y - omega_squared * (M @ y), lower=True
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
