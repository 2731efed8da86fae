"""Which nodes of a body move an attachment, told from how they move."""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Array
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.rigid import rigid_motions

NEAREST, N_MODES = 64, 34
"""So many nodes and elastic modes are looked at."""

RIGID = 2e-3
"""Nodes whose motion differs by less than this part from that of a rigid arm are on one."""


@dataclass(frozen=True, eq=False)
class HeldNodes:
    """The nodes that carry an attachment."""

    nodes: Array
    """Indices of nodes of the body, the nearest first; none of a body without nodes."""
    is_mean: bool
    """Whether it moves with their mean; else they are one rigid piece with it."""


def held_nodes(body: FlexibleBody, attachment: Attachment) -> HeldNodes:
    """Return the nodes that move as a rigid piece with an attachment, or whose mean it follows best."""
    arms = body.nodes - attachment.position
    nearest = np.argsort(np.linalg.norm(arms, axis=1), kind="stable")[:NEAREST]
    modes = slice(body.n_rigid, min(body.n_rigid + N_MODES, body.n_normal))
    moved = body.shapes[nearest, :3, modes].astype(float)
    carried = (rigid_motions(arms[nearest]) @ attachment.shapes[:, modes])[:, :3]
    apart = np.linalg.norm(moved - carried, axis=(1, 2))
    rigid = apart < RIGID * np.linalg.norm(moved, axis=(1, 2))
    if rigid.any() or not len(nearest):
        return HeldNodes(nearest[rigid], is_mean=False)
    means = np.cumsum(moved, axis=0) / np.arange(1, len(nearest) + 1)[:, None, None]
    off = np.linalg.norm(means - attachment.shapes[:3, modes], axis=(1, 2))
    return HeldNodes(nearest[: int(off.argmin()) + 1], is_mean=True)
