"""What of a quantity per unit of each input an engineer reads: PSD and RMS, or amplitude and phase."""

from dataclasses import dataclass

import numpy as np

from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.excitation import Load, input_spectrum
from modeviz.ride.psd import mean_square
from modeviz.vehicle.arrays import Complexes, Floats


@dataclass(frozen=True, eq=False)
class InputSpectra:
    """The one-sided spectra of a load's inputs at lines; of a harmonic load both are one."""

    frequency_hz: Floats
    """(n_freqs,)."""
    at: Complexes
    """(n_freqs, n_inputs, n_inputs)."""
    around: Complexes
    """The same averaged around the lines, for integrals: see `averaged_spectrum`."""

    def psd(self, per_input: Complexes) -> Floats:
        """PSDs (n_freqs, n) of quantities (n_freqs, n, n_inputs); if harmonic their squared peaks."""
        return np.maximum(self.cross(per_input, per_input), 0.0)

    def cross(self, one: Complexes, other: Complexes) -> Floats:
        """Re S_xy of quantities x and y, (n_freqs, n); one of them may be one for all of the other."""
        return ((one @ self.at) * other.conj()).sum(axis=2).real

    def total(self, one: Complexes, other: Complexes, weights: Floats | None = None) -> Floats:
        """∫ w Re S_xy df over all lines, (n,); w is (n_freqs,) or (n_freqs, n), one if None."""
        cross = ((one @ self.around) * other.conj()).sum(axis=2).real
        w = np.ones(1) if weights is None else np.asarray(weights)
        band = float(self.frequency_hz[0]), float(self.frequency_hz[-1])
        return mean_square(self.frequency_hz, cross * (w[:, None] if w.ndim == 1 else w), band)

    def rms(self, per_input: Complexes) -> Floats:
        """Root mean square of quantities (n_freqs, n, n_inputs) over all lines, (n,)."""
        return np.sqrt(np.maximum(self.total(per_input, per_input), 0.0))


def input_spectra(load: Load, frequency_hz: Floats, speed: float) -> InputSpectra:
    """The spectra of a load's inputs.

    Args:
        load: random or harmonic.
        frequency_hz: (n_freqs,), rising.
        speed: on a road, m/s.

    Raises:
        ModevizError: its table does not reach that far.
    """
    f = np.asarray(frequency_hz, float)
    return InputSpectra(f, input_spectrum(load, f, speed), averaged_spectrum(load, f, speed))
