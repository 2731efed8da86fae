"""Loads and where their effect is read, as data."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, check_unique, unknown
from modeviz.vehicle.arrays import Complexes, Floats, frozen, frozen_places
from modeviz.vehicle.engine import EngineOrder

WheelLoadKind = Literal["unbalance", "radial force", "lateral force"]

WAVINESS = (1.2, 4.0)
"""From where to where a road's may be: towards 1 a track has no spectrum that falls off; measured roads
have 1.5 to 3."""


@dataclass(frozen=True)
class Roughness:
    """The level of a road surface alike in all directions, as ISO 8608 has it, see `iso_8608`."""

    level: float
    """G_d(n₀), m³, at n₀ = 0.1 cycles/m."""
    waviness: float = 2.0
    """w of G_d(n) = G_d(n₀) (n/n₀)^-w."""
    track_width: float = 0.0
    """m: between the two tracks."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.level) and self.level > 0):
            raise VehicleError(f"roughness: found {self.level:g} m³, expected more than 0")
        low, high = WAVINESS
        if not low <= self.waviness <= high:
            raise VehicleError(f"waviness: found {self.waviness:g}, expected {low:g} to {high:g}")
        if not (np.isfinite(self.track_width) and self.track_width >= 0):
            raise VehicleError(f"track_width: found {self.track_width:g} m, expected zero or more")


@dataclass(frozen=True, eq=False)
class Road:
    """A random road as one-sided spectra of the vertical displacement under the two tracks.

    The spectra are as a vehicle at `speed` meets them; at another speed the same road, constant in
    space, gives S(f; V) = S(f V₀/V; V₀) V₀/V.
    """

    name: str
    label: str
    speed: float
    """V₀, m/s."""
    frequency_hz: Floats
    """(n_freqs,), rising, above zero."""
    spectrum: Complexes
    """(n_freqs, 2, 2) complex, m²/Hz, Hermitian: left and right track, S_lr = E[L R*]."""
    roughness: Roughness | None = None
    """Of which the spectra were made; None: they are a table's."""

    @property
    def is_even(self) -> bool:
        """Whether it shakes nothing."""
        return not self.spectrum.any()

    def __post_init__(self) -> None:
        where = f"road {self.name!r}"
        frozen(self, "frequency_hz", self.frequency_hz, (None,))
        frozen(self, "spectrum", self.spectrum, (len(self.frequency_hz), 2, 2), np.complex128)
        if not (np.isfinite(self.speed) and self.speed > 0):
            raise VehicleError(f"{where}: speed: found {self.speed} m/s, expected more than 0")
        f = self.frequency_hz
        if len(f) < 2 or f[0] <= 0 or (np.diff(f) <= 0).any():
            raise VehicleError(f"{where}: frequency_hz: expected rising values above zero")
        S = self.spectrum
        left, right = S[:, 0, 0].real, S[:, 1, 1].real
        if not np.allclose(S, S.conj().transpose(0, 2, 1)) or (left < 0).any() or (right < 0).any():
            raise VehicleError(f"{where}: spectrum: expected Hermitian matrices, no negative power")
        if (np.abs(S[:, 0, 1]) ** 2 > left * right * (1 + 1e-9)).any():
            raise VehicleError(f"{where}: spectrum: the tracks' coherence is above one")


