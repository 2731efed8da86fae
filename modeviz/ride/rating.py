"""Ride ratings: the paper's mean personal rating and ISO 2631-1 weighted accelerations."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from modeviz.ride.psd import RIDE_BAND, rms
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats

WHOLE = 1e-9
"""Relative: a band that ends so little below that of the rating is all of it."""

COMFORT_FACTORS = (1.0, 1.0, 1.0)
"""k of x, y, z for the comfort of a seated person, at the seat's surface (ISO 2631-1, 8.2.2.1)."""


@dataclass(frozen=True)
class Rating:
    """A rating of the ride at one point."""

    rms_lateral_g: float
    rms_vertical_g: float
    combined_g: float
    """A = √(lateral² + vertical²)."""
    mean_personal_rating: float
    """MPR = 10.9 - 80 A, ten being the best; it can leave 0 to 10."""
    note: str
    """What to mind about the rating, or nothing."""
    weighted_rms: tuple[float, float, float]
    """ISO 2631-1: x and y with Wd, z with Wk, m/s²."""
    weighted_total: float
    """ISO 2631-1 vibration total value a_v = √Σ(k a_w)², m/s², comfort factors."""


def rate(frequency_hz: Floats, acceleration_psd: Floats, is_known_from_start: bool = True) -> Rating:
    """The rating of a ride from the accelerations at the seat.

    The weightings of ISO 2631-1 are meant for the seat's surface; at the seat track they rate a
    person on a rigid seat.

    Args:
        frequency_hz: (n_freqs,).
        acceleration_psd: (n_freqs, 3) fore-aft, lateral, vertical, g²/Hz.
        is_known_from_start: whether there is nothing to be known below the first frequency.
    """
    _, lateral, vertical = rms(frequency_hz, acceleration_psd)
    combined = float(np.hypot(lateral, vertical))
    rating = mean_personal_rating(combined)
    weighted = weighted_rms(frequency_hz, acceleration_psd)
    return Rating(
        rms_lateral_g=float(lateral),
        rms_vertical_g=float(vertical),
        combined_g=combined,
        mean_personal_rating=rating,
        note=_note(combined, rating, frequency_hz, is_known_from_start),
        weighted_rms=weighted,
        weighted_total=float(np.linalg.norm(np.multiply(COMFORT_FACTORS, weighted))),
    )


def mean_personal_rating(combined_g: float) -> float:
    """MPR = 10.9 - 80 A (Smith, McGehee and Healy 1978, ten-point form of A. E. Duncan).

    Args:
        combined_g: A, g, √(lateral² + vertical²) of the RMS from 0 to 40 Hz.
    """
    return 10.9 - 80.0 * combined_g


def _note(combined_g: float, rating: float, frequency_hz: Floats, is_known_from_start: bool) -> str:
    if combined_g == 0:
        return "nothing that shakes the vehicle gets to this point"
    notes = [_part(float(frequency_hz[0]), float(frequency_hz[-1]), is_known_from_start)]
    if not 0 <= rating <= 10:
        notes.append("outside of the scale from 0 to 10: compare differences, not the value")
    return "; ".join(filter(None, notes))


def _part(low_hz: float, high_hz: float, is_known_from_start: bool) -> str:
    """A note of the part of the band that a rating is of, nothing if of all."""
    low, high = RIDE_BAND
    if is_known_from_start and high_hz >= high * (1 - WHOLE):
        return ""
    return (
        f"of {low_hz:g} to {min(high_hz, high):g} Hz only, where the scale is of {low:g} to {high:g} Hz"
    )


def weighted_rms(frequency_hz: Floats, acceleration_psd: Floats) -> tuple[float, float, float]:
    """Frequency-weighted RMS of x, y and z, m/s²; arguments as `rate`.

    a_w = √∫ W² S df over the frequencies given; ISO 2631-1 looks at 0.5 to 80 Hz.
    """
    squares = squared_weights(frequency_hz)
    band = (frequency_hz[0], frequency_hz[-1])
    x, y, z = rms(frequency_hz, squares * acceleration_psd, band) * STANDARD_GRAVITY
    return float(x), float(y), float(z)


def squared_weights(frequency_hz: Floats) -> Floats:
    """W² of ISO 2631-1 for x, y and z, (n_freqs, 3): Wd horizontally, Wk vertically."""
    return _squared_weights(np.asarray(frequency_hz, np.float64).tobytes())


@lru_cache(maxsize=8)
def _squared_weights(frequency_hz: bytes) -> Floats:
    """Squared weights of x, y, z, (n_freqs, 3), kept for the next rating at the same frequencies."""
    f = np.frombuffer(frequency_hz)
    horizontal, vertical = weight_d(f) ** 2, weight_k(f) ** 2
    return np.column_stack([horizontal, horizontal, vertical])


def weight_k(frequency_hz: Floats) -> Floats:
    """Wk of ISO 2631-1, vertical, at the seat or lying; (n_freqs,), filters of ISO 8041."""
    f = np.asarray(frequency_hz)
    return np.abs(_band_limits(f) * _transition(f, 12.5, 0.63) * _upward_step(f, 2.37, 3.35, 0.91))


def weight_d(frequency_hz: Floats) -> Floats:
    """Wd of ISO 2631-1, horizontal, at the seat or lying; (n_freqs,), filters of ISO 8041."""
    f = np.asarray(frequency_hz)
    return np.abs(_band_limits(f) * _transition(f, 2.0, 0.63))


def _band_limits(f: Floats) -> Complexes:
    """Second-order Butterworth high pass at 0.4 Hz and low pass at 100 Hz."""
    return (1j * f / 0.4) ** 2 / _quadratic(f, 0.4, np.sqrt(0.5)) / _quadratic(f, 100.0, np.sqrt(0.5))


def _transition(f: Floats, corner_hz: float, quality: float) -> Complexes:
    """The filter from acceleration to velocity: level below the corner, falling as 1/f above."""
    return (1 + 1j * f / corner_hz) / _quadratic(f, corner_hz, quality)


def _upward_step(f: Floats, lower_hz: float, upper_hz: float, quality: float) -> Complexes:
    """The filter that rises from (lower/upper)² to one."""
    step = _quadratic(f, lower_hz, quality) / _quadratic(f, upper_hz, quality)
    return step * (lower_hz / upper_hz) ** 2


def _quadratic(f: Floats, corner_hz: float, quality: float) -> Complexes:
    """1 + s/(Q ω₀) + (s/ω₀)² at s = j2πf."""
    s = 1j * f / corner_hz
    return 1 + s / quality + s**2
