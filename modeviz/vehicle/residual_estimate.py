"""Estimates of what the modes that a body was given without would add to its flexibility."""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Array, Floats, frozen
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.held_nodes import HeldNodes, extent, first_of_places, held_nodes

COVERED = 0.02
"""Residual vectors that add this part of what is estimated, which may be many times too much, are taken
to add all there is: by so little do those of other directions move a place."""

SHEET, SOLID = 1, 3
"""Powers of frequency with which the modes below it are more: plates that bend, and blocks."""

SURFACE = 0.5
"""Of the mass of a mean node of a block what one has at its surface, where things are held."""

N_OF_SURFACE = 12
"""Fitted to blocks of known stiffness: among n modes n²/(n + so many) are of the volume."""

OF_FACE = 13
"""Neighbours of a node in the middle of a face of cubes, along their sides and diagonals."""

OCTAVE = 2.0
"""Fitted likewise: so many times further than the motion of nodes their turning goes on."""

MOST_OF_NODE, MOST_OF_MEAN = 0.5, 0.9
"""More of what all modes together move a place, the modes that are there are not taken to do."""

TINY = np.finfo(float).tiny

DOUBTFUL = 1.2
"""Powers of two: directions of which less is known than this have no upper end of their own."""

UNKNOWN = 4.0
"""How many times the estimate a direction is taken to give way of which nothing is known."""


@dataclass(frozen=True, eq=False)
class ResidualEstimate:
    """What modes left out add at each attachment along x, y and z, m/N, and where it may end."""

    compliance: Floats
    """(n_attachments, 3), zero in directions in which residual vectors act."""
    least: Floats
    """(n_attachments, 3)."""
    most: Floats
    """(n_attachments, 3)."""

    def __post_init__(self) -> None:
        for name in ("compliance", "least", "most"):
            frozen(self, name, getattr(self, name), (None, 3))


def estimate_residuals(body: FlexibleBody) -> ResidualEstimate:
    """Return an estimate of the residual compliance of a body at its attachments.

    Σ φ² grows as the power p of frequency (H. Weyl's law: 1 of sheets that bend, 3 of blocks), from S
    at ω_c, the end of the band that the modes fill, to the inverse of the mass that moves there at
    ω_max, where the mesh ends, as all modes are complete. So ∫ ω⁻² dS from ω_c to ω_max is left,
    S/ω_c² p/(2 - p) (1 - (ω_max/ω_c)^(p - 2)). Bodies whose nodes do not turn are blocks; the mass is
    that of the nodes that carry the attachment, each its equal part of the body's, or half of it at
    the surface of a block. What turning adds at the end of an arm has one power of frequency more, and
    goes on for an octave more.

    An estimate is trusted the more, the nearer Σ φ² is to what all places move in the mean, and the
    more evenly both halves of the modes make it up; arms are trusted little. `benchmarks.truncation`
    says how well that goes.
    """
    n_elastic = body.n_normal - body.n_rigid
    if not n_elastic or not body.attachments:
        none = np.zeros((len(body.attachments), 3))
        return ResidualEstimate(none, none, none)
    held = [held_nodes(body, attachment) for attachment in body.attachments]
    massive = np.delete(body.nodes, np.concatenate([each.without_mass for each in held]), axis=0)
    places = massive[first_of_places(massive, extent(massive))]
    rows = [_along(body, *each, places) for each in zip(body.attachments, held, strict=True)]
    estimate, spread = (np.array(values) for values in zip(*rows, strict=True))
    factor = 2.0 ** np.minimum(spread, 3.0)
    trusted = spread < DOUBTFUL
    ends = estimate * np.where(trusted, factor, UNKNOWN)
    most = np.where(trusted, ends, ends.max(axis=1, keepdims=True))
    lacks = ~_covered(body, estimate)
    return ResidualEstimate(estimate * lacks, estimate / factor * lacks, most * lacks)


