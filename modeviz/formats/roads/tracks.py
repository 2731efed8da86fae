"""The two tracks of a surface as spectra along the road.

P. D. Welch, "The use of fast Fourier transform for the estimation of power spectra", IEEE Trans. Audio
Electroacoust. 15, 1967: Hann windows that overlap by half, each with its straight line taken out.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.signal import csd, detrend

from modeviz.errors import VehicleError
from modeviz.formats.roads.crg import Surface
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.iso_8608 import DESCRIBED, REFERENCE, fitted_waviness

WINDOWS = 4
"""A road is at least so many times as long as a window."""

LONGEST_WINDOW = 250.0
"""m: waves that are longer are hills."""

FEWEST_ROWS = 64

LARGEST_GAP = 0.5
"""m, along a track, over which unknown heights are taken from those beside them."""


@dataclass(frozen=True, eq=False)
class TrackSpectra:
    """One-sided spectra over cycles/m."""

    spatial_frequency: Floats
    """(n_freqs,), rising, cycles/m."""
    spectrum: Complexes
    """(n_freqs, 2, 2), m²/(cycle/m): left and right, S_lr = E[L R*]."""
    rms: tuple[float, float]
    """m: of left and right, without their straight line."""
    length: float
    """m: of the part of the road that was taken."""
    width: float
    """m: between the tracks as they were taken."""

    def fit(self) -> tuple[float, float]:
        """Return G_d(n₀), m³, and the waviness of the line of ISO 8608 nearest to both tracks."""
        n = self.spatial_frequency
        seen = (n >= DESCRIBED[0]) & (n <= DESCRIBED[1])
        seen = seen if seen.sum() > 1 else np.ones(len(n), bool)
        power = np.einsum("nii->n", self.spectrum.real)[seen] / 2
        waviness = fitted_waviness(n[seen], power)
        known = power > 0
        if not known.any():
            return 0.0, waviness
        level = np.log(power[known]) + waviness * np.log(n[seen][known] / REFERENCE)
        return float(np.exp(level.mean())), waviness


def track_spectra(surface: Surface, width: float, note: Callable[[str], None]) -> TrackSpectra:
    """Return the spectra of two tracks, one on each side of the middle of a surface.

    Args:
        surface: of the road.
        width: m, between the tracks.
        note: told what is left out or taken otherwise.

    Raises:
        VehicleError: it is too short, flat, or has holes.
    """
    middle = float(surface.v[[0, -1]].mean())
    widest = float(np.ptp(surface.v))
    if width > widest:
        note(
            f"the surface is {widest:.4g} m wide: its edges are taken for tracks that are to be "
            f"{width:.4g} m apart"
        )
    width = min(width, widest)
    half = width / 2
    both = np.stack([surface.track(middle + half), surface.track(middle - half)])
    both = _rough_part(_filled(both, surface.increment, note), surface.increment, note)
    n_rows = both.shape[1]
    longest = min(n_rows // WINDOWS, round(LONGEST_WINDOW / surface.increment))
    if longest < FEWEST_ROWS:
        raise VehicleError(
            f"has {n_rows} heights along {surface.increment * n_rows:.4g} m of rough road, expected "
            f"{WINDOWS * FEWEST_ROWS} at least"
        )
    left, right = both
    settings = {
        "fs": 1 / surface.increment,
        "nperseg": longest,
        "detrend": "linear",
    }
    n, S_ll = csd(left, left, **settings)
    S_rr, S_lr = csd(right, right, **settings)[1], csd(right, left, **settings)[1]
    S = np.array([[S_ll, S_lr], [np.conj(S_lr), S_rr]], complex).transpose(2, 0, 1)
    rms = detrend(both).std(axis=1).tolist()
    return TrackSpectra(n[1:], S[1:], (rms[0], rms[1]), surface.increment * (n_rows - 1), width)


def _filled(both: Floats, increment: float, note: Callable[[str], None]) -> Floats:
    """Tracks without unknown heights: those at the ends are left out, small gaps are bridged.

    Raises:
        VehicleError: a gap is large.
    """
    n_rows = both.shape[1]
    places = np.flatnonzero(np.isfinite(both).all(axis=0))
    if not len(places):
        raise VehicleError("has no heights where the tracks are")
    first, last = places[0], places[-1] + 1
    if last - first < n_rows:
        note(f"{n_rows - last + first} cuts at its ends, where heights are missing, are left out")
    gaps = np.diff(places) - 1
    if gaps.max(initial=0) * increment > LARGEST_GAP:
        at = places[int(np.argmax(gaps))]
        raise VehicleError(
            f"has no heights of a track over {gaps.max() * increment:.3g} m, from "
            f"{at * increment:.4g} m on; expected gaps of at most {LARGEST_GAP:g} m"
        )
    if gaps.any():
        note(f"{int(gaps.sum())} heights are missing, and taken between those beside them")
    u = np.arange(first, last)
    return np.stack([np.interp(u, places, track[places]) for track in both])


def _rough_part(both: Floats, increment: float, note: Callable[[str], None]) -> Floats:
    """Tracks without the perfectly even run-in and run-out that proving grounds have.

    Raises:
        VehicleError: they are even throughout.
    """
    bends = np.flatnonzero((np.abs(np.diff(both, 2)) > 1e-12).any(axis=0))
    if not len(bends):
        raise VehicleError("has no roughness: its tracks are straight lines")
    first, last = int(bends[0]), int(bends[-1]) + 3
    even = both.shape[1] - (last - first)
    if even * increment < 1.0:
        return both
    note(
        f"{first * increment:.4g} m at its beginning and {(both.shape[1] - last) * increment:.4g} m at "
        "its end are even, and left out"
    )
    return both[:, first:last]
