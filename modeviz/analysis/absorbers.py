"""Absorbers tuned to a mode: what of a vehicle moves in it where one is to sit."""

from collections.abc import Sequence

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.errors import VehicleError
from modeviz.vehicle.absorber import Absorber, den_hartog
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS

NO_MASS = 1e6
"""kg: what moves as little in a mode as so much mass would is not moved by it."""


def effective_mass(
    results: ModalResults, mode: int, body: str, position: Floats, directions: Sequence[str]
) -> float:
    """Return the mass, kg, that moves as a point does in a mode: 1/Σφ² of its mass-normalised shape.

    Infinite where the point stands still.

    Args:
        results: the modes.
        mode: its number from zero.
        body: which moves.
        position: of the point, (3,), m.
        directions: of `DIRECTIONS`, along which its motion counts.
    """
    return float(effective_masses(results, mode, body, position[None], [directions])[0, 0])


def effective_masses(
    results: ModalResults, mode: int, body: str, positions: Floats, ways: Sequence[Sequence[str]]
) -> Floats:
    """Return `effective_mass` of several points, (n_positions, 3), m, and ways, (n_positions, n_ways).

    Args:
        results: as of `effective_mass`, as are mode and body.
        mode: likewise.
        body: likewise.
        positions: of the points.
        ways: of each the directions along which motion counts.
    """
    system, shape = results.prepared.system, results.modes.shapes[:, mode]
    motion = np.array([system.motion(body, place)[:3] @ shape for place in positions])
    counts = np.array([[axis in directions for axis in DIRECTIONS[::-1]] for directions in ways])
    square = motion**2 @ counts.T
    return np.divide(1.0, square, out=np.full_like(square, np.inf), where=square > 1 / NO_MASS)


def tuned_absorber(
    results: ModalResults,
    mode: int,
    name: str,
    body: str,
    position: Floats,
    mass: float,
    directions: Sequence[str] = ("vertical",),
) -> Absorber:
    """Return an absorber tuned to a mode by `den_hartog`, as to one mass on a spring.

    That holds for a mode that has its frequency to itself and little damping.

    Args:
        results: the modes without it.
        mode: its number from zero.
        name: of the absorber.
        body: what it is to sit on.
        position: where, (3,), m.
        mass: kg.
        directions: of `DIRECTIONS`, along which it moves.

    Raises:
        VehicleError: the mode has no frequency or does not move the point along these, or something is
            wrong with the absorber.
    """
    frequency = float(results.modes.frequency_hz[mode])
    moved = effective_mass(results, mode, body, position, directions)
    if not (np.isfinite(moved) and frequency > 0):
        raise VehicleError(
            f"absorber {name!r}: {results.names[mode].name} hardly moves {body!r} there along "
            f"{', '.join(directions)}; expected a place and a direction in which it does"
        )
    tuning = den_hartog(mass / moved, frequency)
    x, y, z = map(float, position)
    return Absorber(
        name,
        body,
        (x, y, z),
        mass,
        tuning.frequency_hz,
        tuning.damping_ratio,
        directions=tuple(directions),
    )
