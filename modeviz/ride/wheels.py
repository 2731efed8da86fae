"""Wheels: unbalance and the force variations of tyres, as generalised forces."""

from collections.abc import Sequence

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import WheelLoad
from modeviz.vehicle.vehicle import Vehicle

X, Y, Z = 0, 1, 2
VERTICAL, FORE_AFT, LATERAL = 0, 1, 2
"""The directions of each wheel's loads, see `wheel_directions`."""


def wheel_directions(system: System) -> Floats:
    """Rows (3 n_tyres, n_dofs) along which wheel loads act.

    For each tyre: vertical and fore-aft motion of the wheel's centre, lateral motion of the wheel on
    the ground, the pneumatic trail behind its centre.
    """
    rows = [np.zeros((0, system.n_dofs))]
    for tyre in system.vehicle.tyres:
        center = system.motion(tyre.bodies[0], tyre.wheel_center)
        patch = system.motion(tyre.bodies[0], tyre.lateral_force_point)
        rows.append(np.stack([center[Z], center[X], patch[Y]]))
    return np.vstack(rows)


def wheel_amplitudes(vehicle: Vehicle, loads: Sequence[WheelLoad], frequency_hz: Floats) -> Complexes:
    """Peak force of each load along each of `wheel_directions`, (n_freqs, 3 n_tyres, n_loads), N."""
    omega = 2 * np.pi * np.asarray(frequency_hz)
    numbers = {tyre.name: i for i, tyre in enumerate(vehicle.tyres)}
    amplitudes = np.zeros((len(omega), len(numbers), 3, len(loads)), complex)
    for j, load in enumerate(loads):
        wheel = amplitudes[:, numbers[load.tyre], :, j]
        if load.kind == "unbalance":
            # The wheel rolls towards -x: the heavy spot passes the rear a quarter turn before the top.
            wheel[:, VERTICAL] = load.amplitude * omega**2
            wheel[:, FORE_AFT] = 1j * load.amplitude * omega**2
        else:
            wheel[:, VERTICAL if load.kind == "radial force" else LATERAL] = load.amplitude
    return amplitudes.reshape(len(omega), 3 * len(numbers), len(loads))
