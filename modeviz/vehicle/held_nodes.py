"""Which nodes of a body move an attachment, told from how they move."""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.rigid import rigid_motions

NEAREST, N_MODES = 64, 34
"""So many nodes and elastic modes are looked at."""

RIGID = 2e-3
"""Nodes whose motion differs by less than this part from that of a rigid arm are on one."""

SAME_PLACE = 1e-6
"""Of the size of a body: nodes that are nearer to each other count as one."""

EXACT = 3e-5
"""By this part of its motion a mean is off in the digits of a file, a node in a mesh of a million."""

FLAT = 1e-10
"""Squares of how far nodes spread that are smaller than this part are none: they tell no turn."""


@dataclass(frozen=True, eq=False)
class HeldNodes:
    """The nodes that carry an attachment."""

    nodes: Array
    """Indices of nodes of the body, the nearest first; none of a body without nodes."""
    is_mean: bool
    """Whether it moves with their mean; else they are one rigid piece with it."""
    without_mass: Array
    """Indices of nodes that are the attachment itself and only follow those that carry it."""


def held_nodes(body: FlexibleBody, attachment: Attachment) -> HeldNodes:
    """Return the nodes that move as a rigid piece with an attachment, or whose mean it follows best.

    A node at its place that moves with it is what it is held by if no others explain its motion, and
    else the reference node of a rigid or averaging element, which has no mass of its own.
    """
    arms = body.nodes - attachment.position
    away = np.linalg.norm(arms, axis=1)
    nearest = np.argsort(away, kind="stable")[:NEAREST]
    modes = slice(body.n_rigid, min(body.n_rigid + N_MODES, body.n_normal))
    moved = body.shapes[nearest, :3, modes].astype(float)
    carried = (rigid_motions(arms[nearest]) @ attachment.shapes[:, modes])[:, :3]
    apart = np.linalg.norm(moved - carried, axis=(1, 2))
    rigid = apart < RIGID * np.linalg.norm(moved, axis=(1, 2))
    own = rigid & (away[nearest] <= SAME_PLACE * extent(body.nodes))
    itself = nearest[own]
    if (rigid & ~own).any():
        return HeldNodes(nearest[rigid & ~own], is_mean=False, without_mass=itself)
    others = np.flatnonzero(~own)
    others = others[first_of_places(body.nodes[nearest[others]], extent(body.nodes))]
    if not len(others):
        return HeldNodes(itself, is_mean=False, without_mass=itself[:0])
    off = _off_means(arms[nearest[others]], moved[others], attachment.shapes[:3, modes])
    if len(itself) and off.min() > EXACT:
        return HeldNodes(itself, is_mean=False, without_mass=itself[:0])
    return HeldNodes(nearest[others[: int(off.argmin()) + 1]], is_mean=True, without_mass=itself)


def extent(nodes: Floats) -> float:
    """Return how large a body is along the axis along which it is largest, m."""
    return float(np.ptp(nodes, axis=0).max()) if len(nodes) else 0.0


def first_of_places(nodes: Floats, size: float) -> Array:
    """Return the rows of nodes, in order, without those at the place of an earlier one.

    Args:
        nodes: (n_nodes, 3), m.
        size: of their body, m.
    """
    if not size:
        return np.arange(min(len(nodes), 1))
    return np.sort(np.unique(np.round(nodes / (SAME_PLACE * size)), axis=0, return_index=True)[1])


def _off_means(arms: Floats, moved: Floats, followed: Floats) -> Floats:
    """By what part of itself a motion is off the means of the first one, two, … nodes, (n_nodes,).

    A mean is the rigid motion u of the place with the least Σ |x - T u|², as of RBE3.

    Args:
        arms: (n_nodes, 3), m, from the place to the nodes.
        moved: (n_nodes, 3, n_modes).
        followed: (3, n_modes).
    """
    size = np.linalg.norm(arms, axis=1).max() or 1.0
    T = rigid_motions(arms / size)[:, :3]
    squares = np.cumsum(T.mT @ T, axis=0)
    u = np.linalg.pinv(squares, rcond=FLAT, hermitian=True) @ np.cumsum(T.mT @ moved, axis=0)
    apart = np.linalg.norm(u[:, :3] - followed, axis=(1, 2))
    return apart / max(np.linalg.norm(followed), np.finfo(float).tiny)
