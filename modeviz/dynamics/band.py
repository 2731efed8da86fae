"""The modes of the band at other mount rates.

In the enriched basis, in the base modes alone, or from the full matrices, and how good they are. Where
rates depend on frequency, each mode is solved at its own.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy.linalg

from modeviz.dynamics.basis import REACH, EnrichedBasis
from modeviz.dynamics.modes import RESOLVED_HZ, Modes, damping_ratio
from modeviz.dynamics.mount_rates import mounts_of_springs
from modeviz.dynamics.own_frequency import (
    Pencil,
    full_pencil,
    own_frequencies,
    own_modes,
    ritz_pencil,
)
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
    """φᵀCφ, (n_modes, n_modes): damping couples modes. With `dispersion`, in parts of its roots."""
    structural_damping: Floats
    """φᵀK_gφ, (n_modes, n_modes), likewise; between two modes the mean of what each one has."""
    springs: Complexes
    """(n_modes or 1, n_springs), N/m: the complex rates of mount springs, at each mode's own frequency
    where they depend on it."""
    dispersion: Floats
    """(n_modes,): 1 - φᵀ ∂K/∂ω² φ, the part of a mode's mass that is left where stiffness rises with
    frequency. What drives or damps the mode does so as if its mass were that."""
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
    at_top = basis.change(stiffness, np.array([basis.top_hz]))[0].real
    _check_resolved(basis, at_top)
    solution = _solution(basis, stiffness, method)
    omega, stretch = np.sqrt(np.maximum(solution.omega_squared, 0.0)), solution.stretch
    f = omega / (2 * np.pi)
    change = basis.change(stiffness, f)
    dispersion = 1 - _stiffening(basis, stiffness, f, stretch)
    root = np.sqrt(np.multiply.outer(dispersion, dispersion))
    viscous = solution.damping / root
    structural = (
        solution.structural + _mean_of_both(np.asarray(change.imag, np.float64), stretch)
    ) / root
    n_counted = count_below(basis.n_below, basis.top_receptance, at_top)
    trust = ErrorEstimate(
        solution.residual,
        frequency_error(solution.omega_squared, solution.error + basis.rounding),
        missed(n_counted + solution.n_against, solution.omega_squared, basis.top),
    )
    modes = Modes(f, solution.shapes, damping_ratio(omega, np.diag(viscous), np.diag(structural)))
    springs = basis.law.stiffness(stiffness, f)
    return BandModes(modes, viscous, structural, springs, dispersion, trust, solution.ritz)


def _mean_of_both(loss: Floats, stretch: Floats) -> Floats:
    """φᵀRᵀ Im Δ Rφ, (n_modes, n_modes), from Im Δ (n_modes or 1, n_springs) of each mode."""
    one_way = stretch.T @ (loss.T * stretch)
    return (one_way + one_way.T) / 2


def _stiffening(
    basis: EnrichedBasis, stiffness: Complexes, frequency_hz: Floats, stretch: Floats
) -> Floats:
    """φᵀ ∂K/∂ω² φ of each mode, (n_modes,), with ∂/∂ω² = 1/(8π²f) ∂/∂f; zero for what moves freely."""
    slopes = (basis.law.springs(stiffness) * basis.law.slopes(frequency_hz)).real
    rising = np.sum(slopes.T * stretch**2, axis=0)
    f = np.maximum(frequency_hz, RESOLVED_HZ)
    return np.where(frequency_hz > RESOLVED_HZ, rising / (8 * np.pi**2 * f), 0.0)


def modes_above(basis: EnrichedBasis, stiffness: Complexes, band: BandModes) -> Modes:
    """The modes of the basis above those of the band, as well as it holds them, in its vectors.

    Up to `REACH` times the band they are modes of the vehicle, the others what stands for the rest.

    Args:
        basis: of the vehicle.
        stiffness: (n_springs,), complex rates, N/m.
        band: its modes at these rates.
    """
    change = basis.change(stiffness, np.array([basis.top_hz]))[0]
    R = basis.spring_motions
    omega_squared, y = band.ritz or np.linalg.eigh(basis.stiffness + (R.T * change.real) @ R)
    n_band = len(band.modes.frequency_hz)
    omega, y = np.sqrt(np.maximum(omega_squared[n_band:], 0.0)), y[:, n_band:]
    structural = _quadratic(basis.structural_damping, y) + change.imag @ (R @ y) ** 2
    ratio = damping_ratio(omega, _quadratic(basis.damping_at(stiffness), y), structural)
    return Modes(omega / (2 * np.pi), y, ratio)


def natural_frequencies(basis: EnrichedBasis, stiffness: Complexes) -> Floats:
    """The lowest natural frequencies, Hz, as many as the band has at the base rates.

    At other mount rates; cheaper than `band_modes`, without shapes; arguments as there.
    """
    change = basis.change(stiffness, np.array([basis.top_hz]))[0].real
    _check_resolved(basis, change)
    if basis.law.is_constant:
        R = basis.spring_motions
        omega_squared = np.linalg.eigvalsh(basis.stiffness + (R.T * change) @ R)[: basis.n_below]
    else:
        omega_squared = own_frequencies(ritz_pencil(basis, stiffness), basis.n_below, basis.top)
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
    n_against: int = 0
    """See `own_modes`."""


def _solution(basis: EnrichedBasis, stiffness: Complexes, method: Method) -> _Solution:
    """The modes of the band, by that method."""
    if method == "exact":
        return _exact(basis, stiffness)
    n = basis.n_modes if method == "classic" else basis.vectors.shape[1]
    return _ritz(basis, stiffness, n)


def _ritz(basis: EnrichedBasis, stiffness: Complexes, n: int) -> _Solution:
    """The modes within the first vectors of the basis."""
    pencil, ritz, n_against = ritz_pencil(basis, stiffness, n), None, 0
    if basis.law.is_constant:
        roughly, every = np.linalg.eigh(pencil.at(basis.top_hz))
        y = every[:, roughly < 2 * basis.top]
        omega_squared, y = _lowest(pencil, basis.top, y)
        ritz = (roughly, every) if n == basis.vectors.shape[1] else None
    else:
        omega_squared, y, n_against = own_modes(pencil, basis.top)
    stretch = pencil.motions @ y
    change = basis.change(stiffness, np.sqrt(np.maximum(omega_squared, 0.0)) / (2 * np.pi)).real
    inside = basis.stiffness[:, :n] @ y + basis.spring_motions.T @ (change.T * stretch)
    inside[:n] -= omega_squared * y
    outside = basis.remainder[:, :n] @ y + basis.spring_remainder @ (change.T * stretch)
    left_out = ritz_pencil(basis, stiffness).at(basis.top_hz)[n:, n:]
    return _Solution(
        omega_squared,
        basis.vectors[:, :n] @ y,
        stretch,
        y.T @ basis.damping_at(stiffness)[:n, :n] @ y,
        y.T @ basis.structural_damping[:n, :n] @ y,
        np.hypot(np.linalg.norm(inside, axis=0), np.linalg.norm(outside, axis=0)),
        _amplification(basis, omega_squared)
        * (_quadratic(basis.remainder_compliance, outside) + _compliance_of(left_out, inside[n:])),
        ritz,
        n_against,
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


def _exact(basis: EnrichedBasis, stiffness: Complexes) -> _Solution:
    """The modes of the full matrices."""
    system, pencil, n_against = basis.system, full_pencil(basis, stiffness), 0
    M = system.condensed(system.mass)
    if basis.law.is_constant:
        K, below = pencil.at(basis.top_hz), (-np.inf, (1 + EDGE) * basis.top)
        _, y = scipy.linalg.eigh(K, M, subset_by_value=below)
        omega_squared, y = _lowest(pencil, basis.top, y)
    else:
        omega_squared, y, n_against = own_modes(pencil, basis.top)
    stretch = pencil.motions @ y
    change = basis.change(stiffness, np.sqrt(np.maximum(omega_squared, 0.0)) / (2 * np.pi)).real
    forces = pencil.stiffness @ y + pencil.motions.T @ (change.T * stretch)
    unbalanced = forces - omega_squared * (M @ y)
    residual = np.linalg.norm(
        scipy.linalg.solve_triangular(scipy.linalg.cholesky(M, lower=True), unbalanced, lower=True),
        axis=0,
    )
    phi = system.expanded(y)
    return _Solution(
        omega_squared,
        phi,
        stretch,
        phi.T @ system.damping @ phi + (stretch.T * basis.damping_change(stiffness)) @ stretch,
        phi.T @ system.structural_damping @ phi,
        residual,
        gap_error(omega_squared, residual),
        n_against=n_against,
    )


def _lowest(pencil: Pencil, top: float, vectors: Floats) -> tuple[Floats, Floats]:
    """The vectors of the band in rising order, with Rayleigh's quotient of each.

    Base and change are summed apart: a spring that is practically rigid makes the eigenvalues of the
    sum inexact, but hardly stretches.
    """
    change = pencil.change(np.sqrt(top) / (2 * np.pi))
    omega_squared = _quadratic(pencil.stiffness, vectors) + change @ (pencil.motions @ vectors) ** 2
    order = np.argsort(omega_squared, kind="stable")
    order = order[omega_squared[order] < top]
    return omega_squared[order], vectors[:, order]


def _quadratic(A: Floats, vectors: Floats) -> Floats:
    """xᵀAx of each column x."""
    return np.einsum("ij,ij->j", vectors, A @ vectors)
