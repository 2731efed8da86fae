"""The local axes of a mount, of two vectors or of three angles."""

from collections.abc import Mapping

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.mounts.bushing import AXES
from modeviz.vehicle.arrays import Floats

OBLIQUE = np.radians(1.0)
"""By how much two of them may be off a right angle, for rounding."""


def axes_of_vectors(vectors: Mapping[str, Floats]) -> Floats:
    """Return axes as rows, (3, 3), of two of them by name; the first is kept if they are oblique.

    Args:
        vectors: (3,) each, of any length, by x, y or z.

    Raises:
        VehicleError: not two, one of no length, or not at right angles.
    """
    if len(vectors) != 2:
        raise VehicleError(f"found {len(vectors)} of the local axes, expected two of them")
    (first, u), (second, v) = sorted(vectors.items())
    for axis, vector in ((first, u), (second, v)):
        if not np.linalg.norm(vector) > 1e-9 * max(1.0, float(np.abs(vector).max())):
            raise VehicleError(f"the local {axis} axis is {vector.tolist()}, which has no direction")
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    if abs(off := np.arcsin(np.clip(u @ v, -1, 1))) > OBLIQUE:
        raise VehicleError(
            f"the local {first} and {second} axes are {90 - np.degrees(off):.4g}° apart, expected 90°"
        )
    v = v - (u @ v) * u
    axes = np.zeros((3, 3))
    i, j = AXES.index(first), AXES.index(second)
    axes[i], axes[j] = u, v / np.linalg.norm(v)
    k = 3 - i - j
    axes[k] = np.cross(axes[(k + 1) % 3], axes[(k + 2) % 3])
    return axes


def axes_of_angles(roll: float, pitch: float, yaw: float) -> Floats:
    """Return axes as rows, (3, 3), turned about x by roll, then about the fixed y and z, rad.

    The same as about z by yaw first, then about the turned y and x.
    """
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return (about_z @ about_y @ about_x).T
