"""The two roads as formulas; the paper shows their spectra and gives no numbers.

One-sided displacement spectra, m²/Hz, as met at 20 m/s, left and right track.
"""

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import Road

SPEED = 20.0
"""m/s: the paper's 72 km/h."""
ROAD_1_POWER = 3.7e-5 * 0.07803
"""Scale of road 1, m²/Hz: the one free number of its level, chosen so that the optimised mounts lower
the driver's acceleration by the paper's 0.033 g."""
SLAB_FREQUENCY = SPEED / 3.0
"""Hz: tar strips every 3 m."""
FLAT_BELOW = 0.2
"""Hz: the spectra stop rising there."""


def roads() -> tuple[Road, Road]:
    """Road 1, rough, its tracks in opposition; road 2, concrete slabs with tar strips."""
    f = np.arange(0.05, 150.025, 0.05, dtype=np.float64)  # 0.1 to 40 Hz from 20 to 144 km/h
    return (
        Road("road 1", "Road 1, rough", SPEED, f, road_1(np.maximum(f, FLAT_BELOW))),
        Road("road 2", "Road 2, tar strips", SPEED, f, road_2(np.maximum(f, FLAT_BELOW))),
    )


def road_1(f: Floats) -> np.ndarray:
    """Spectrum (n_freqs, 2, 2): the right track is rougher, and from 5 to 17 Hz the two oppose."""
    base = ROAD_1_POWER * (f**2 + 25) ** -0.8 / (1 + (f / 14) ** 6)
    low, high = _band(f, 5, 10, 0.8), _band(f, 10, 17, 1.0)
    left = base * (1 + 1.0 * low + 0.5 * high)
    right = base * (1 + 5.0 * low + 2.5 * high)
    coherence = 0.6 * np.exp(-((f / 4) ** 2)) - 0.85 * low - 0.5 * high
    return _spectrum(left, right, coherence * np.exp(0.15j))


def road_2(f: Floats) -> np.ndarray:
    """Spectrum (n_freqs, 2, 2): a smooth road with the strips' first three harmonics on both tracks."""
    base = 1.6e-5 * f**-2.1 / (1 + (f / 20) ** 8)
    strips = sum(
        height * np.exp(-0.5 * ((f - m * SLAB_FREQUENCY) / 0.18) ** 2)
        for m, height in enumerate((12.0, 5.0, 3.0), start=1)
    )
    left, right = base * (1 + strips), 1.1 * base * (1 + 0.95 * strips)
    background = 0.95 * np.exp(-((f / 25) ** 2))
    coherence = np.minimum(0.995, background + (1 - background) * strips / (1 + strips))
    return _spectrum(left, right, coherence * np.exp(-0.03j * f / 5))


def _band(f: Floats, low: float, high: float, edge: float) -> Floats:
    """One between two frequencies, zero outside, with soft edges."""
    return 0.5 * (np.tanh((f - low) / edge) - np.tanh((f - high) / edge))


def _spectrum(left: Floats, right: Floats, coherence: np.ndarray) -> np.ndarray:
    """From two autospectra and the complex coherence, S_lr / √(S_ll S_rr)."""
    cross = coherence * np.sqrt(left * right)
    return np.stack([np.stack([left, cross], -1), np.stack([cross.conj(), right], -1)], -2)
