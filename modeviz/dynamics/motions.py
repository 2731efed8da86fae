"""How much of a mode is a given motion: bodies moving as one, wheels in phase, a frame twisting."""

from collections.abc import Sequence

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import Modes
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.rigid import rigid_motions


def rigid_coordinates(system: System, bodies: Sequence[Body], center: Floats) -> Floats:
    """The coordinates (n_dofs, 6) of bodies moving as one rigid body, per motion of `center`."""
    X = np.zeros((system.n_dofs, 6))
    for body in bodies:
        if isinstance(body, FlexibleBody):
            at = body.attachments[0]
            rigid_modes = at.shapes[:, : body.N_RIGID]
            start = system.dofs[body.name].start
            X[start : start + body.N_RIGID] = np.linalg.solve(
                rigid_modes, rigid_motions(at.position - center)
            )
        else:
            X[system.dofs[body.name]] = rigid_motions(body.center_of_gravity - center)
    return X


def center_of_gravity(system: System, bodies: Sequence[Body]) -> Floats:
    """Where the bodies' common centre of gravity is, (3,), m, with the masses added to them."""
    X = rigid_coordinates(system, bodies, np.zeros(3))
    m = X.T @ system.mass @ X
    return np.array([m[1, 5], -m[0, 5], m[0, 4]]) / m[0, 0]


def energy_share(system: System, motions: Floats, shapes: Floats) -> Floats:
    """Share (n_motions, n_modes) of a mode's kinetic energy that is in a motion of the system.

    (xᵀMφ)² / xᵀMx for each column x of `motions` and each mass-normalised shape φ; the shares of
    motions that are orthogonal in mass add up.
    """
    momentum = motions.T @ system.mass
    motion_mass = np.einsum("ij,ji->i", momentum, motions)
    return (momentum @ shapes) ** 2 / motion_mass[:, None]


def rigid_share(system: System, bodies: Sequence[Body], shapes: Floats) -> Floats:
    """Share (6, n_modes) of x, y, z, rx, ry, rz of bodies moving as one about their common centre."""
    center = center_of_gravity(system, bodies)
    return energy_share(system, rigid_coordinates(system, bodies, center), shapes)


def wheel_motions(system: System, wheels: Sequence[Body]) -> Floats:
    """Coordinates (n_dofs, 2) of an axle's wheels moving up in phase and in antiphase.

    A rigid axle rolls in antiphase; of independent wheels the left one goes up, the right one down.
    """
    origin = np.zeros(3)
    hop = rigid_coordinates(system, wheels, origin)[:, 2]
    if len(wheels) == 1:
        tramp = rigid_coordinates(system, wheels, center_of_gravity(system, wheels))[:, 3]
    else:
        tramp = sum(
            -np.sign(center_of_gravity(system, [w])[1]) * rigid_coordinates(system, [w], origin)[:, 2]
            for w in wheels
        )
    return np.stack([hop, tramp], axis=1)


def ends_vertical(system: System, ends_x: tuple[float, float], shapes: Floats) -> Floats:
    """Vertical motion (2, n_modes) of the whole vehicle's best rigid motion at two stations x."""
    X = rigid_coordinates(system, system.vehicle.bodies, np.zeros(3))
    M = system.mass
    motion = np.linalg.solve(X.T @ M @ X, X.T @ M @ shapes)
    return np.stack([motion[2] - x * motion[4] for x in ends_x])


def frame_flexibility(system: System, frame: FlexibleBody, modes: Modes) -> Floats:
    """What each mode adds to a frame's flexibility in beaming and in torsion, (2, n_modes).

    Beaming: the ends' mean height less the middle's. Torsion: the roll of the front less that of the
    rear. A mode's part of the static flexibility is (its value in that measure)² / ω²; so of several
    modes that bend a frame the lowest stands out. In proportion to the largest; free modes have none.
    """
    first, last = np.quantile(frame.nodes[:, 0], [0.02, 0.98])
    stations = np.linspace(first, last, 3)
    (front, front_roll), (middle, _), (rear, rear_roll) = (_section(frame, x) for x in stations)
    measures = np.stack([(front + rear) / 2 - middle, front_roll - rear_roll])
    amplitudes = measures @ modes.shapes[system.dofs[frame.name]]
    omega_squared = modes.omega_n_squared
    free = omega_squared < 1.0
    flexibility = np.where(free, 0.0, amplitudes**2 / np.where(free, 1.0, omega_squared))
    largest = flexibility.max(axis=1, keepdims=True)
    return flexibility / np.where(largest > 0, largest, 1.0)


def _section(frame: FlexibleBody, x: float) -> tuple[Floats, Floats]:
    """Height and roll of the cross-section of a frame at a station, (n_modes,) each."""
    length = np.ptp(frame.nodes[:, 0])
    near = np.abs(frame.nodes[:, 0] - x) < 0.06 * length
    plane = np.stack([np.ones(near.sum()), frame.nodes[near, 1]], axis=1)
    height, roll = np.linalg.lstsq(plane, frame.shapes[near, 2].astype(float), rcond=None)[0]
    return height, roll
