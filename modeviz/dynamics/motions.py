"""Rows that read a motion out of a shape: bodies moving as one, wheels in phase, a frame twisting.

They know the mass and the geometry, never a spring: one set serves whatever the mount rates are.
"""

from collections.abc import Sequence

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.rigid import rigid_motions

MASSLESS = 1e-12
"""A motion with less than this part of the mass of another has none but for rounding."""


def rigid_coordinates(system: System, bodies: Sequence[Body], center: Floats) -> Floats:
    """The coordinates (n_dofs, 6) of bodies moving as one rigid body, per motion of `center`."""
    X = np.zeros((system.n_dofs, 6))
    for body in bodies:
        if isinstance(body, FlexibleBody):
            start = system.dofs[body.name].start
            own = slice(start, start + body.n_rigid)
            X[own] = body.rigid_fit.coordinates @ rigid_motions(-center)
        else:
            X[system.dofs[body.name]] = rigid_motions(body.center_of_gravity - center)
    return X


def center_of_gravity(system: System, bodies: Sequence[Body]) -> Floats:
    """The bodies' common centre of gravity, (3,), m, with the masses added to them."""
    X = rigid_coordinates(system, bodies, np.zeros(3))
    m = X.T @ system.mass @ X
    return np.array([m[1, 5], -m[0, 5], m[0, 4]]) / m[0, 0]


def share_rows(system: System, motions: Floats) -> Floats:
    """Rows (n_motions, n_dofs) that, times a shape and squared, give its energy in each motion.

    xᵀM / √(xᵀMx) for each column x of `motions`, so that (rows φ)² is its share of the kinetic energy
    of a mass-normalised shape φ; the shares of motions that are orthogonal in mass add up. What has no
    mass, as a rod's turning about itself, has no share.
    """
    momentum = motions.T @ system.mass
    motion_mass = np.einsum("ij,ji->i", momentum, motions)
    has_mass = motion_mass > MASSLESS * motion_mass.max(initial=0.0)
    size = np.sqrt(np.where(has_mass, motion_mass, np.inf))
    return momentum / size[:, None]


def rigid_rows(system: System, bodies: Sequence[Body]) -> Floats:
    """Share rows (6, n_dofs) of x, y, z, rx, ry, rz of bodies as one, about their common centre."""
    center = center_of_gravity(system, bodies)
    return share_rows(system, rigid_coordinates(system, bodies, center))


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


def end_rows(system: System, ends_x: tuple[float, float]) -> Floats:
    """Rows (2, n_dofs): vertical motion of the whole vehicle's best rigid motion at two stations x."""
    X = rigid_coordinates(system, system.vehicle.bodies, np.zeros(3))
    momentum = X.T @ system.mass
    motion = np.linalg.lstsq(momentum @ X, momentum, rcond=MASSLESS)[0]
    return np.stack([motion[2] - x * motion[4] for x in ends_x])


def bending_rows(system: System, frame: FlexibleBody) -> Floats:
    """Rows (2, n_dofs): how a frame twists and how it beams.

    Torsion: the roll of the front less that of the rear, rad. Beaming: the ends' mean height less the
    middle's, m.
    """
    first, last = np.quantile(frame.nodes[:, 0], [0.02, 0.98])
    stations = np.linspace(first, last, 3)
    (front, front_roll), (middle, _), (rear, rear_roll) = (_section(frame, x) for x in stations)
    rows = np.zeros((2, system.n_dofs))
    rows[:, system.dofs[frame.name]] = front_roll - rear_roll, (front + rear) / 2 - middle
    return rows


def flexibility_share(amplitudes: Floats, omega_n_squared: Floats) -> Floats:
    """The part of each mode in a frame's static flexibility, in proportion to the largest.

    A mode's part is (its amplitude)² / ω², so of several modes that bend a frame the lowest stands out.
    Free modes have none.

    Args:
        amplitudes: what `bending_rows` read, (2, n_modes).
        omega_n_squared: (n_modes,).
    """
    free = omega_n_squared < (2 * np.pi * RESOLVED_HZ) ** 2
    flexibility = np.where(free, 0.0, amplitudes**2 / np.where(free, 1.0, omega_n_squared))
    largest = flexibility.max(axis=1, keepdims=True)
    return flexibility / np.where(largest > 0, largest, 1.0)


def _section(frame: FlexibleBody, x: float) -> tuple[Floats, Floats]:
    """Height and roll of the cross-section of a frame at a station, (n_modes,) each."""
    length = np.ptp(frame.nodes[:, 0])
    near = np.abs(frame.nodes[:, 0] - x) < 0.06 * length
    plane = np.stack([np.ones(near.sum()), frame.nodes[near, 1]], axis=1)
    height, roll = np.linalg.lstsq(plane, frame.shapes[near, 2].astype(float), rcond=None)[0]
    return height, roll
