"""Wheels: unbalance and the force variations of tyres, as generalised forces."""

from collections.abc import Sequence

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import Tyre
from modeviz.vehicle.loads import WheelLoad

X, Y, Z = 0, 1, 2


def wheel_forces(system: System, loads: Sequence[WheelLoad], frequency_hz: Floats) -> Complexes:
    """Generalised peak forces of harmonic wheel loads, a column for each, (n_freqs, n_dofs, n_loads).

    Args:
        system: what the wheels belong to.
        loads: each at its own amplitude.
        frequency_hz: (n_freqs,), of the force: the wheel's revolutions per second.
    """
    omega = 2 * np.pi * np.asarray(frequency_hz)
    tyres = {tyre.name: tyre for tyre in system.vehicle.tyres}
    columns = [_forces(system, load, tyres[load.tyre], omega) for load in loads]
    return np.stack(columns, axis=-1) if columns else np.zeros((len(omega), system.n_dofs, 0), complex)


def _forces(system: System, load: WheelLoad, tyre: Tyre, omega: Floats) -> Complexes:
    """(n_freqs, n_dofs)."""
    wheel = tyre.bodies[0]
    center = system.motion(wheel, tyre.wheel_center)
    if load.kind == "unbalance":
        # The wheel rolls towards -x, so the heavy spot passes the rear a quarter turn before the top.
        rotating = center[Z] + 1j * center[X]
        return load.amplitude * omega[:, None] ** 2 * rotating
    if load.kind == "radial force":
        row = center[Z]
    else:
        row = system.motion(wheel, _lateral_force_point(tyre))[Y]
    return np.broadcast_to(load.amplitude * row, (len(omega), system.n_dofs)).astype(complex)


def _lateral_force_point(tyre: Tyre) -> Floats:
    """On the ground, the pneumatic trail behind the wheel centre."""
    x, y, _ = tyre.wheel_center
    return np.array([x + tyre.trail, y, 0.0])
