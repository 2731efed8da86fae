"""What a mount is drawn as: rubber between washers, a strut, or a damper."""

from dataclasses import dataclass

import numpy as np
from viser.transforms import SO3

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount

RADIUS, HEIGHT = 1 / 120, 1 / 63.5
"""Of the rubber of the largest marker but for half, as parts of the vehicle's length.

On a pickup that is 45 mm."""


@dataclass(frozen=True)
class Piece:
    """A cylinder of a marker, in parts of `RADIUS` and `HEIGHT`."""

    name: str
    radius: float
    height: float
    along: float = 0.0
    """Of its middle, from that of the marker."""


@dataclass(frozen=True, eq=False)
class MountLook:
    """The cylinders of a marker, one behind the other; the first carries its colour."""

    pieces: tuple[Piece, ...]
    turn: SO3
    """How they are turned out of the mount's local z."""

    @property
    def direction(self) -> Floats:
        """(3,), along which they follow each other, in the mount's local axes."""
        return np.asarray(self.turn.apply(np.array([0.0, 0.0, 1.0])), np.float64)


RUBBER = (
    Piece("rubber", 1.0, 1.0),
    Piece("above", 1.38, 0.165, 0.53),
    Piece("below", 1.38, 0.165, -0.53),
)
STRUT = (
    Piece("rubber", 0.55, 2.0),
    Piece("above", 1.38, 0.165, 1.06),
    Piece("below", 1.38, 0.165, -1.06),
)
DAMPER = (
    Piece("tube", 0.6, 1.3, -0.45),
    Piece("rod", 0.2, 1.2, 0.8),
    Piece("upper eye", 0.5, 0.33, 1.5),
    Piece("lower eye", 0.5, 0.33, -1.25),
)


def mount_look(mount: Mount) -> MountLook:
    """Return what a mount is drawn as.

    A spring with a damper is a strut along its local z; what has no springs is a damper, along the axis
    in which it damps most.
    """
    if not mount.damping.any():
        return MountLook(RUBBER, SO3.identity())
    if has_springs(mount):
        return MountLook(STRUT, SO3.identity())
    return MountLook(DAMPER, _from_z(int(np.argmax(mount.damping))))


def has_springs(mount: Mount) -> bool:
    """Return whether there is anything in a mount that gives back what it takes."""
    return bool(mount.stiffness.any() or mount.rotational_stiffness.any() or mount.rigid)


def _from_z(axis: int) -> SO3:
    """Return the rotation that lays z along a local axis."""
    quarter = np.pi / 2
    return (SO3.from_y_radians(quarter), SO3.from_x_radians(-quarter), SO3.identity())[axis]
