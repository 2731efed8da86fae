"""Vehicles with tuned absorbers, made of ordinary parts."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from modeviz.errors import VehicleError, of_part, unknown
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_parts import absorber_guide, absorber_mass, absorber_spring
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.connections import Connection
from modeviz.vehicle.moved_ends import MovedMount, bodies_that_hold, missing_compliance
from modeviz.vehicle.vehicle import Vehicle


def with_absorbers(vehicle: Vehicle, absorbers: Sequence[Absorber]) -> Vehicle:
    """Return a vehicle with absorbers, whose parts stand behind all others of their kind.

    On a flexible body one sits where it is said to, as `attachment_elsewhere` has that place move.

    Raises:
        VehicleError: a body that the vehicle does not have, a place off a body, or a name that is
            taken.
    """
    if not absorbers:
        return vehicle
    check_absorbers(absorbers, vehicle.bodies, vehicle.all_connections)
    near = [_on_attachment_of(vehicle, absorber) for absorber in absorbers]
    whole = replace(
        vehicle,
        bodies=(*vehicle.bodies, *map(absorber_mass, near)),
        connections=(*vehicle.connections, *map(absorber_guide, near)),
        mount_groups=(*vehicle.mount_groups, *map(absorber_spring, near)),
    )
    return put_in_place(whole, absorbers)


def check_absorbers(
    absorbers: Sequence[Absorber], bodies: Iterable[Body], connections: Iterable[Connection]
) -> None:
    """Raises PartError where an absorber sits on no body, or a part of it is called as another is.

    Args:
        absorbers: to be added; one may sit on the mass of another.
        bodies: that there are besides.
        connections: likewise.
    """
    names, joints = [body.name for body in bodies], {connection.name for connection in connections}
    masses = {absorber.body_name for absorber in absorbers}
    for absorber in absorbers:
        with of_part("absorber", absorber.name):
            if absorber.body not in names and absorber.body not in masses - {absorber.body_name}:
                raise VehicleError(unknown("body", absorber.body, names))
            for kind, part, taken in (
                ("body", absorber.body_name, names),
                ("connection", absorber.guide_name, joints),
            ):
                if part in taken:
                    raise VehicleError(
                        f"one of its parts is called {part!r}, and there is a {kind} of that name; "
                        "each needs its own"
                    )


def on_attachment(absorber: Absorber, body: Body) -> Absorber:
    """Return an absorber at the attachment of a flexible body that is nearest; itself on a rigid one.

    Raises:
        VehicleError: the body has no attachment.
    """
    if not isinstance(body, FlexibleBody):
        return absorber
    with of_part("absorber", absorber.name):
        nearest = body.nearest_attachment(np.array(absorber.position))
    return replace(absorber, position=tuple(nearest.position.tolist()))


def _on_attachment_of(vehicle: Vehicle, absorber: Absorber) -> Absorber:
    with of_part("absorber", absorber.name):
        return on_attachment(absorber, vehicle.body(absorber.body))


def put_in_place(vehicle: Vehicle, absorbers: Sequence[Absorber]) -> Vehicle:
    """Return a vehicle whose absorbers, which sit on attachments, are where they should be.

    Raises:
        PartError: a place is off a flexible body.
    """
    for absorber in absorbers:
        with of_part("absorber", absorber.name):
            vehicle = _put(vehicle, absorber)
    return vehicle


def _put(vehicle: Vehicle, absorber: Absorber) -> Vehicle:
    mass, spring = absorber_mass(absorber), absorber_spring(absorber)
    guide = absorber_guide(absorber)
    before = vehicle.mount_group(absorber.name).mounts[0]
    if not (before.points != spring.mounts[0].points).any():
        return vehicle
    moved = [MovedMount(before, spring.mounts[0])]
    bodies = bodies_that_hold(vehicle, moved)
    where = f"absorber {absorber.name!r} sits"
    lacking = tuple(missing_compliance(vehicle.bodies, bodies, where, moved))
    return replace(
        vehicle,
        bodies=tuple(mass if body.name == mass.name else body for body in bodies),
        connections=tuple(guide if c.name == guide.name else c for c in vehicle.connections),
        mount_groups=tuple(spring if g.name == spring.name else g for g in vehicle.mount_groups),
        remarks=(*vehicle.remarks, *lacking),
        notes=(*vehicle.notes, *lacking),
    )


def carrying_bodies(vehicle: Vehicle) -> tuple[Body, ...]:
    """Return the bodies on which absorbers may sit, and which are looked at: all but absorbers."""
    return tuple(body for body in vehicle.bodies if body.role != "absorber")
