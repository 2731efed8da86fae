"""Where the axes of inclined mounts meet."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount

UPRIGHT = np.cos(np.radians(1.0))
"""A mount whose axis is closer to one of the vehicle's is not inclined."""

MEETING = 1e-6
"""Axes meet somewhere if of the directions that they leave open none has less than this part."""


@dataclass(frozen=True, eq=False)
class Focus:
    """The point that the axes of some inclined mounts aim at."""

    mounts: tuple[str, ...]
    point: Floats
    """(3,), m."""
    miss: float
    """How far the axes pass it, m, the root of the mean square."""


def focus(mounts: Sequence[Mount], stiffness: Floats, body: str) -> Focus | None:
    """Return the focus of a body's inclined mounts; None of fewer than two, or if they are parallel.

    A mount's axis runs through its elastic centre along its stiffest direction, in compression. The
    focus is the point with the least squares of distances from the axes; with the body's centre of
    gravity a little below it, mounts much stiffer in compression than in shear decouple sideways
    motion and roll (C. M. Harris, A. G. Piersol, "Harris' Shock and Vibration Handbook", 5th ed.,
    chapter 3; T. Jeong, R. Singh, Journal of Sound and Vibration 234(1), 2000, call it focalisation).

    Args:
        mounts: all of the vehicle's.
        stiffness: of each along its local x, y, z, (n_mounts, 3), N/m.
        body: its name.
    """
    every = [(m, mount_axis(m, k)) for m, k in zip(mounts, stiffness, strict=True) if body in m.bodies]
    inclined = [m for m, axis in every if _is_inclined(axis)]
    axes = np.array([axis for _, axis in every if _is_inclined(axis)]).reshape(-1, 3)
    centers = np.array([m.center for m in inclined]).reshape(-1, 3)
    across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
    total = across.sum(axis=0)
    if len(inclined) < 2 or np.linalg.eigvalsh(total)[0] < MEETING * len(inclined):
        return None
    point = np.linalg.solve(total, (across @ centers[:, :, None]).sum(axis=0)[:, 0])
    off = (across @ (point - centers)[:, :, None])[:, :, 0]
    return Focus(_names(inclined), point, float(np.sqrt(np.mean(np.sum(off**2, axis=1)))))


def mount_axis(mount: Mount, stiffness: Floats) -> Floats:
    """Return the direction in which a mount is stiffest, (3,), upwards; its local z among equals."""
    stiffest = 2 - int(np.argmax(stiffness[::-1]))
    axis = mount.axes[stiffest]
    return axis if axis[2] >= 0 else -axis


def _is_inclined(axis: Floats) -> bool:
    return bool(np.abs(axis).max() < UPRIGHT)


def _names(mounts: Sequence[Mount]) -> tuple[str, ...]:
    return tuple(mount.name for mount in mounts)
