"""Mounts turned out of the axes that they were given, on both sides of a vehicle alike."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MIDDLE, Mount, MountGroup
from modeviz.vehicle.local_axes import TurnOrder, axes_of_angles
from modeviz.vehicle.vehicle import Vehicle

Turns = Mapping[str, tuple[float, float, float]]
"""By mount group the angles, rad, about the vehicle's x, then y, then z, that turn its mounts."""

MIRRORED = np.array([-1.0, 1.0, -1.0])
"""Signs of angles about x, y, z seen in a mirror along the vehicle's middle."""


def with_turned_mounts(vehicle: Vehicle, turns: Turns) -> Vehicle:
    """Return a vehicle with mounts of some groups turned; what is joined stays where it is.

    A mount on the other side than the first of its group turns the other way, as in a mirror.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    asked = {name: np.array(angles) for name, angles in turns.items() if any(angles)}
    for name in asked:
        vehicle.mount_group(name)
    if not asked:
        return vehicle
    groups = tuple(
        _turned(group, asked[group.name]) if group.name in asked else group
        for group in vehicle.mount_groups
    )
    told = (_note(name, angles) for name, angles in asked.items())
    return replace(vehicle, mount_groups=groups, notes=(*vehicle.notes, *told))


def _note(name: str, angles: Floats) -> str:
    degrees = ", ".join(f"{angle:g}" for angle in np.degrees(angles))
    return f"mounts {name!r} are turned by {degrees}° about x, y and z out of the axes in the file"


def _turned(group: MountGroup, angles: Floats) -> MountGroup:
    first = group.mounts[0].center[1]
    mounts = (
        _turned_mount(mount, angles * (MIRRORED if _is_opposite(mount, first) else 1.0))
        for mount in group.mounts
    )
    return replace(group, mounts=tuple(mounts))


def _is_opposite(mount: Mount, y: float) -> bool:
    """Whether a mount is on the other side than a place at that y, m; none is on the middle's."""
    own = float(mount.center[1])
    return own * y < 0 and min(abs(own), abs(y)) > MIDDLE


def _turned_mount(mount: Mount, angles: Floats) -> Mount:
    """A mount whose axes are turned: rows a become R a."""
    return replace(mount, axes=mount.axes @ axes_of_angles(angles, TurnOrder()))
