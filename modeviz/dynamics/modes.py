"""Natural frequencies, shapes and damping of a system."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

RESOLVED_HZ = 0.05
"""The largest frequency that rounding may give to what moves freely."""


@dataclass(frozen=True, eq=False)
class Modes:
    """Undamped modes in rising order, mass-normalised: φᵀMφ = I."""

    frequency_hz: Floats
    """(n_modes,); zero for what moves freely."""
    shapes: Floats
    """(n_dofs, n_modes)."""
    damping_ratio: Floats
    """(n_modes,), fraction of critical: that of the mode on its own, coupling by damping left out."""

    @property
    def omega_n_squared(self) -> Floats:
        return (2 * np.pi * self.frequency_hz) ** 2


def solve_modes(system: System, n_modes: int | None = None, below_hz: float | None = None) -> Modes:
    """The lowest undamped modes, K φ = ω² M φ.

    Args:
        system: what vibrates.
        n_modes: how many, all if None.
        below_hz: up to which frequency, instead of how many.

    Raises:
        SolveError: the mass matrix is not positive definite, or a spring is so stiff that rounding
            drowns the slow modes.
    """
    _check_resolved(system)
    K, M = system.condensed(system.stiffness), system.condensed(system.mass)
    subset: dict[str, Any] = {"subset_by_index": [0, min(n_modes or len(M), len(M)) - 1]}
    if below_hz is not None:
        subset = {"subset_by_value": [-np.inf, (2 * np.pi * below_hz) ** 2]}
    try:
        omega_squared, y = scipy.linalg.eigh(K, M, check_finite=False, **subset)
    except scipy.linalg.LinAlgError as error:
        raise SolveError(f"the modes cannot be found: {error}") from None
    phi = system.expanded(y)
    omega = np.sqrt(np.maximum(omega_squared, 0.0))
    viscous = np.einsum("ij,ij->j", phi, system.damping @ phi)
    structural = np.einsum("ij,ij->j", phi, system.structural_damping @ phi)
    return Modes(omega / (2 * np.pi), phi, damping_ratio(omega, viscous, structural))


def rounding(system: System) -> float:
    """The error that arithmetic makes in ω², rad²/s²: ε times the largest in the system."""
    return float(np.finfo(np.float64).eps * _omega_squared_alone(system).max())


def _omega_squared_alone(system: System) -> Floats:
    """ω² of each coordinate with all others held, (n_dofs,)."""
    return np.diag(system.stiffness) / np.diag(system.mass)


def _check_resolved(system: System) -> None:
    """Raises SolveError unless slow modes stand out from rounding."""
    omega_squared = _omega_squared_alone(system)
    stiffest = int(omega_squared.argmax())
    if rounding(system) > (2 * np.pi * RESOLVED_HZ) ** 2:
        raise SolveError(
            f"the slow modes drown in rounding: {system.dof_names[stiffest]!r} is held so stiffly that "
            f"alone it rings at {np.sqrt(omega_squared[stiffest]) / (2 * np.pi):.1g} Hz; soften the "
            "stiffest connection there, or make it rigid (rigid = true)"
        )


def damping_ratio(omega: Floats, viscous: Floats, structural: Floats) -> Floats:
    """ζ = (ω φᵀCφ + φᵀK_gφ) / 2ω² of each mode, (n_modes,); zero where ω is.

    Args:
        omega: rad/s.
        viscous: φᵀCφ.
        structural: φᵀK_gφ.
    """
    free = omega < 1e-3
    return np.where(free, 0.0, (viscous * omega + structural) / np.where(free, 1.0, 2 * omega**2))


def vibrating_roots(damping: Floats, stiffness: Complexes) -> tuple[Complexes, Complexes]:
    """The roots λ of (λ²I + λC + K) q = 0 that vibrate, (n_roots,), rising by |λ|, with their q.

    Args:
        damping: C, (n, n), in mass-normalised coordinates.
        stiffness: K, (n, n), with structural damping.

    Returns:
        λ, rad/s, Im λ > 0, and q, (n, n_roots), of no particular size.
    """
    n = len(damping)
    state = np.zeros((2 * n, 2 * n), complex)
    state[:n, n:] = np.eye(n)
    state[n:] = np.hstack([-stiffness, -damping])
    solution = np.linalg.eig(state)
    roots: Complexes = np.asarray(solution.eigenvalues, complex)
    vectors: Complexes = np.asarray(solution.eigenvectors, complex)
    vibrates = roots.imag > 1e-6 * np.abs(roots) + 1e-3
    order = np.flatnonzero(vibrates)[np.argsort(np.abs(roots[vibrates]))]
    return roots[order], vectors[:n, order]
