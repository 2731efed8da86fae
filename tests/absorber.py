"""J. P. Den Hartog's vibration absorber: a mass on a spring, and on it a small one on a mount."""

import numpy as np

from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Tyre
from modeviz.vehicle.loads import ResponsePoint, Road
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

MASS = 100.0
MASS_RATIO = 0.05
MAIN_HZ = 10.0
STIFFNESS = MASS * (2 * np.pi * MAIN_HZ) ** 2
G = 9.80665

FREQUENCY_HZ = np.linspace(8, 12, 401)

OPTIMAL_DAMPING = (
    2 * np.sqrt(3 * MASS_RATIO / (8 * (1 + MASS_RATIO) ** 3)) * MASS_RATIO * MASS * 2 * np.pi * MAIN_HZ
)
"""N s/m ("Mechanical Vibrations", 4th ed., section 3.3)."""

FIXED_POINTS = np.sqrt(1 + 2 / MASS_RATIO)
"""The least amplification of the points that no damping moves."""

TUNED = MASS_RATIO * STIFFNESS / (1 + MASS_RATIO) ** 2
"""N/m: with which both are as high."""


def absorber(damping: float = OPTIMAL_DAMPING) -> Vehicle:
    """On a road on which the root of the main mass's PSD is its amplification: S = (g/ω²)²."""
    place, own = np.zeros(3), np.eye(3)
    main = RigidBody("main", "cabin", "main mass", MASS, place, own)
    small = RigidBody("small", "powertrain", "absorber", MASS_RATIO * MASS, place, own)
    spring = Tyre(
        "spring",
        "tyres",
        ("main", GROUND),
        np.zeros((2, 3)),
        stiffness=np.array([1e6, 1e6, STIFFNESS]),
        rotational_stiffness=np.full(3, 1e6),
    )
    mount = Mount(
        "mount",
        "absorber",
        ("small", "main"),
        np.zeros((2, 3)),
        rotational_stiffness=np.full(3, 1e4),
        damping=np.array([0.0, 0, damping]),
    )
    side = 1e5
    rates, soft, stiff = (
        MountRates(k, *sides)
        for k, sides in (
            (0.7 * TUNED, (side, side)),
            (0.1 * TUNED, (0.5 * side,) * 2),
            (10 * TUNED, (2 * side,) * 2),
        )
    )
    f = np.array([1.0, 100.0])
    spectrum = np.tile((G / (2 * np.pi * f) ** 2) ** 2, (2, 2, 1)).T  # both tracks move as one
    return Vehicle(
        "absorber", (main, small), (spring,),
        (MountGroup("absorber", "absorber", rates, 0.0, (soft, stiff), (mount,)),),
        response_points=(ResponsePoint("main", "main", place),),
        roads=(Road("shaker", "Shaker", 20.0, f, spectrum),),
        problems=(
            Problem(
                "absorber", (DesignGroup("absorber", ("vertical",)),),
                (Performance(FREQUENCY_HZ, ("shaker",), directions=("vertical",)),),
                goal="peak", is_normalised=False,
            ),
        ),
    )  # fmt: skip


def amplification(frequency_hz, stiffness, damping=OPTIMAL_DAMPING):
    """|x/y| of the main mass from the equations of motion of two masses, for a shaken ground."""
    omega = 2 * np.pi * frequency_hz
    coupling = stiffness + 1j * omega * damping
    main = STIFFNESS - omega**2 * MASS + coupling
    small = coupling - omega**2 * MASS_RATIO * MASS
    return np.abs(STIFFNESS * small / (main * small - coupling**2))
