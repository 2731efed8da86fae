"""Loads and where their effect is read, as data."""

from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.arrays import Complexes, Floats, frozen

WheelLoadKind = Literal["unbalance", "radial force", "lateral force"]


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
class ResponsePoint:
    """A named point whose acceleration is looked at."""

    name: str
    body: str
    position: Floats
    """(3,), m; on a flexible body an attachment must be near."""

    def __post_init__(self) -> None:
        frozen(self, "position", self.position, (3,))
