"""Accelerations out of frequency responses: spectra, RMS values, harmonic peaks and decibels."""

import numpy as np

from modeviz.ride.integration import integration_weights
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats

RIDE_BAND = (0.0, 40.0)
"""Hz: over which the paper's RMS values are taken."""

FLOOR = 1e-20
"""Power that is drawn where there is none: -200 dB."""


def acceleration_psd(
    frequency_hz: Floats, frequency_response: Complexes, input_psd: Complexes
) -> Floats:
    """Acceleration PSD of each output, (..., n_freqs, n_outputs), g²/Hz: ω⁴ times that of displacement.

    Args:
        frequency_hz: (n_freqs,).
        frequency_response: displacements per input, (..., n_freqs, n_outputs, n_inputs).
        input_psd: (n_freqs, n_inputs, n_inputs).
    """
    # Where coherent tracks cancel, rounding can leave a power just below zero.
    return np.maximum(averaged_acceleration_psd(frequency_hz, frequency_response, input_psd), 0.0)


def averaged_acceleration_psd(
    frequency_hz: Floats, frequency_response: Complexes, input_psd: Complexes
) -> Floats:
    """Acceleration PSD around lines, of an `averaged_spectrum`: for integrals, it may be negative."""
    H = frequency_response
    S_xx = (H @ input_psd * H.conj()).real.sum(axis=-1)
    omega = 2 * np.pi * np.asarray(frequency_hz)[:, None]
    return omega**4 * S_xx / STANDARD_GRAVITY**2


def harmonic_acceleration(frequency_hz: Floats, displacement: Complexes) -> Floats:
    """Peak acceleration, g, of harmonic displacements whose first axis is frequency, peak in m."""
    omega = 2 * np.pi * np.asarray(frequency_hz)
    return (np.abs(displacement).T * omega**2 / STANDARD_GRAVITY).T


def rms(frequency_hz: Floats, psd: Floats, band: tuple[float, float] = RIDE_BAND) -> Floats:
    """Root of the mean square over a band; arguments as `mean_square`."""
    return np.sqrt(np.maximum(mean_square(frequency_hz, psd, band), 0.0))


def mean_square(frequency_hz: Floats, psd: Floats, band: tuple[float, float] = RIDE_BAND) -> Floats:
    """The integral of a one-sided PSD over a band; see `integration_weights` for how.

    Args:
        frequency_hz: (n_freqs,), rising.
        psd: (n_freqs, ...), unit²/Hz.
        band: Hz; only the part that `frequency_hz` covers counts.

    Returns:
        (...), unit².
    """
    return np.tensordot(integration_weights(np.asarray(frequency_hz), band), psd, 1)


def power_decibels(psd: Floats) -> Floats:
    """10 log₁₀ of a power, a PSD re 1 g²/Hz; not below that of `FLOOR`."""
    return 10 * np.log10(np.maximum(psd, FLOOR))


def amplitude_decibels(amplitude: Floats) -> Floats:
    """20 log₁₀ of an amplitude, a peak acceleration re 1 g; not below -200 dB."""
    return power_decibels(np.square(amplitude))
