"""The two roads as formulas; the paper shows their spectra and gives no numbers.

One-sided displacement spectra, m²/Hz, as met at 20 m/s, left and right track. Their shapes are fitted
to the paper's Tables 2 and 3 within what it says of its figures 6 and 7: road 1 differs from left to
right, most from 5 to 10 Hz; road 2 has comparable tracks up to 20 Hz, and spikes from 7 Hz.
"""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import Road
from pickup.parameters import fitted

SPEED = 20.0
"""m/s: the paper's 72 km/h."""
ROAD_1_POWER = 2.441e-06
"""Scale of road 1, m²/Hz: the one free number of its level, chosen so that the optimised mounts lower
the driver's acceleration by the paper's 0.033 g."""
SLAB_FREQUENCY = SPEED / 3.0
"""Hz: tar strips every 3 m."""
FLAT_BELOW = 0.2
"""Hz: the spectra stop rising there."""


@dataclass(frozen=True)
class RoadShapes:
    """The fitted numbers of both roads; phases in rad, that of the left track before the right."""

    left_rise_5_to_10: float = fitted(1.12537, 0, 1.5)
    """Of road 1: what a band adds to the power of a track, as a part of it."""
    right_rise_5_to_10: float = fitted(4.35787, 4, 12)
    left_rise_10_to_17: float = fitted(1.82636, 0, 2)
    right_rise_10_to_17: float = fitted(3.72328, 0, 4)
    coherence_5_to_10: float = fitted(0.838008, 0, 0.9)
    """Of road 1: the square root of the ordinary coherence."""
    phase_5_to_10: float = fitted(4.22741, 0, 6.283)
    coherence_10_to_17: float = fitted(0.689147, 0, 0.9)
    phase_10_to_17: float = fitted(1.97791, 0, 6.283)
    fall_1: float = fitted(0.837592, 0.5, 1.2)
    """Road 1's power falls as (f² + 25)^-fall."""
    spike_1: float = fitted(12.5099, 2, 20)
    """Of road 2: the power of the strips' harmonics by that of the road between them."""
    spike_2: float = fitted(10.8681, 1, 12)
    spike_3: float = fitted(4.87031, 0.5, 8)
    fall_2: float = fitted(2.15982, 1.6, 2.6)
    """Road 2's power falls as f^-fall."""
    right_by_left: float = fitted(1.1556, 0.85, 1.18)
    """Of road 2: the power between the strips."""
    coherent_to_hz: float = fitted(12.9427, 10, 60)
    phase_per_5_hz: float = fitted(-0.106959, -0.15, 0.15)


def roads(shapes: RoadShapes) -> tuple[Road, Road]:
    """Road 1, rough, unlike left and right; road 2, concrete slabs with tar strips."""
    f = np.arange(0.05, 150.025, 0.05, dtype=np.float64)  # 0.1 to 40 Hz from 20 to 144 km/h
    rising = np.maximum(f, FLAT_BELOW)
    return (
        Road("road 1", "Road 1, rough", SPEED, f, road_1(rising, shapes)),
        Road("road 2", "Road 2, tar strips", SPEED, f, road_2(rising, shapes)),
    )


def road_1(f: Floats, s: RoadShapes) -> np.ndarray:
    """Spectrum (n_freqs, 2, 2): the tracks differ in power and are out of phase from 5 to 17 Hz."""
    base = ROAD_1_POWER * (f**2 + 25) ** -s.fall_1 / (1 + (f / 14) ** 6)
    low, high = _band(f, 5, 10, 0.8), _band(f, 10, 17, 1.0)
    left = base * (1 + s.left_rise_5_to_10 * low + s.left_rise_10_to_17 * high)
    right = base * (1 + s.right_rise_5_to_10 * low + s.right_rise_10_to_17 * high)
    coherence = 0.6 * np.exp(-((f / 4) ** 2) + 0.15j)
    coherence = coherence + s.coherence_5_to_10 * low * np.exp(1j * s.phase_5_to_10)
    coherence = coherence + s.coherence_10_to_17 * high * np.exp(1j * s.phase_10_to_17)
    return _spectrum(left, right, coherence)


def road_2(f: Floats, s: RoadShapes) -> np.ndarray:
    """Spectrum (n_freqs, 2, 2): a smooth road with the strips' first three harmonics on both tracks."""
    base = 1.6e-5 * f**-s.fall_2 / (1 + (f / 20) ** 8)
    strips = sum(
        height * np.exp(-0.5 * ((f - m * SLAB_FREQUENCY) / 0.18) ** 2)
        for m, height in enumerate((s.spike_1, s.spike_2, s.spike_3), start=1)
    )
    left, right = base * (1 + strips), s.right_by_left * base * (1 + 0.95 * strips)
    background = 0.95 * np.exp(-((f / s.coherent_to_hz) ** 2))
    coherence = np.minimum(0.995, background + (1 - background) * strips / (1 + strips))
    return _spectrum(left, right, coherence * np.exp(1j * s.phase_per_5_hz * f / 5))


def _band(f: Floats, low: float, high: float, edge: float) -> Floats:
    """One between two frequencies, zero outside, with soft edges."""
    return 0.5 * (np.tanh((f - low) / edge) - np.tanh((f - high) / edge))


def _spectrum(left: Floats, right: Floats, coherence: np.ndarray) -> np.ndarray:
    """From two autospectra and the complex coherence, S_lr / √(S_ll S_rr)."""
    cross = coherence * np.sqrt(left * right)
    return np.stack([np.stack([left, cross], -1), np.stack([cross.conj(), right], -1)], -2)
