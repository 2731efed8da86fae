"""A seat on a rough road: is more damping better?

A mass on a spring and a damper rolls over a road whose vertical acceleration is white noise. Damping
calms the resonance and stiffens the ride above it, so there is a best amount. The mean square of the
acceleration is known in closed form, (π/2) f_n W (1 + 4ζ²)/(2ζ): least at ζ = 1/2. Six decades of
frequencies are more than a study looks at, so the functions below it are used.
"""

import numpy as np

import modeviz as mv
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.response import direct_response
from modeviz.ride.psd import acceleration_psd, rms
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.units import STANDARD_GRAVITY

MASS, NATURAL_HZ, SPEED = 300.0, 1.5, 20.0
WHITE = 1e-4  # g²/Hz
DAMPING_RATIOS = (0.1, 0.2, 0.35, 0.5, 0.7, 1.0)
CENTER = np.array([0.0, -0.4, 0.6])

omega_n = 2 * np.pi * NATURAL_HZ
frequency_hz = np.geomspace(1e-3, 1e3, 2000) * NATURAL_HZ
height_psd = WHITE * STANDARD_GRAVITY**2 / (2 * np.pi * frequency_hz) ** 4
road = mv.Road(
    "white",
    "white acceleration",
    SPEED,
    frequency_hz,
    (height_psd[:, None, None] * np.ones((2, 2))).astype(complex),
)


def ride(damping_ratio: float) -> float:
    """RMS acceleration of the mass, g."""
    spring = mv.Tyre(
        "spring",
        "springs",
        ("seat", "ground"),
        points=np.array([CENTER, CENTER]),
        stiffness=np.array([0.0, 0.0, MASS * omega_n**2]),
        damping=np.array([0.0, 0.0, 2 * damping_ratio * omega_n * MASS]),
    )
    seat = mv.RigidBody("seat", "cabin", "seat", MASS, CENTER, 10 * np.eye(3))
    system = assemble(mv.Vehicle("oscillator", (seat,), (spring,)))
    forces = track_forces(system, frequency_hz, SPEED)
    response = direct_response(system, frequency_hz, forces, system.motion("seat", CENTER)[[2]])
    psd = acceleration_psd(frequency_hz, response, road_spectrum(road, frequency_hz, SPEED))
    return float(rms(frequency_hz, psd, band=(frequency_hz[0], frequency_hz[-1]))[0])


def theory(damping_ratio: float) -> float:
    """The same in closed form."""
    zeta = damping_ratio
    return float(np.sqrt(np.pi / 2 * NATURAL_HZ * WHITE * (1 + 4 * zeta**2) / (2 * zeta)))


rms_g = {zeta: ride(zeta) for zeta in DAMPING_RATIOS}
best = min(rms_g, key=rms_g.__getitem__)

if __name__ == "__main__":
    for zeta, value in rms_g.items():
        print(f"damping ratio {zeta:4.2f}: {value:.5f} g, in theory {theory(zeta):.5f} g")
    print(f"the calmest has damping ratio {best}")
