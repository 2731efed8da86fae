"""How much too stiff truncation makes a vehicle's components, by an estimate of what is left out."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import connection_coefficients
from modeviz.dynamics.truncation_check import (
    believed_hz,
    is_block,
    misforetold,
    rises,
    softened,
    unevenness,
)
from modeviz.errors import ModevizError, SolveError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Connection, Spring
from modeviz.vehicle.residual_estimate import ResidualEstimate, estimate_residuals
from modeviz.vehicle.residuals import modal_compliance
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

STIFF = 0.1
"""A connection stiffer than this part of what it holds on to feels that the body is too stiff there."""

ROUGH = 10.0
"""How many times as much or as little a gap may be of which no more is known."""

AT_LEAST = 6.0
"""A rough one is hardly ever less than its estimate over this."""


@dataclass(frozen=True)
class Known:
    """What must be so that a gap is known within a factor: nearly all are that meet it."""

    within: float
    """How many times as much or as little it may be."""
    n_elastic: int
    """Modes that each body has at least."""
    ends: float
    """How many times as much it is at the upper ends of the estimates as at the lower ones."""
    unevenness: float
    """Of each body, see `unevenness`."""
    misforetold: float
    """See `misforetold`."""


SURE, SURE_OF_BLOCKS, FAIR = (
    Known(2.0, 25, 4.8, 0.7, 0.4),
    Known(2.0, 25, 4.8, 1.1, 0.5),
    Known(4.0, 12, 6.7, 1.1, 1.0),
)
"""From the bodies of `benchmarks.truncation`; blocks are alike everywhere, whatever their shape."""


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
    within: float
    """How many times as much or as little it may be: 2, 4 or, of an order of magnitude, 10."""

    @property
    def at_least(self) -> float:
        """What it is hardly ever less than."""
        return self.change / min(self.within, AT_LEAST)


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

    Its frequencies are compared with those of the same vehicle whose bodies have the compliance of
    `estimate_residuals`, up to half of what the modes of such a body reach. How well it is known is
    told from the modes: how far the ends of the estimates part, how evenly the modes fill the bodies,
    and how well the first modes foretell the gap that the others close.

    Raises:
        SolveError: as `solve_modes`.
        VehicleError: nothing can move.
    """
    expected = {b.name: estimate_residuals(b) for b in _flexible(vehicle)}
    lacking = [b for b in _flexible(vehicle) if expected[b.name].compliance.any()]
    if not lacking or not vehicle.all_connections:
        return None
    below_hz = believed_hz(lacking)
    truer = softened(vehicle, {name: estimate.compliance for name, estimate in expected.items()})
    found, change = rises(vehicle, truer, below_hz)
    worst = int(change.argmax()) if len(change) else 0
    return TruncationGap(
        tuple(b.name for b in lacking),
        float(change.max(initial=0.0)),
        float(found[worst]) if len(found) else 0.0,
        below_hz,
        _known_within(vehicle, lacking, _ends(vehicle, expected, below_hz)),
    )


def _ends(vehicle: Vehicle, expected: Mapping[str, ResidualEstimate], below_hz: float) -> float:
    """How many times as much the gap is at the upper ends of the estimates as at the lower ones."""
    ends = (
        {name: estimate.least for name, estimate in expected.items()},
        {name: estimate.most for name, estimate in expected.items()},
    )
    try:
        least, most = (rises(vehicle, softened(vehicle, e), below_hz)[1].max(initial=0) for e in ends)
    except SolveError:  # what gives way so much beside stiff mounts drowns the slow modes in rounding
        return math.inf
    return float(most / least) if least > 0 else math.inf


def _known_within(vehicle: Vehicle, lacking: Sequence[FlexibleBody], ends: float) -> float:
    """How many times as much or as little the estimate may be whose ends have some ratio."""
    sure = SURE_OF_BLOCKS if all(map(is_block, lacking)) else SURE
    n_elastic, uneven = min(b.n_normal - b.n_rigid for b in lacking), max(map(unevenness, lacking))
    met = [
        known
        for known in (sure, FAIR)
        if n_elastic >= known.n_elastic and ends <= known.ends and uneven <= known.unevenness
    ]
    off = misforetold(vehicle, lacking) if met else math.inf
    return next((known.within for known in met if off <= known.misforetold), ROUGH)


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
    compliance = modal_compliance(body) + estimate_residuals(body).compliance
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
    estimate = estimate_residuals(body).compliance[body.attachments.index(at)]
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
