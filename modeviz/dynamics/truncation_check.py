"""How well bodies' modes foretell what they lack: told from the modes that are there."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.residuals import with_residual_compliance
from modeviz.vehicle.vehicle import Vehicle

BELIEVED = 0.5
"""Up to this part of its highest frequency a body's modes are taken to describe it."""

FEWER = (0.4, 0.6, 0.8)
"""Parts of the modes from which the rest is foretold."""

LOWER = (0.4, 0.55, 0.7)
"""Parts of the modes that are compared with the rest at nodes."""

N_NODES = 150

SOFT = 0.03
"""Directions less flexible than this part of the softest of their node are left out."""


def softened(vehicle: Vehicle, compliance: dict[str, Floats]) -> Vehicle:
    """Return a vehicle whose bodies give way by so much more, (n_attachments, 3), at attachments."""

    def softer(body: FlexibleBody) -> FlexibleBody:
        names = [a.name for a in body.attachments]
        return with_residual_compliance(body, dict(zip(names, compliance[body.name], strict=True)))

    bodies = (softer(b) if isinstance(b, FlexibleBody) else b for b in vehicle.bodies)
    return replace(vehicle, bodies=tuple(bodies))


def estimates(vehicle: Vehicle) -> dict[str, Floats]:
    """Return the residual compliance that is estimated of each flexible body."""
    bodies = (body for body in vehicle.bodies if isinstance(body, FlexibleBody))
    return {body.name: estimate_residuals(body).compliance for body in bodies}


def believed_hz(bodies: Sequence[FlexibleBody]) -> float:
    """Return up to which frequency the modes of bodies are taken to describe them all."""
    return BELIEVED * min(float(b.natural_frequency_hz[b.n_normal - 1]) for b in bodies)


def rises(vehicle: Vehicle, truer: Vehicle, below_hz: float) -> tuple[Floats, Floats]:
    """Return the frequencies of a vehicle and by what part they exceed those of a truer one.

    Raises:
        SolveError: as `solve_modes`.
    """
    found = solve_modes(assemble(vehicle), below_hz=below_hz).frequency_hz
    lower = solve_modes(assemble(truer), n_modes=max(len(found), 1)).frequency_hz
    n = min(len(found), len(lower))
    vibrates = lower[:n] > RESOLVED_HZ
    changes = np.where(vibrates, found[:n] / np.where(vibrates, lower[:n], 1.0) - 1, 0.0)
    return found[:n], changes


def is_block(body: FlexibleBody) -> bool:
    """Return whether a body is of solids: its nodes do not turn."""
    return bool(len(body.nodes)) and not _sampled(body)[:, 3:].any()


def unevenness(body: FlexibleBody) -> float:
    """Return how differently the upper modes of a body flex its nodes than the lower ones move them.

    The standard deviation over nodes of log₂ of the compliance of the upper modes beside Σ φ² of the
    lower ones, which would be in one ratio everywhere if all places were alike.
    """
    n_elastic = body.n_normal - body.n_rigid
    phi = _sampled(body)[:, :3].astype(float) ** 2
    compliance = phi / body.omega_n_squared[body.n_rigid : body.n_normal]
    whole = compliance.sum(axis=2)
    soft = (whole > SOFT * whole.max(axis=1, initial=0.0, keepdims=True)) & (whole > 0)
    spreads = []
    for n in {round(part * n_elastic) for part in LOWER}:
        lower, upper = phi[:, :, :n].sum(axis=2)[soft], compliance[:, :, n:].sum(axis=2)[soft]
        if 3 <= n <= n_elastic - 2 and lower.size:
            spreads.append(np.log2(np.maximum(upper, 1e-4 * whole[soft]) / (lower + 1e-300)).std())
    return float(np.mean(spreads)) if spreads else np.inf


def _sampled(body: FlexibleBody) -> Array:
    """Elastic modes of some of its nodes, (n_some, 6, n_elastic)."""
    step = max(1, len(body.nodes) // N_NODES)
    return body.shapes[::step, :, body.n_rigid : body.n_normal]


def misforetold(vehicle: Vehicle, lacking: Sequence[FlexibleBody]) -> float:
    """Return by how many powers of two parts of the modes foretell what the others then add, at most.

    What is estimated of the first modes alone is held against all modes and what is estimated of those.

    Args:
        vehicle: with all modes there are.
        lacking: its bodies that lack residual compliance.

    Raises:
        SolveError: as `solve_modes`.
    """
    truer = softened(vehicle, estimates(vehicle))
    worst = 0.0
    for part in FEWER:
        cut = {body.name: _fewer(body, part) for body in lacking}
        fewer = replace(vehicle, bodies=tuple(cut.get(b.name, b) for b in vehicle.bodies))
        below_hz = believed_hz(list(cut.values()))
        foretold = rises(fewer, softened(fewer, estimates(fewer)), below_hz)[1].max(initial=0.0)
        known = rises(fewer, truer, below_hz)[1].max(initial=0.0)
        if min(foretold, known) <= 0:
            return np.inf
        worst = max(worst, abs(float(np.log2(foretold / known))))
    return worst


def _fewer(body: FlexibleBody, part: float) -> FlexibleBody:
    """A body in the first part of its elastic modes, with its residual vectors."""
    n_elastic = body.n_normal - body.n_rigid
    return body.truncated(body.n_rigid + round(part * n_elastic), residual_vectors=True)
