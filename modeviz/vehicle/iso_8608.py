"""Roads without data: the classes of ISO 8608, and the two tracks of a surface alike in all directions.

ISO 8608:2016, "Mechanical vibration - Road surface profiles - Reporting of measured data", fits a
straight line to a track's spectrum on logarithmic axes, G_d(n) = G_d(n₀) (n/n₀)^-w with n in cycles/m,
and names its level at n₀ = 0.1 cycles/m by classes A to H. It gives one track; the other follows if the
surface is isotropic (C. J. Dodds, J. D. Robson, "The description of road surface roughness", J. Sound
Vib. 31, 1973; K. M. A. Kamash, J. D. Robson, "The application of isotropy in road surface modelling",
J. Sound Vib. 57, 1978).
"""

import re
from functools import lru_cache
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, located, quoted
from modeviz.units import UNITS, parse, parse_number
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import WAVINESS, Road, Roughness

REFERENCE = 0.1
"""n₀, cycles/m."""

RoadClass = Literal["A", "B", "C", "D", "E", "F", "G", "H"]

CLASSES: dict[RoadClass, float] = {name: 16e-6 * 4**i for i, name in enumerate(get_args(RoadClass))}
"""G_d(n₀), m³: the geometric mean of each class, whose limits are half and twice that."""

USUAL_ROAD = "ISO C"
"""For a vehicle that says no road: worn pavement."""

DESCRIBED = (0.011, 2.83)
"""Cycles/m: from where to where ISO 8608 describes roads."""

FLAT_BELOW = 0.01
"""Cycles/m: hills and valleys, which are no roughness; the spectrum stays at what it is there, so that
its integral is finite."""

SPATIAL_FREQUENCY = np.geomspace(1e-4, 1e3, 701)
"""Cycles/m, with `FLAT_BELOW` among them; so close that a straight line between two is within 10⁻⁴ of
the coherence."""

_NAME = re.compile(r"ISO(?:[ -]?8608)?[ :]+(.+?)(?:,? +waviness +(\S+))?", re.IGNORECASE)


def isotropic_coherence(spatial_frequency: Floats, distance: float, waviness: float) -> Floats:
    """The cross spectrum of two tracks of an isotropic surface over the spectrum of each.

    The surface has a spectrum Φ(√(n² + m²)) over waves n along and m across the road; a track has
    G(n) = ∫ Φ dm, and two tracks d apart G_lr(n) = ∫ Φ cos(2πmd) dm. With G ∝ n^-w, Φ is a power law
    too, of exponent w + 1, and Basset's integral (M. Abramowitz, I. A. Stegun, 9.6.25) gives the ratio

        γ(n) = 2 (πnd)^(w/2) K_(w/2)(2πnd) / Γ(w/2),

    which for w = 2 is 2πnd K₁(2πnd). It is real, since the surface has no preferred side.

    Args:
        spatial_frequency: n, cycles/m.
        distance: d between the tracks, m.
        waviness: w.

    Returns:
        Like n: 1 for n d = 0, falling to 0.
    """
    from scipy.special import gamma, kv

    x = np.pi * np.asarray(spatial_frequency, float) * abs(distance)
    near = x < 1e-9
    order, x = waviness / 2, np.where(near, 1.0, x)
    return np.where(near, 1.0, 2 * x**order * kv(order, 2 * x) / gamma(order))


def track_spectrum(roughness: Roughness, spatial_frequency: Floats) -> Floats:
    """G_d(n) of each track, m²/(cycle/m), one-sided: the line of ISO 8608, flat below `FLAT_BELOW`."""
    n = np.maximum(spatial_frequency, FLAT_BELOW)
    return roughness.level * (n / REFERENCE) ** -roughness.waviness


def fitted_waviness(frequency: Floats, power: Floats) -> float:
    """The waviness of the power law nearest to a spectrum on logarithmic axes, within `WAVINESS`."""
    seen = power > 0
    if seen.sum() < 2:
        return 2.0
    slope = np.polyfit(np.log(frequency[seen]), np.log(power[seen]), 1)[0]
    return float(np.clip(-slope, *WAVINESS))


def rough_road(name: str, label: str, roughness: Roughness) -> Road:
    """The road of a roughness: two tracks with the same spectrum, a track width apart.

    Its table is that of a vehicle at 1 m/s, so that its hertz are cycles/m. Where the spectrum is flat,
    the coherence stays too, which is within 0.003 of that of an isotropic surface with such a spectrum.
    """
    n = SPATIAL_FREQUENCY
    S = track_spectrum(roughness, n)
    rough = np.maximum(n, FLAT_BELOW)
    S_lr = S * isotropic_coherence(rough, roughness.track_width, roughness.waviness)
    spectrum = np.array([[S, S_lr], [S_lr, S]], complex).transpose(2, 0, 1)
    return Road(name, label, 1.0, n, spectrum, roughness)


@lru_cache(maxsize=64)
def named_road(name: str, track_width: float) -> Road | None:
    """The road that a name means, such as "ISO C" or "ISO 8608 100 cm³, waviness 2.3"; None: no such.

    Args:
        name: of a class, or G_d(n₀) with its unit.
        track_width: m.

    Raises:
        VehicleError: it begins so, and goes on with no class, level or waviness that there is.
    """
    words = _NAME.fullmatch(name.strip())
    if words is None:
        return None
    with located(f"road {quoted(name)}"):
        level = _level(words[1])
        waviness = 2.0 if words[2] is None else parse_number(words[2])
        roughness = Roughness(level, waviness, track_width)
    return rough_road(name, name, roughness)


def _level(text: str) -> float:
    """G_d(n₀), m³, of a class or a number with its unit.

    Raises:
        ModevizError: it is neither.
    """
    by_class = next((mean for name, mean in CLASSES.items() if name == text.upper()), None)
    if by_class is not None:
        return by_class
    if text[0].isalpha():
        units = ", ".join(UNITS["roughness"])
        raise VehicleError(
            f"found {quoted(text)}, expected a class from A to H, or G_d(n₀) as a number and one of "
            f"{units}"
        )
    return parse(text, "roughness")
