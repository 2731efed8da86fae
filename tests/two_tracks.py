"""Roads in time, to hold spectra against."""

import numpy as np

from modeviz.ride.roads import road_spectrum
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import Road


def two_track_profile(
    road: Road, speed: float, duration: float, sample_rate: float, seed: int
) -> Floats:
    """A Gaussian profile in time with the spectra of a road, (n_samples, 2), m: left and right track.

    Fourier coefficients are drawn as S = L Lᴴ, X = L w with complex white noise w, so the profile is
    periodic over its duration and has no power outside of the road's table.

    Args:
        road: whose spectra.
        speed: of the vehicle that meets it, m/s.
        duration: s.
        sample_rate: 1/s.
        seed: the same seed gives the same profile.
    """
    n_samples = round(duration * sample_rate)
    f = np.arange(n_samples // 2 + 1, dtype=np.float64) * (sample_rate / n_samples)
    low, high = road.frequency_hz[[0, -1]] * speed / road.speed
    inside = (f >= low) & (f <= high)
    S = road_spectrum(road, f[inside], speed)
    parts = np.random.default_rng(seed).standard_normal((2, len(S), 2))
    w = (parts[0] + 1j * parts[1]) / np.sqrt(2)
    X = np.zeros((len(f), 2), complex)
    X[inside] = np.einsum("fij,fj->fi", _root(S), w) * np.sqrt(n_samples * sample_rate / 2)
    return np.fft.irfft(X, n_samples, axis=0)


def _root(S: Complexes) -> Complexes:
    """L with S = L Lᴴ, also where S is singular: coherent tracks, or one without power."""
    power, U = np.linalg.eigh(S)
    return U * np.sqrt(np.maximum(power, 0.0))[:, None, :]
