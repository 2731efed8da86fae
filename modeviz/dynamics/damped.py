"""The modes of the band with their damping: complex shapes, each belonging to an undamped mode.

(λ²I + λC + Ω² + jK_g) y = 0 in the modes of the band says which damped mode is which. What the modes
above the band add through the dampers is found in the enriched basis, for one mode at a time.

Where rates depend on frequency, λ has those at λ/2πj, see `vehicle.dynamic_rates`.
"""

from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.band import BandModes
from modeviz.dynamics.basis import EnrichedBasis
from modeviz.dynamics.modes import RESOLVED_HZ, vibrating_roots
from modeviz.dynamics.tracking import likeliest
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes

MAX_STEPS = 20
"""Of Newton's method, which from the modes of the band needs two or three."""

CONVERGED = 1e-6
"""Relative change of a root: the next would be its square."""


@dataclass(frozen=True, eq=False)
class DampedModes:
    """Damped modes in the modes of the band, each in the place of the undamped one it belongs to."""

    eigenvalue: Complexes
    """λ, (n_modes,), rad/s: motion goes as e^{λt}, Im λ > 0. Zero for what moves freely, not a number
    for what is damped so strongly that it does not vibrate."""
    coordinates: Complexes
    """(n_modes, n_modes): how much of each undamped mode is in it, columns of norm one."""


@dataclass(frozen=True, eq=False)
class DampedMode:
    """A mode with its damping: motion goes as Re(ψ e^{λt})."""

    eigenvalue: complex
    """λ, rad/s, Im λ > 0; zero for what moves freely."""
    shape: Complexes
    """ψ, (n_dofs,), ψᴴMψ = 1, turned so that no other phase has more kinetic energy in its real part;
    without damping it is the undamped shape."""

    @property
    def damped_frequency_hz(self) -> float:
        """Im λ/2π: at which it swings while it dies away."""
        return self.eigenvalue.imag / (2 * np.pi)

    @property
    def damping_ratio(self) -> float:
        """-Re λ/|λ|, with what damping couples to the mode; zero for what moves freely."""
        return -self.eigenvalue.real / (abs(self.eigenvalue) or 1.0)


def damped_modes(band: BandModes) -> DampedModes:
    """The damped modes within the space of the band's, paired with them.

    Pairs are those that have most of each other's kinetic energy, all modes together; where dampers
    mix two in equal parts, as close ones that they couple, the slower belongs to the slower.
    """
    modes, n = band.modes, len(band.modes.frequency_hz)
    K = np.diag(modes.omega_n_squared) + 1j * band.structural_damping
    roots, y = vibrating_roots(band.damping, K)
    rising = np.argsort(roots.imag)
    roots, y = roots[rising], y[:, rising] / np.linalg.norm(y[:, rising], axis=0)
    vibrating = modes.frequency_hz > RESOLVED_HZ
    eigenvalue = np.where(vibrating, complex(np.nan, np.nan), 0)
    coordinates = np.eye(n, dtype=complex)
    undamped, damped = likeliest(np.abs(y[vibrating]) ** 2)
    pair = np.flatnonzero(vibrating)[undamped]
    eigenvalue[pair], coordinates[:, pair] = roots[damped], y[:, damped]
    return DampedModes(eigenvalue, coordinates)


def damped_mode(
    basis: EnrichedBasis, stiffness: Complexes, band: BandModes, damped: DampedModes, mode: int
) -> DampedMode:
    """One of the damped modes, sharpened in the enriched basis.

    Args:
        basis: of the vehicle.
        stiffness: (n_springs,), the complex rates of `band`, N/m.
        band: the undamped modes.
        damped: theirs.
        mode: which, its number among the undamped.

    Raises:
        SolveError: it is damped so strongly that it does not vibrate.
    """
    root = complex(damped.eigenvalue[mode])
    if root == 0:
        return DampedMode(root, band.modes.shapes[:, mode].astype(complex))
    if np.isnan(root):
        raise SolveError(
            f"mode {mode + 1} at {band.modes.frequency_hz[mode]:.2f} Hz is damped so strongly that it "
            "does not vibrate: show it undamped"
        )
    undamped = basis.vectors.T @ basis.system.momentum(band.modes.shapes)
    root, y = _sharpened(basis, stiffness, root, undamped @ damped.coordinates[:, mode])
    y = y * np.exp(-0.5j * np.angle(y @ y)) / np.linalg.norm(y)
    opposed = undamped[:, mode] @ y.real < 0
    return DampedMode(root, basis.vectors @ (-y if opposed else y))


def _sharpened(
    basis: EnrichedBasis, stiffness: Complexes, root: complex, y: Complexes
) -> tuple[complex, Complexes]:
    """The root λ and vector y of (λ²I + λC + K) y = 0 in the enriched basis near those given.

    By Newton's method on both, the part of y along the first one kept (A. Ruhe, "Algorithms for the
    nonlinear eigenvalue problem", SIAM Journal on Numerical Analysis 10(4), 1973).
    """
    R, n, law = basis.spring_motions, len(y), basis.law
    C, springs = basis.damping_at(stiffness), law.springs(stiffness)
    base = basis.stiffness + 1j * basis.structural_damping
    bordered = np.zeros((n + 1, n + 1), complex)
    bordered[n, :n] = y.conj()
    kept = np.append(np.zeros(n), np.linalg.norm(y) ** 2)
    for _ in range(MAX_STEPS):
        f = np.array([root / (2j * np.pi)])
        change = basis.change(stiffness, f)[0]
        slope = springs * law.slopes(f)[0] / (2j * np.pi)
        K = base + (R.T * change) @ R
        bordered[:n, :n] = K + root * C + root**2 * np.eye(n)
        bordered[:n, n] = 2 * root * y + C @ y + R.T @ (slope * (R @ y))
        solution: Complexes = np.asarray(np.linalg.solve(bordered, kept), complex)
        y, step = solution[:n], complex(solution[n])
        root += step
        if abs(step) < CONVERGED * abs(root):
            return root, y
    raise SolveError(
        f"the damped shape of the mode near {abs(root) / (2 * np.pi):.2f} Hz was not found: show it "
        "undamped"
    )