@dataclass(frozen=True, eq=False)
class WheelLoad:
    """A harmonic load of one wheel; its peak amplitude does not change with frequency.

    unbalance: m e, kg m, rotating in the wheel plane, so that the force is m e ω², vertical and
    fore-aft 90° apart. radial force: vertical at the wheel centre, N. lateral force: at the ground,
    the tyre's trail behind the wheel centre, N.
    """

    name: str
    kind: WheelLoadKind
    tyre: str
    """The name of the tyre of that wheel."""
    amplitude: float
    """Peak: kg m or N."""

    def __post_init__(self) -> None:
        if self.kind not in get_args(WheelLoadKind):
            raise VehicleError(unknown("kind of wheel load", self.kind, get_args(WheelLoadKind)))
        if not (np.isfinite(self.amplitude) and self.amplitude >= 0):
            raise VehicleError(
                f"wheel load {self.name!r}: amplitude: found {self.amplitude}, expected zero or more"
            )


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A one-sided PSD, its unit that of what it is of, squared per Hz."""

    frequency_hz: Floats
    """(n_freqs,), rising, above zero."""
    power: Floats
    """(n_freqs,)."""

    def __post_init__(self) -> None:
        frozen(self, "frequency_hz", self.frequency_hz, (None,))
        frozen(self, "power", self.power, (len(self.frequency_hz),))
        f = self.frequency_hz
        if len(f) < 2 or f[0] <= 0 or (np.diff(f) <= 0).any():
            raise VehicleError("frequency_hz: expected two or more rising values above zero")
        if (self.power < 0).any():
            raise VehicleError(f"psd: found {self.power.min():g}, expected no negative power")


@dataclass(frozen=True, eq=False)
class Force:
    """A force on a point of a body: harmonic, or random where its amplitude is a spectrum."""

    name: str
    body: str
    position: Floats
    """(3,), m; on a flexible body an attachment must be near."""
    direction: Floats
    """(3,), along which it acts; stored with length one."""
    amplitude: float | Spectrum
    """Peak, N, at every frequency; or N²/Hz."""

    @property
    def label(self) -> str:
        """Its name, for people."""
        return self.name

    def __post_init__(self) -> None:
        frozen_places(self, "position", self.position, (3,))
        _check_load(self, f"force {self.name!r}")


BaseQuantity = Literal["displacement", "acceleration"]


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """A motion of the ground under some connections, all alike; without rotation.

    Harmonic, or random where its amplitude is a spectrum.
    """

    name: str
    direction: Floats
    """(3,), along which the ground moves; stored with length one."""
    quantity: BaseQuantity
    """What the amplitude is of."""
    amplitude: float | Spectrum
    """Peak, m or m/s², at every frequency; or m²/Hz or (m/s²)²/Hz."""
    connections: tuple[str, ...] = ()
    """The names of those whose ground ends move; none is every connection to the ground."""

    @property
    def label(self) -> str:
        """Its name, for people."""
        return self.name

    def __post_init__(self) -> None:
        where = f"base motion {self.name!r}"
        if self.quantity not in get_args(BaseQuantity):
            raise VehicleError(
                f"{where}: " + unknown("quantity", self.quantity, get_args(BaseQuantity))
            )
        check_unique(f"{where}: connection", self.connections)
        _check_load(self, where)


def _check_load(load: Force | BaseMotion, where: str) -> None:
    """Raises VehicleError unless it has a direction, made a unit vector here, and an amplitude."""
    frozen(load, "direction", load.direction, (3,))
    length = float(np.linalg.norm(load.direction))
    if length == 0:
        raise VehicleError(
            f"{where}: direction: found three zeros, expected a vector that points somewhere"
        )
    frozen(load, "direction", load.direction / length, (3,))
    amplitude = load.amplitude
    if not isinstance(amplitude, Spectrum) and not (np.isfinite(amplitude) and amplitude >= 0):
        raise VehicleError(f"{where}: amplitude: found {amplitude}, expected zero or more")


RandomLoad = Road | Force | BaseMotion
"""What has a spectrum."""

HarmonicLoad = WheelLoad | Force | BaseMotion | EngineOrder
"""What has one frequency at a time, and a peak amplitude."""


def spectrum_of(load: RandomLoad | HarmonicLoad) -> Spectrum | None:
    """The spectrum that a force or a motion of the ground has; None of all other loads."""
    amplitude = load.amplitude if isinstance(load, Force | BaseMotion) else None
    return amplitude if isinstance(amplitude, Spectrum) else None


@dataclass(frozen=True, eq=False)
class ResponsePoint:
    """A named point whose acceleration is looked at."""

    name: str
    body: str
    position: Floats
    """(3,), m; on a flexible body an attachment must be near."""

    def __post_init__(self) -> None:
        frozen_places(self, "position", self.position, (3,))
