"""Rigid motion: how a point moves when the body it belongs to does not deform."""

import numpy as np

from modeviz.vehicle.arrays import Floats


def cross_matrix(r: Floats) -> Floats:
    """The matrix S(r) with S(r) a = r × a, (3, 3)."""
    x, y, z = r
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rigid_motion(offset: Floats) -> Floats:
    """The motion (6, 6) at `offset` from a point, per motion of that point.

    u = u₀ + θ × r for small rotations; the rotation is the same everywhere.
    """
    T = np.eye(6)
    T[:3, 3:] = -cross_matrix(offset)
    return T