def _along(
    body: FlexibleBody, attachment: Attachment, held: HeldNodes, places: Floats
) -> tuple[Floats, Floats]:
    """The estimate along x, y and z, (3,), and by how many powers of two it is doubted."""
    elastic = slice(body.n_rigid, body.n_normal)
    n_elastic = body.n_normal - body.n_rigid
    n_held = len(first_of_places(body.nodes[held.nodes], extent(body.nodes)))
    phi, on_nodes = attachment.shapes[:3, elastic], body.shapes[held.nodes][:, :, elastic]
    is_solid = bool(on_nodes.size) and not on_nodes[:, 3:].any()
    own = phi if held.is_mean or not on_nodes.size else on_nodes[:, :3].astype(float).mean(axis=0)
    moved, by_arm, total = (np.sum(part**2, axis=1) for part in (own, phi - own, phi))
    growth = SOLID if is_solid else SHEET
    mass = body.mass * n_held / max(len(places), 1)
    reach = _filled(moved * mass, held, is_solid) ** (-1 / growth)
    end = body.omega_n_squared[body.n_normal - 1] * (1 + 0.5 / n_elastic) ** 2
    end *= 1 + is_solid * N_OF_SURFACE / n_elastic
    arm = by_arm * _beyond(growth + 1, OCTAVE * reach.min()) / end
    estimate = moved * _beyond(growth, reach) / end + arm
    upper = np.sum(phi[:, n_elastic // 2 :] ** 2, axis=1)
    arms = arm / np.maximum(estimate, TINY)
    doubt = _doubt(total * body.mass / n_elastic, upper / np.maximum(total, TINY))
    is_alone = is_solid and n_held == 1 and not held.is_mean
    sticks_out = _sticks_out(body.nodes[held.nodes[0]], places) if is_alone else 0.0
    return estimate, doubt + arms + sticks_out


def _filled(part: Floats, held: HeldNodes, is_solid: bool) -> Floats:
    """Which part of what all modes of the mesh move a place, Σ φ² = 1/m, those that are there do."""
    if is_solid and not held.is_mean:
        part = part * SURFACE
    return np.clip(part, 1e-6, MOST_OF_MEAN if held.is_mean else MOST_OF_NODE)


def _sticks_out(place: Floats, places: Floats) -> float:
    """By how many powers of two a node has fewer neighbours than one in the middle of a face."""
    away = np.sort(np.linalg.norm(places - place, axis=1))[1:]
    n_near = int((away < 1.5 * away.min(initial=np.inf)).sum())
    return max(0.0, float(np.log2(OF_FACE / max(n_near, 1))))


def _beyond(growth: int, reach: Floats) -> Floats:
    """∫ ω⁻² dS from ω_c on in S/ω_c², of S that grows as a power up to so many times ω_c."""
    if growth == 2:
        return 2 * np.log(reach)
    return growth / (2 - growth) * (1 - reach ** (growth - 2.0))


def _doubt(level: Floats, upper: Floats) -> Floats:
    """By how many powers of two an estimate may be off, (3,), as bodies with known matrices tell.

    Args:
        level: (3,), Σ φ² at the place beside that of a mean place across its sheet.
        upper: (3,), the part of it from the upper half of the modes.
    """
    part = np.clip(upper, 0.02, 0.98)
    off_mean = np.minimum(np.abs(np.log2(np.maximum(level, 1e-9))), 8.0)
    return 0.3 + 0.4 * off_mean + 0.2 * np.abs(np.log2(part / (1 - part)))


def _covered(body: FlexibleBody, estimate: Floats) -> Array:
    """In which directions residual vectors act, (n_attachments, 3)."""
    residual = slice(body.n_normal, body.n_modes)
    phi = np.array([a.shapes[:3, residual] for a in body.attachments])
    return np.sum(phi**2 / body.omega_n_squared[residual], axis=2) >= COVERED * estimate
