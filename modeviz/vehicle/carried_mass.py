"""The mass that an absorber carries along wherever its spring is put."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.vehicle.absorber_names import guide_name
from modeviz.vehicle.bodies import Body, RigidBody
from modeviz.vehicle.connections import MOTIONS, Connection
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.vehicle import Vehicle

ROUNDING = 1e-9
"""m, and of moments of inertia: what differs by no more is the same."""


@dataclass(frozen=True, eq=False)
class CarriedMass:
    """The mass of an absorber: alike about all axes, on one spring, held from turning by its guide."""

    body: RigidBody
    carrier: Body
    """What it sits on."""
    guide: Connection

    @property
    def inertia(self) -> float:
        """About any axis, kg m²."""
        return float(self.body.inertia[0, 0])

    @property
    def held(self) -> NDArray[np.bool_]:
        """Along which of its local axes it goes along with what carries it, (3,)."""
        return np.array([motion in self.guide.rigid for motion in MOTIONS[:3]])


def carried_mass(vehicle: Vehicle, group: MountGroup) -> CarriedMass | None:
    """Return the mass of the absorber whose spring a mount group is; None of any other group.

    Raises:
        VehicleError: something else hangs on the mass, or it is held otherwise than an absorber.
    """
    guide = next((c for c in vehicle.connections if c.name == guide_name(group.name)), None)
    own = group.mounts[0].bodies[0]
    body = next((b for b in vehicle.bodies if b.name == own and b.role == "absorber"), None)
    if guide is None or body is None:
        return None
    if not isinstance(body, RigidBody) or not _is_absorber(body, group, guide):
        raise VehicleError(
            f"{group.name!r} holds {own!r} otherwise than [[absorber]] does, which alone is moved"
        )
    if (other := _hanging_on(vehicle, own, {group.mounts[0].name, guide.name})) is not None:
        raise VehicleError(
            f"{other!r} hangs on {own!r}, the mass of an absorber, which is moved with its spring "
            "alone; expected nothing else on it"
        )
    return CarriedMass(body, vehicle.body(group.mounts[0].bodies[1]), guide)


def _is_absorber(body: RigidBody, group: MountGroup, guide: Connection) -> bool:
    """Whether all of it is in one place, and the mass turns as what carries it does."""
    if len(group.mounts) != 1:
        return False
    mount = group.mounts[0]
    places = np.vstack([mount.points, guide.points]) - body.center_of_gravity
    alike = np.abs(body.inertia - body.inertia[0, 0] * np.eye(3)).max()
    return (
        mount.bodies == guide.bodies
        and set(MOTIONS[3:]) <= set(guide.rigid)
        and bool(np.abs(places).max() <= ROUNDING)
        and bool(np.abs(mount.axes - guide.axes).max() <= ROUNDING)
        and bool(alike <= ROUNDING * body.inertia[0, 0])
    )


def _hanging_on(vehicle: Vehicle, body: str, own: set[str]) -> str | None:
    """The name of something on a body that is none of its own connections."""
    lumps = (*vehicle.added_masses, *vehicle.response_points, *vehicle.forces, *vehicle.engines)
    found = [c.name for c in vehicle.all_connections if body in c.bodies and c.name not in own]
    found += [lump.name for lump in lumps if lump.body == body]
    return next(iter(found), None)
