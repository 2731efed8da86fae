"""Where mounts sit and how they are turned, other than they were given, on both sides alike."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.absorber_names import guide_name
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MIDDLE, Mount
from modeviz.vehicle.local_axes import TurnOrder, axes_of_angles
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.moved_ends import MovedMount, bodies_that_hold, check_moves, missing_compliance
from modeviz.vehicle.vehicle import Vehicle

MIRRORED_OFFSET, MIRRORED_ANGLES = (1.0, -1.0, 1.0), (-1.0, 1.0, -1.0)
"""Signs along and about x, y, z of what is seen in a mirror along the vehicle's middle."""

ThreeFloats = tuple[float, float, float]


@dataclass(frozen=True)
class Placement:
    """How far a mount is moved and turned from where it was given."""

    offset: ThreeFloats = (0.0, 0.0, 0.0)
    """Along the vehicle's x, y and z, m."""
    angles: ThreeFloats = (0.0, 0.0, 0.0)
    """About the vehicle's x, then y, then z, through where the mount is, rad."""

    def __post_init__(self) -> None:
        for name in ("offset", "angles"):
            value = tuple(float(v) + 0.0 for v in getattr(self, name))  # no -0.0
            if len(value) != 3 or not np.isfinite(value).all():
                raise VehicleError(f"{name}: found {value}, expected three numbers")
            object.__setattr__(self, name, value)

    @property
    def is_as_given(self) -> bool:
        """Whether it changes nothing."""
        return not any((*self.offset, *self.angles))

    @property
    def mirrored(self) -> "Placement":
        """The same on the other side of the vehicle."""
        offset = np.multiply(self.offset, MIRRORED_OFFSET)
        angles = np.multiply(self.angles, MIRRORED_ANGLES)
        return Placement(tuple(offset), tuple(angles))

    def apply(self, mount: Mount) -> Mount:
        """Return a mount that is moved with both its ends; turning leaves these: axes a become R a."""
        turned = mount.axes @ axes_of_angles(np.array(self.angles), TurnOrder())
        return replace(mount, points=mount.points + self.offset, axes=turned)


Placements = Mapping[str, Placement]
"""By mount group: of its first mount and those on its side; others are placed as in a mirror."""


def with_placements(vehicle: Vehicle, placements: Placements) -> Vehicle:
    """Return a vehicle with the mounts of some groups moved and turned, and notes on that.

    What bodies lack where mounts are now is among its remarks, which a folder keeps, until they are
    moved again.

    Raises:
        VehicleError: a group that the vehicle does not have, or mounts are moved off a flexible body.
    """
    moved = _moved_by_group(vehicle, placements)
    if not moved:
        return vehicle
    whole = _placed(vehicle, moved)
    of_group = {name: f"mounts {name!r} are moved to" for name in moved}
    lacking = [
        note
        for name, mounts in moved.items()
        for note in missing_compliance(vehicle.bodies, whole.bodies, of_group[name], mounts)
    ]
    still = tuple(r for r in vehicle.remarks if not any(words in r for words in of_group.values()))
    told = [*(note for name in moved for note in _notes(name, placements[name])), *lacking]
    return replace(whole, remarks=(*still, *lacking), notes=(*vehicle.notes, *told))


def placed_vehicle(vehicle: Vehicle, placements: Placements) -> Vehicle:
    """Return the same as `with_placements` without a word, in a part of its time; raises likewise."""
    moved = _moved_by_group(vehicle, placements)
    return _placed(vehicle, moved) if moved else vehicle


def _placed(vehicle: Vehicle, moved: Mapping[str, Sequence[MovedMount]]) -> Vehicle:
    """A vehicle with the mounts of some groups where they were moved to."""
    groups = tuple(
        replace(group, mounts=tuple(mount.after for mount in moved[group.name]))
        if group.name in moved
        else group
        for group in vehicle.mount_groups
    )
    every = [mount for mounts in moved.values() for mount in mounts]
    bodies = bodies_that_hold(vehicle, every)
    return _with_whole_absorbers(replace(vehicle, bodies=bodies, mount_groups=groups), every)


def _with_whole_absorbers(placed: Vehicle, moved: Sequence[MovedMount]) -> Vehicle:
    """Return a vehicle in which masses and guides of absorbers go where their springs do."""
    guides = {connection.name for connection in placed.connections}
    springs = {m.after.bodies[0]: m for m in moved if guide_name(m.after.group) in guides}
    of_absorbers = {
        body.name: springs[body.name]
        for body in placed.bodies
        if body.role == "absorber" and body.name in springs
    }
    if not of_absorbers:
        return placed
    bodies = tuple(
        replace(body, center_of_gravity=body.center_of_gravity + of_absorbers[body.name].shift)
        if body.name in of_absorbers
        else body
        for body in placed.bodies
    )
    connections = tuple(
        of_absorbers[guide.bodies[0]].guided(guide) if guide.bodies[0] in of_absorbers else guide
        for guide in placed.connections
    )
    return replace(placed, bodies=bodies, connections=connections)


def check_placements(vehicle: Vehicle, placements: Placements) -> None:
    """Raises VehicleError as `with_placements` would, in a part of its time."""
    for mounts in _moved_by_group(vehicle, placements).values():
        check_moves(vehicle, mounts)


def _moved_by_group(vehicle: Vehicle, placements: Placements) -> dict[str, tuple[MovedMount, ...]]:
    """The mounts of groups that are placed otherwise."""
    asked = {name: placed for name, placed in placements.items() if not placed.is_as_given}
    groups = {name: vehicle.mount_group(name) for name in asked}
    return {
        name: tuple(map(MovedMount, group.mounts, placed_mounts(group, asked[name])))
        for name, group in groups.items()
    }


def placed_mounts(group: MountGroup, placement: Placement) -> tuple[Mount, ...]:
    """Return the mounts of a group, those on the other side than the first placed as in a mirror."""
    return tuple(
        (placement.mirrored if is_mirrored else placement).apply(mount)
        for mount, is_mirrored in zip(group.mounts, mirrored_mounts(group), strict=True)
    )


def mirrored_mounts(group: MountGroup) -> tuple[bool, ...]:
    """Return which mounts of a group are on the other side than its first; none is on the middle's."""
    y = [float(mount.center[1]) for mount in group.mounts]
    return tuple(own * y[0] < 0 and min(abs(own), abs(y[0])) > MIDDLE for own in y)


def _notes(name: str, placement: Placement) -> list[str]:
    """Return sentences on how the mounts of a group are placed."""
    moved, turned = _listed(1e3 * np.array(placement.offset)), _listed(np.degrees(placement.angles))
    words = {
        f"moved by {moved} mm along x, y and z": placement.offset,
        f"turned by {turned}° about x, y and z": placement.angles,
    }
    return [f"mounts {name!r} are {how}" for how, values in words.items() if any(values)]


def _listed(values: Floats) -> str:
    return ", ".join(f"{value:g}" for value in values)
