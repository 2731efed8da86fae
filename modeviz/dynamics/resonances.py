"""Resonances of a vehicle and their sharpness, to place the lines at which it is solved."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.band import band_modes
from modeviz.dynamics.basis import EnrichedBasis
from modeviz.dynamics.modes import Modes, damping_ratio, vibrating_roots
from modeviz.vehicle.arrays import Complexes, Floats

STRONG = 0.25
"""Damping ratio from which a mode's own may mislead, so much does damping couple modes: a strong
damper holds what it joins, and what it holds can ring."""

UNSEEN = 1e-8
"""Part of the power of all modes that a mode may have and yet not matter."""

PARTS = 5
"""Of a half width within which resonances are rounded."""

CLASS = 1.25
"""Factor between damping ratios that are told apart where resonances are rounded."""

MARGIN = 0.1
"""Of the range of a mode's frequency, beyond its ends: where others may be that were not looked at."""

APART = 2.5
"""Half widths of a mode between resonances that stand for it on its way."""

MOST = 100
"""Of these for one mode."""


@dataclass(frozen=True, eq=False)
class Resonances:
    """Frequencies and damping ratios of the modes that vibrate."""

    frequency_hz: Floats
    damping_ratio: Floats
    """(n_modes,) each."""
    shapes: Floats | None = None
    """(n_dofs, n_modes), mass-normalised; None where damping couples modes much."""

    def seen(self, outputs: Floats, inputs: Floats) -> "Resonances":
        """The resonances that can add to what outputs show of forces, all if shapes are not known.

        By the power φ_o² φ_i²/(ζ f) that a mode has from a white force.

        Args:
            outputs: rows (n_outputs, n_dofs).
            inputs: rows (n_inputs, n_dofs), or wider by motions given to rigid joints: these are taken
                to excite all modes alike.
        """
        if self.shapes is None:
            return self
        forces, given = np.split(inputs, [len(self.shapes)], axis=1)
        received = [((forces @ self.shapes) ** 2).sum(axis=0)]
        if given.any():
            received.append(np.ones(len(self.frequency_hz)))
        sharpness = np.maximum(self.damping_ratio * self.frequency_hz, np.finfo(float).tiny)
        power = (outputs @ self.shapes) ** 2 * np.array(received)[:, None] / sharpness
        power[..., self.damping_ratio == 0] = 0
        seen = (power > UNSEEN * power.sum(axis=-1, keepdims=True)).any(axis=(0, 1))
        return Resonances(self.frequency_hz[seen], self.damping_ratio[seen])

    def rounded(self) -> "Resonances":
        """The resonances to a part of a half width, so that small changes of rates change nothing."""
        damped = self.damping_ratio > 0
        exponent = np.floor(np.log(np.where(damped, self.damping_ratio, 1.0)) / np.log(CLASS))
        zeta = np.where(damped, CLASS**exponent, 0.0)
        octave = 2.0 ** np.floor(np.log2(np.maximum(self.frequency_hz, np.finfo(float).tiny)))
        step = np.where(damped, zeta * octave / PARTS, 1.0)
        f = np.where(damped, np.round(self.frequency_hz / step) * step, self.frequency_hz)
        return Resonances(f, zeta, self.shapes)


def resonances(modes: Modes, damping: Floats, structural_damping: Floats) -> Resonances:
    """The resonances of modes.

    Args:
        modes: of the band.
        damping: φᵀCφ, (n_modes, n_modes).
        structural_damping: φᵀK_gφ.
    """
    if modes.damping_ratio.max(initial=0.0) < STRONG:
        return Resonances(modes.frequency_hz, modes.damping_ratio, modes.shapes)
    roots, _ = vibrating_roots(damping, np.diag(modes.omega_n_squared) + 1j * structural_damping)
    f = np.asarray(roots.imag / (2 * np.pi), np.float64)
    return Resonances(f, np.asarray(-roots.real / np.abs(roots), np.float64))


def resonances_at(basis: EnrichedBasis, stiffness: Complexes) -> Resonances:
    """The resonances of the band at other mount rates, (n_springs,), complex, N/m."""
    if not basis.law.is_constant:
        band = band_modes(basis, stiffness)
        return resonances(band.modes, band.damping, band.structural_damping)
    change = basis.law.springs(stiffness - basis.mount_stiffness)
    R = basis.spring_motions
    omega_squared, y = np.linalg.eigh(basis.stiffness + (R.T * change.real) @ R)
    y = y[:, omega_squared < basis.top]
    omega = np.sqrt(np.maximum(omega_squared[: y.shape[1]], 0.0))
    stretch = R @ y
    viscous = y.T @ basis.damping_at(stiffness) @ y
    structural = y.T @ basis.structural_damping @ y + (stretch.T * change.imag) @ stretch
    ratio = damping_ratio(omega, np.diag(viscous), np.diag(structural))
    return resonances(Modes(omega / (2 * np.pi), basis.vectors @ y, ratio), viscous, structural)


def swept(every: Sequence[Resonances]) -> Resonances:
    """Resonances that stand side by side wherever those of similar vehicles are.

    Lines for these hold the integrals of all such vehicles, and of those between.

    Args:
        every: those of some of the vehicles.
    """
    n = min(len(r.frequency_hz) for r in every)
    f = np.array([r.frequency_hz[:n] for r in every])
    zeta = np.array([r.damping_ratio[:n] for r in every]).min(axis=0)
    margin = MARGIN * np.ptp(f, axis=0)
    low, high = f.min(axis=0) - margin, f.max(axis=0) + margin
    steps = np.maximum(np.ceil((high - low) / (APART * np.maximum(zeta * low, 1e-9))), 1)
    steps[zeta == 0] = 1
    counts = np.minimum(steps, MOST).astype(int)
    stands = [np.linspace(a, b, c + 1) for a, b, c in zip(low, high, counts, strict=True)]
    return Resonances(np.concatenate(stands).astype(np.float64), np.repeat(zeta, counts + 1))
