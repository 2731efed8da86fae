"""How much too stiff truncation makes a vehicle's components, by an estimate of what is left out."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from modeviz.dynamics.assembly import assemble, connection_coefficients
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.errors import ModevizError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Connection, Spring
from modeviz.vehicle.residuals import (
    FEW,
    as_estimated,
    estimated_residual_compliance,
    modal_compliance,
)
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

STIFF = 0.1
"""A connection stiffer than this part of what it holds on to feels that the body is too stiff there."""

BELIEVED = 0.5
"""Up to this part of its highest frequency a body's modes are taken to describe it."""


@dataclass(frozen=True)
class TruncationGap:
    """By how much frequencies of a vehicle are too high, since bodies lack residual compliance."""

    bodies: tuple[str, ...]
    """Those that do."""
    change: float
    """What frequencies come out too high by at most, a part of them."""
    at_hz: float
    """The frequency of which that is; zero if there is none."""
    below_hz: float
    """Frequencies up to this one are looked at."""
    is_rough: bool
    """Whether a body has so few modes that it is an order of magnitude, else mostly a factor of two."""


@dataclass(frozen=True)
class StiffConnection:
    """A connection that is nearly as stiff as what it holds on to, or stiffer."""

    connection: str
    body: str
    attachment: str
    direction: str
    """Of `MOTIONS`, of the connection."""
    stiffness: float
    """N/m, infinite of a rigid one."""
    local_stiffness: float
    """N/m of the body there, with what is estimated."""


def truncation_gap(vehicle: Vehicle) -> TruncationGap | None:
    """Return the estimate for a vehicle; None if no body lacks residual compliance where it is held.

    Its frequencies are compared with those of the same vehicle whose bodies have
    `estimated_residual_compliance`, up to half of what the modes of such a body reach.

    Raises:
        SolveError: as `solve_modes`.
        VehicleError: nothing can move.
    """
    lacking = [b for b in _flexible(vehicle) if estimated_residual_compliance(b).any()]
    if not lacking or not vehicle.all_connections:
        return None
    below_hz = BELIEVED * min(float(b.natural_frequency_hz[b.n_normal - 1]) for b in lacking)
    names = tuple(b.name for b in lacking)
    found = solve_modes(assemble(vehicle), below_hz=below_hz).frequency_hz
    softer = replace(
        vehicle,
        bodies=tuple(as_estimated(b) if isinstance(b, FlexibleBody) else b for b in vehicle.bodies),
    )
    truer = solve_modes(assemble(softer), n_modes=max(len(found), 1)).frequency_hz
    n = min(len(found), len(truer))
    vibrates = truer[:n] > RESOLVED_HZ
    changes = np.where(vibrates, found[:n] / np.where(vibrates, truer[:n], 1.0) - 1, 0.0)
    worst = int(changes.argmax()) if n else 0
    return TruncationGap(
        names,
        float(changes.max(initial=0.0)),
        float(found[worst]) if n else 0.0,
        below_hz,
        any(b.n_normal - b.n_rigid < FEW for b in lacking),
    )


def gap_if_solved(vehicle: Vehicle) -> TruncationGap | None:
    """Return the same; None also for a vehicle that cannot be solved."""
    try:
        return truncation_gap(vehicle)
    except ModevizError:
        return None


def stiff_connections(vehicle: Vehicle) -> Iterator[StiffConnection]:
    """Yield connections stiffer than a tenth of bodies that lack residual compliance there."""
    bodies = {body.name: body for body in _flexible(vehicle)}
    for connection in vehicle.all_connections:
        for name in connection.bodies:
            if name in bodies:
                yield from _stiff(connection, bodies[name])


def on_trial_mounts(body: FlexibleBody) -> Vehicle:
    """Return a body on springs to the ground, at each attachment a tenth as stiff as it is itself.

    That is in its softest direction there: rubber has about the same rates in all.
    """
    compliance = modal_compliance(body) + estimated_residual_compliance(body)
    softest = compliance.max(axis=1, initial=0.0)
    stiffness = STIFF * np.divide(1.0, softest, out=np.zeros_like(softest), where=softest > 0)
    springs = tuple(
        Spring(
            a.name,
            "trial mounts",
            (body.name, GROUND),
            np.tile(a.position, (2, 1)),
            stiffness=np.full(3, k),
        )
        for a, k in zip(body.attachments, stiffness, strict=True)
    )
    return Vehicle("trial", (body,), springs)


def _stiff(connection: Connection, body: FlexibleBody) -> Iterator[StiffConnection]:
    """The directions in which a connection is stiff beside one of its bodies."""
    at = body.nearest_attachment(connection.points[connection.bodies.index(body.name)])
    estimate = estimated_residual_compliance(body)[body.attachments.index(at)]
    lacks = connection.axes**2 @ estimate
    compliance = _compliance_along(connection, body, at) + lacks
    stiffness = connection_coefficients(connection)[0][:3]
    for motion, missing, k, c in zip(MOTIONS[:3], lacks, stiffness, compliance, strict=True):
        k = np.inf if motion in connection.rigid else k
        if missing > 0 and k * c > STIFF:
            yield StiffConnection(connection.name, body.name, at.name, motion, float(k), float(1 / c))


def _compliance_along(connection: Connection, body: FlexibleBody, at: Attachment) -> Floats:
    """Of a body's modes at the centre of a connection along its axes, (3,), m/N."""
    phi = rigid_motions(connection.center - at.position) @ at.shapes[:, body.n_rigid :]
    return np.sum((connection.axes @ phi[:3]) ** 2 / body.omega_n_squared[body.n_rigid :], axis=1)


def _flexible(vehicle: Vehicle) -> list[FlexibleBody]:
    return [body for body in vehicle.bodies if isinstance(body, FlexibleBody)]
