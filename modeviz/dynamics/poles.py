"""Natural frequencies with damping, as the poles of receptances."""

from collections.abc import Callable

import numpy as np

from modeviz.dynamics.basis import EnrichedBasis
from modeviz.vehicle.arrays import Complexes

SECANT, ASTRAY = 1e-5, 1e-2
"""Relative to a pole: the first step to it, and how far it may be from where it is looked for."""

BESIDE = 3.0
"""Half widths of a mode beside its pole is what other modes give, without which it stands out."""

CONVERGED = 1e-8
"""Relative step of the secant method, the next of which is far smaller."""

MAX_STEPS = 12
"""Of the secant method, which needs three or four."""

SAME = 1e-7
"""Relative distance of poles that are one."""


def ritz_poles(basis: EnrichedBasis, stiffness: Complexes) -> tuple[Complexes, Complexes]:
    """All poles, complex, Hz, (2 n_vectors,), and their shapes, (n_dofs, 2 n_vectors), with damping.

    They are those of (K + jK_g + jωC - ω²) y = 0 in the enriched basis: of a real frequency's
    equations, so that with structural damping a pole at negative frequency is no image of another.

    Args:
        basis: of the vehicle; it holds the poles of the band, others as well as it can.
        stiffness: (n_springs,), complex rates, N/m.
    """
    R, n = basis.spring_motions, len(basis.stiffness)
    scale = 2 * np.pi * basis.top_hz
    change = basis.law.springs(stiffness - basis.mount_stiffness)
    pencil = np.zeros((2 * n, 2 * n), complex)
    pencil[:n, n:] = np.eye(n)
    K = basis.stiffness + 1j * basis.structural_damping + (R.T * change) @ R
    pencil[n:, :n], pencil[n:, n:] = K / scale**2, 1j * basis.damping_at(stiffness) / scale
    solution = np.linalg.eig(pencil)
    poles: Complexes = np.asarray(solution.eigenvalues, complex)
    y: Complexes = np.asarray(solution.eigenvectors, complex)
    return poles * basis.top_hz, basis.vectors @ y[:n]


def poles_near(
    starts: Complexes, directions: Complexes, along: Callable[[Complexes, Complexes], Complexes]
) -> Complexes:
    """The poles near some frequencies, complex, Hz, rising, each once; no others than were found.

    They are zeros of 1/(vᵀGv - background) by the secant method, in directions v in which they stand
    out from the background that other modes give.

    Args:
        starts: (n_starts,), Hz, near the poles.
        directions: (n_starts, n_rows): v of each.
        along: gives vᵀGv at frequencies in directions, see `receptances_along`.
    """
    step = SECANT * np.abs(starts)
    background = along(starts + 1j * np.maximum(BESIDE * starts.imag, 10 * step), directions)

    def inverse(z: Complexes, open_: np.ndarray) -> Complexes:
        with np.errstate(all="ignore"):  # where nothing stands out there is no pole to be found
            return 1 / (along(z[open_], directions[open_]) - background[open_])

    z, is_open = starts.astype(complex), np.ones(len(starts), bool)
    before, now = inverse(z + 0j + step, is_open), inverse(z, is_open)
    step, found = step.astype(complex), np.zeros(len(starts), bool)
    for _ in range(MAX_STEPS):
        if not is_open.any():
            break
        with np.errstate(all="ignore"):
            step[is_open] *= now / (before - now)
        z = np.where(is_open, z + step, z)
        is_near = np.isfinite(z) & (np.abs(z - starts) < ASTRAY * np.abs(starts))
        found |= is_open & is_near & (np.abs(step) < CONVERGED * np.abs(z))
        goes_on = is_open & is_near & ~found
        before, is_open = now[goes_on[is_open]], goes_on
        now = inverse(z, is_open) if is_open.any() else before
    poles = np.sort(z[found])
    return poles[np.abs(np.diff(poles, prepend=-np.inf)) > SAME * np.abs(poles)]
