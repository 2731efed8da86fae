"""A mass on a tyre over ground whose acceleration is given, and its theory."""

import numpy as np
from small_vehicles import tyre, wheel

from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import ResponsePoint, Road
from modeviz.vehicle.vehicle import Vehicle

MASS, LEVEL = 40.0, 1e-3
"""kg, and g²/Hz: of the ground's acceleration at 1 Hz."""


def oscillator(natural_hz: float, zeta: float, slope: float = 0.0, **band) -> Vehicle:
    """A mass on a tyre, over ground whose acceleration has a PSD of `LEVEL` f^slope."""
    body, omega = wheel("wheel", y=0.5, mass=MASS), 2 * np.pi * natural_hz
    spring = tyre(
        body,
        stiffness=np.array([0, 0, MASS * omega**2]),
        damping=np.array([0, 0, 2 * zeta * MASS * omega]),
    )
    f = np.geomspace(1e-3, 1e3, 50)
    spectrum = np.zeros((len(f), 2, 2))
    spectrum[:, 1, 1] = LEVEL * f**slope * STANDARD_GRAVITY**2 / (2 * np.pi * f) ** 4
    point = ResponsePoint("hub", "wheel", body.center_of_gravity)
    road = Road("road", "Road", 20.0, f, spectrum)
    return Vehicle("oscillator", (body,), (spring,), response_points=(point,), roads=(road,), **band)


def transmitted(f: np.ndarray, natural_hz: float, zeta: float, slope: float = 0.0) -> np.ndarray:
    """The PSD of the mass: (1 + (2ζr)²) / ((1 - r²)² + (2ζr)²) times that of the ground."""
    r = f / natural_hz
    return LEVEL * f**slope * (1 + (2 * zeta * r) ** 2) / ((1 - r**2) ** 2 + (2 * zeta * r) ** 2)
