"""What moved mounts hold on to: bodies with attachments where they are now, and what these lack."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import located
from modeviz.text.wording import free_name
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.attachments_elsewhere import attachment_elsewhere, check_reach
from modeviz.vehicle.bodies import Attachment, Body, FlexibleBody
from modeviz.vehicle.carriers import SAME_PLACE
from modeviz.vehicle.connections import Connection, Mount, Tyre
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

UNSAID = 1e-3
"""Of what a mount gives way: less is not worth a word."""


@dataclass(frozen=True, eq=False)
class MovedMount:
    """A mount before and after it was moved."""

    before: Mount
    after: Mount

    @property
    def shift(self) -> Floats:
        """How far it was moved, (3,), m."""
        return self.after.center - self.before.center

    def guided(self, joint: Connection) -> Connection:
        """Return a joint of the same bodies moved and turned as the mount was."""
        turn = self.before.axes.T @ self.after.axes
        return replace(joint, points=joint.points + self.shift, axes=joint.axes @ turn)

    def ends_elsewhere(self, body: FlexibleBody) -> Iterator[tuple[Floats, Floats]]:
        """Yield where it held on to a body, (3,), and where it does now, if that has no attachment."""
        ends = zip(self.before.bodies, self.before.points, self.after.points, strict=True)
        for name, old, new in ends:
            if name == body.name and (old != new).any() and not _has_attachment(body, new):
                yield old, new


def bodies_that_hold(vehicle: Vehicle, moved: Sequence[MovedMount]) -> tuple[Body, ...]:
    """Return the bodies of a vehicle; flexible ones with attachments where mounts are moved to.

    What else hangs on them moves as before, though a new attachment be nearer to it.

    Raises:
        VehicleError: a mount is moved off a flexible body.
    """
    return tuple(
        _that_holds(body, moved, vehicle) if isinstance(body, FlexibleBody) else body
        for body in vehicle.bodies
    )


def check_moves(vehicle: Vehicle, moved: Sequence[MovedMount]) -> None:
    """Raises VehicleError if a mount is moved off a flexible body, before anything is made of it."""
    for body in vehicle.bodies:
        if isinstance(body, FlexibleBody):
            for mount in moved:
                with located(f"mount {mount.after.name!r}"):
                    for old, new in mount.ends_elsewhere(body):
                        check_reach(body, old, new)


def missing_compliance(
    before: Sequence[Body], after: Sequence[Body], what: str, moved: Sequence[MovedMount]
) -> Iterator[str]:
    """Yield sentences on flexible bodies that give way too little where mounts are moved to.

    Of all that the modes leave out, as `estimate_residuals` has it, that is what the residual vectors
    of other attachments do not add there.

    Args:
        before: bodies.
        after: of `bodies_that_hold`.
        what: is there, with a verb: "mounts 'C1' are moved to".
        moved: the mounts.
    """
    for old, body in zip(before, after, strict=True):
        if body is old or not (isinstance(body, FlexibleBody) and isinstance(old, FlexibleBody)):
            continue
        ends = [(mount.after, new) for mount in moved for _, new in mount.ends_elsewhere(old)]
        if ends:
            missing = _missing(body, [place for _, place in ends])
            yield from _lack(body.name, what, [mount for mount, _ in ends], missing)


def _lack(body: str, what: str, mounts: Sequence[Mount], missing: Floats) -> Iterator[str]:
    """Yield the sentence, unless hardly anything is missing, (n_mounts, 3), m/N along x, y and z."""
    softer = [m.stiffness * (m.axes**2 @ lack) for m, lack in zip(mounts, missing, strict=True)]
    if np.max(softer) > UNSAID:
        along = ", ".join(f"{1e6 * value:.2g}" for value in missing.max(axis=0))
        yield (
            f"body {body!r} has no residual vectors of its own where {what}: it gives way "
            f"there by about {along} µm/N more along x, y and z than is computed (an estimate), up to "
            f"{100 * np.max(softer):.2g} % of what mounts do there"
        )


def _that_holds(body: FlexibleBody, moved: Sequence[MovedMount], vehicle: Vehicle) -> FlexibleBody:
    ends = [(mount.after.name, *end) for mount in moved for end in mount.ends_elsewhere(body)]
    new: list[Attachment] = []
    for mount, old, place in ends:
        with located(f"mount {mount!r}"):
            new.append(attachment_elsewhere(body, _held(body, old), place, _name(mount, body, new)))
    if not new:
        return body
    nearer = replace(body, attachments=(*body.attachments, *new))
    for place in _held_places(vehicle, body.name, [mount.after.name for mount in moved]):
        if nearer.nearest_attachment(place) in new:
            held = _held(body, place)
            new.append(replace(held, name=_name(held.name, body, new)))
    return replace(body, attachments=(*body.attachments, *new))


def _held(body: FlexibleBody, place: Floats) -> Attachment:
    """The motion of a place as whatever hangs there has it: rigid with the nearest attachment."""
    at = body.nearest_attachment(place)
    return Attachment(at.name, place, rigid_motions(place - at.position) @ at.shapes)


def _held_places(vehicle: Vehicle, body: str, moved: Sequence[str]) -> Iterator[Floats]:
    """Where anything but moved mounts hangs on a body, (3,) each."""
    for connection in vehicle.all_connections:
        if connection.name not in moved:
            ends = zip(connection.bodies, connection.points, strict=True)
            yield from (point for name, point in ends if name == body)
        if isinstance(connection, Tyre) and connection.bodies[0] == body:
            yield from (connection.wheel_center, connection.lateral_force_point)
    lumps = (*vehicle.added_masses, *vehicle.response_points, *vehicle.forces, *vehicle.engines)
    yield from (lump.position for lump in lumps if lump.body == body)
    loads = (load for case in vehicle.load_cases for load in case.loads)
    yield from (o.position for o in loads if o.body == body and o.position is not None)


def _has_attachment(body: FlexibleBody, place: Floats) -> bool:
    return bool(np.linalg.norm(body.nearest_attachment(place).position - place) <= SAME_PLACE)


def _missing(body: FlexibleBody, places: Sequence[Floats]) -> Floats:
    """What a body is lacking in compliance at attachments there, (n_places, 3), m/N."""
    held = tuple(map(body.nearest_attachment, places))
    modes_only = replace(body, attachments=held).truncated(body.n_normal)
    residual = slice(body.n_normal, body.n_modes)
    phi = np.array([a.shapes[:3, residual] for a in held])
    known = np.sum(phi**2 / body.omega_n_squared[residual], axis=2)
    return np.maximum(estimate_residuals(modes_only).compliance - known, 0.0)


def _name(name: str, body: FlexibleBody, new: Sequence[Attachment]) -> str:
    """A name for a new attachment that none has."""
    return free_name(name, [attachment.name for attachment in (*body.attachments, *new)])
