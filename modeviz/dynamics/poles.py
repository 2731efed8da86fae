"""Natural frequencies with damping, as the poles of receptances."""

from collections.abc import Callable

import numpy as np

from modeviz.vehicle.arrays import Complexes, Floats

SECANT, ASTRAY = 1e-5, 0.1
"""Relative to a pole: the first step to it, and how far it may be from where it is looked for."""

BESIDE = 3.0
"""Half widths of a mode beside its pole is what other modes give, without which it stands out."""

CONVERGED = 1e-8
"""Relative step of the secant method, the next of which is far smaller."""

MAX_STEPS = 12
"""Of the secant method, which needs three or four."""

SAME = 1e-7
"""Relative distance of poles that are one."""


def poles_near(
    starts: Complexes, directions: Floats, along: Callable[[Complexes, Floats], Complexes]
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
