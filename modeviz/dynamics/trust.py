"""Bounds on the error of modes, and a count that tells whether all were found."""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats

EDGE = 1e-6
"""A mode this close, relative in ω², to the top of the band may be counted on either side of it."""


@dataclass(frozen=True, eq=False)
class ErrorEstimate:
    """An estimate of the error of modes without another solve."""

    residual: Floats
    """(n_modes,), ‖Kφ - ω²Mφ‖ in the norm of M⁻¹, rad²/s²: a true ω² lies within it of the mode's."""
    frequency_error_hz: Floats
    """(n_modes,): what the residual implies for the frequency.

    To second order, ω² is too high by rᵀ(K - ω²M)⁻¹r over what the basis leaves out."""
    n_missed: int
    """Modes of the band that Sturm's count finds and that were not found."""


def gap_error(omega_squared: Floats, residual: Floats) -> Floats:
    """The error of ω² that a residual r allows, (n_modes,): r, or r²/gap where the next mode is far.

    After T. Kato and G. Temple (B. N. Parlett, "The Symmetric Eigenvalue Problem", 1980, section 11.7);
    the gap is that to the next mode found.

    Args:
        omega_squared: (n_modes,), rising.
        residual: (n_modes,), see `ErrorEstimate.residual`.
    """
    steps = np.diff(omega_squared, prepend=-np.inf, append=np.inf)
    gap = np.minimum(steps[:-1], steps[1:])
    apart = gap > residual
    return np.where(apart, residual**2 / np.where(apart, gap, 1.0), residual)


def frequency_error(omega_squared: Floats, error: Floats) -> Floats:
    """The error of natural frequencies, (n_modes,), Hz, when ω² is off by `error`."""
    omega = np.sqrt(np.maximum(omega_squared, 0.0))
    return (np.sqrt(omega**2 + error) - omega) / (2 * np.pi)


def count_below(n_base: int, top_receptance: Floats, change: Floats) -> int:
    """The number of modes that a system has below a frequency after its springs have changed.

    Sturm's count, the negative eigenvalues of K + RᵀΔR - ω²M, from that before the change and a matrix
    of the size of the springs: n = n₀ + n₊(Δ⁻¹ + G) - n₊(Δ), because inertia adds up over the two ways
    to eliminate from [K - ω²M, Rᵀ; R, -Δ⁻¹] (E. V. Haynsworth, "Determination of the inertia of a
    partitioned Hermitian matrix", 1968).

    Args:
        n_base: n₀, how many there were.
        top_receptance: G = R(K - ω²M)⁻¹Rᵀ at that frequency, (n_springs, n_springs).
        change: Δ, (n_springs,), N/m.
    """
    changed = np.flatnonzero(change)
    G, delta = top_receptance[np.ix_(changed, changed)], change[changed]
    weight = 1 / (1 + np.abs(delta) * np.abs(np.diag(G)))
    t = np.sqrt(np.abs(delta) * weight)
    inertia = np.linalg.eigvalsh(np.diag(np.sign(delta) * weight) + t[:, None] * G * t)
    return n_base + int((inertia > 0).sum()) - int((delta > 0).sum())


def missed(n_counted: int, omega_squared: Floats, top: float) -> int:
    """Modes that were counted below ω² = `top` and are not among those found, `omega_squared`."""
    n_found = int((omega_squared < top).sum())
    n_doubtful = int((np.abs(omega_squared - top) < EDGE * top).sum())
    return max(abs(n_counted - n_found) - n_doubtful, 0)
