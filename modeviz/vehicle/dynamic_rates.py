"""How the rates of rubber depend on frequency: as test rigs tabulate it, or by the formula of a mount.

A mount's complex rate is that at a frequency of reference times a ratio, so that whoever tunes the rate
scales all of it.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Array, Complexes, Floats, frozen

STEP = 1e-4
"""Of a frequency: half the distance over which a slope is taken."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DynamicRates(ABC):
    """The complex rates of a mount over frequency, along its local x, y and z."""

    reference_hz: float
    """At which a mount has the rates of its group."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.reference_hz) and self.reference_hz > 0):
            raise VehicleError(f"reference: found {self.reference_hz} Hz, expected more than 0")
        at_reference = self.complex_rates(np.array([self.reference_hz]))[0].real
        if not (at_reference > 0).all():
            raise VehicleError(
                f"reference: found rates of {at_reference.tolist()} N/m at {self.reference_hz:g} Hz, "
                "expected more than 0: what scales with them could not be told"
            )

    @abstractmethod
    def complex_rates(self, frequency_hz: Array) -> Complexes:
        """Return k (1 + jg) along x, y, z, (n_freqs, 3), N/m or in parts of any one rate.

        A complex frequency λ/2πj is that of a motion e^{λt} that dies away.
        """

    @property
    def loss_factor(self) -> float:
        """That of the vertical rate at the reference; zero where only the stiffness is known."""
        vertical = complex(self.complex_rates(np.array([self.reference_hz]))[0, 2])
        return vertical.imag / vertical.real

    def ratios(self, frequency_hz: Array) -> Complexes:
        """Return complex rates in parts of k (1 + jg), (n_freqs, 3), see `complex_rates`.

        k are the rates at the reference and g is `loss_factor`: where nothing depends on frequency or
        direction the ratios are one.
        """
        at_reference = self.complex_rates(np.array([self.reference_hz]))[0].real
        return self.complex_rates(frequency_hz) / (at_reference * (1 + 1j * self.loss_factor))

    def ratio_slopes(self, frequency_hz: Array) -> Complexes:
        """Return the derivatives of `ratios`, (n_freqs, 3), 1/Hz: the mean of both sides at a bend."""
        h = np.maximum(STEP * np.abs(frequency_hz), np.finfo(np.float64).tiny)
        return (self.ratios(frequency_hz + h) - self.ratios(frequency_hz - h)) / (2 * h[:, None])


@dataclass(frozen=True, eq=False, kw_only=True)
class RateTable(DynamicRates):
    """Complex rates as measured at some frequencies.

    Between these they go straight, as a TABLED1 of Nastran does; beyond the first and the last they
    stay. Off the real axis they go on as straight as beside it, to the first order in the damping.
    """

    frequency_hz: Floats
    """(n,), rising, not below zero."""
    rates: Complexes
    """(n, 3), along x, y, z."""
    amplitude: float | None = None
    """m: of the motion with which they were measured; None: not said."""

    def __post_init__(self) -> None:
        f = np.asarray(self.frequency_hz, np.float64)
        if f.ndim != 1 or not f.size or not (np.diff(f) > 0).all() or f[0] < 0:
            raise VehicleError(f"frequency_hz: found {f.tolist()}, expected rising values from zero on")
        frozen(self, "frequency_hz", f, f.shape)
        rates: Complexes = np.array(self.rates, complex)
        if rates.shape != (f.size, 3) or not np.isfinite(rates).all():
            raise VehicleError(f"rates: expected {f.size} rows of three finite complex numbers")
        if (np.real(rates) < 0).any() or (np.imag(rates) < 0).any():
            raise VehicleError("rates: expected stiffness and loss of zero or more")
        rates.flags.writeable = False
        object.__setattr__(self, "rates", rates)
        super().__post_init__()

    def complex_rates(self, frequency_hz: Array) -> Complexes:
        """Return k (1 + jg) along x, y, z, (n_freqs, 3), see `DynamicRates`."""
        f, off_axis = np.real(frequency_hz), np.imag(frequency_hz)
        on_axis = self._between(f)
        if not off_axis.any():
            return on_axis
        h = STEP * f
        slope = (self._between(f + h) - self._between(f - h)) / (2 * h[:, None])
        return on_axis + 1j * off_axis[:, None] * slope

    def _between(self, frequency_hz: Floats) -> Complexes:
        columns = [np.interp(frequency_hz, self.frequency_hz, column) for column in self.rates.T]
        return np.stack(columns, axis=-1).astype(complex)


@dataclass(frozen=True, eq=False, kw_only=True)
class ThreeParameterRates(DynamicRates):
    """A spring beside a spring and a damper in series: the standard linear solid of C. Zener (1948).

    k (1 + a jf/f_c / (1 + jf/f_c)): from k at rest it rises to k (1 + a), and loses most where
    f = f_c √(1 + a)⁻¹ … f_c.
    """

    stiffening: Floats
    """a, (3,), along x, y, z: the rate of the spring in series in parts of the other."""
    corner_hz: float
    """f_c: where the damper is as stiff as its spring."""

    def __post_init__(self) -> None:
        frozen(self, "stiffening", self.stiffening, (3,))
        if not (np.isfinite(self.stiffening) & (self.stiffening >= 0)).all():
            raise VehicleError(f"stiffening: found {self.stiffening.tolist()}, expected zero or more")
        if not (np.isfinite(self.corner_hz) and self.corner_hz > 0):
            raise VehicleError(f"corner: found {self.corner_hz} Hz, expected more than 0")
        super().__post_init__()

    def complex_rates(self, frequency_hz: Array) -> Complexes:
        """Return k (1 + jg) along x, y, z, (n_freqs, 3), in parts of the rates at rest."""
        s = 1j * np.asarray(frequency_hz)[:, None] / self.corner_hz
        return 1 + self.stiffening * s / (1 + s)


@dataclass(frozen=True, eq=False, kw_only=True)
class HydraulicRates(DynamicRates):
    """A rubber mount filled with fluid, which flows through an inertia track; vertical alone.

    k_r (1 + jg) + k_b z / (k_b + z), z = (A_p/A_t)² (-ω² m + jω c): the track's fluid swings on the
    bulge of the upper chamber, the lower one gives way (W. C. Flower, "Understanding hydraulic mounts
    for improved vehicle noise, vibration and ride qualities", SAE 850975, 1985; R. Singh, G. Kim,
    P. V. Ravindra, "Linear analysis of automotive hydro-mechanical mount with emphasis on decoupler
    characteristics", Journal of Sound and Vibration 158(2), 1992).
    """

    rubber: float
    """k_r, N/m: of the rubber alone."""
    rubber_loss: float
    """g of the rubber, along all axes."""
    bulge_stiffness: float
    """k_b, N/m: of the upper chamber, as the piston feels it."""
    track_mass: float
    """m, kg: of the fluid in the track."""
    track_damping: float
    """c, N s/m: of the flow in the track."""
    area_ratio: float
    """A_p/A_t: how much faster the fluid is in the track than the piston."""

    def __post_init__(self) -> None:
        for name in ("rubber", "bulge_stiffness", "track_mass", "area_ratio"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise VehicleError(f"{name}: found {getattr(self, name)}, expected more than 0")
        for name in ("rubber_loss", "track_damping"):
            if not (np.isfinite(getattr(self, name)) and getattr(self, name) >= 0):
                raise VehicleError(f"{name}: found {getattr(self, name)}, expected zero or more")
        super().__post_init__()

    def complex_rates(self, frequency_hz: Array) -> Complexes:
        """Return k (1 + jg) along x, y, z, (n_freqs, 3), N/m; across it in parts of the rubber's."""
        omega = 2 * np.pi * np.asarray(frequency_hz)
        z = self.area_ratio**2 * (1j * omega * self.track_damping - omega**2 * self.track_mass)
        rubber = np.full(len(omega), self.rubber * (1 + 1j * self.rubber_loss))
        fluid = self.bulge_stiffness * z / (self.bulge_stiffness + z)
        return np.stack([rubber, rubber, rubber + fluid], axis=-1)
