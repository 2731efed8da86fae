"""Rigid motion: how a point moves when the body it belongs to does not deform."""

import numpy as np

from modeviz.vehicle.arrays import Floats


def rigid_motions(offsets: Floats) -> Floats:
    """The motion at each offset from a point, (..., 6, 6), per motion of that point.

    u = u₀ + θ × r for small rotations; the rotation is the same everywhere.

    Args:
        offsets: (..., 3), m.
    """
    x, y, z = np.moveaxis(np.asarray(offsets), -1, 0)
    T = np.zeros((*x.shape, 6, 6))
    T[...] = np.eye(6)
    T[..., 0, 4], T[..., 0, 5] = z, -y
    T[..., 1, 3], T[..., 1, 5] = -z, x
    T[..., 2, 3], T[..., 2, 4] = y, -x
    return T
