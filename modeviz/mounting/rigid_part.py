"""The rigid part of a body's motion: its six motions at its centre of gravity, in the mass metric."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.motions import MASSLESS, center_of_gravity, rigid_coordinates
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body


@dataclass(frozen=True, eq=False)
class RigidPart:
    """A body as a rigid one, with the masses added to it."""

    body: Body
    own: slice
    """Which of the vehicle's coordinates are the body's."""
    center: Floats
    """(3,), m: the centre of gravity, where it moves along and about the vehicle's axes."""
    coordinates: Floats
    """X, (n_own, 6): its own coordinates per unit of x, y, z, rx, ry, rz there."""
    mass: Floats
    """M_b = XᵀMX, (6, 6), kg, kg m and kg m²."""
    momentum: Floats
    """XᵀM, (6, n_own): impulse and angular impulse per unit of its own coordinates."""
    moving: Floats
    """V, (6, n_moving): the motions that have mass, VᵀM_bV = I; all six of a body that is no rod."""

    @property
    def inverse_mass(self) -> Floats:
        """M_b⁻¹ for the motions that have mass, (6, 6)."""
        return self.moving @ self.moving.T

    @property
    def inertia(self) -> Floats:
        """(3, 3) about the centre of gravity, kg m²."""
        return self.mass[3:, 3:]

    @property
    def rows(self) -> Floats:
        """M_b⁻¹XᵀM, (6, n_own): the rigid motion closest to a motion of the body, by its mass."""
        return self.inverse_mass @ self.momentum


@lru_cache(maxsize=4)
def rigid_parts(system: System) -> tuple[RigidPart, ...]:
    """Return the rigid part of every body, in their order; no mount rate changes them."""
    return tuple(_rigid_part(system, body) for body in system.vehicle.bodies)


def _rigid_part(system: System, body: Body) -> RigidPart:
    center = center_of_gravity(system, [body])
    own = system.dofs[body.name]
    X = rigid_coordinates(system, [body], center)[own]
    momentum = X.T @ system.mass[own, own]
    mass = momentum @ X
    scale = np.sqrt(np.maximum(np.diag(mass), MASSLESS * np.trace(mass)))
    inertia, directions = np.linalg.eigh(mass / np.outer(scale, scale))
    moves = inertia > MASSLESS
    moving = directions[:, moves] / np.sqrt(inertia[moves]) / scale[:, None]
    return RigidPart(body, own, center, X, mass, momentum, moving)
