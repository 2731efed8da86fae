"""Sets of nodes that carry a point: what a rigid spider and an averaging one make of their motions."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions

SetKind = Literal["rigid", "mean"]
"""rigid: joined to one piece, as by RBE2. mean: the weighted mean of their motions, as by RBE3."""

INDEPENDENT = 1e-6
"""A rotation is told by nodes that stand off a line by more than this part of how far they spread."""


@dataclass(frozen=True)
class NodeSet:
    """Nodes that carry a point."""

    kind: SetKind
    nodes: tuple[int, ...]
    """Their ids."""
    weights: tuple[float, ...] | None = None
    """Of each, above zero; None: alike."""
    center: int | None = None
    """The node at which the point is; None: it is in the middle of the nodes."""


def set_motion(position: Floats, places: Floats, weights: Floats, turns: bool) -> Floats:
    """Return the motion of a point per motions of the nodes that carry it, (6, 6 n_nodes).

    The rigid motion u of the point that comes nearest to those of the nodes: of all u the least
    Σ w |x - T u|². With the translations alone that is RBE3's mean with lever arms (its forces are the
    transpose: each node carries its share and what the moment about the middle asks of it); it stiffens
    nothing. Of nodes that move as one piece, as RBE2 has them, it is the motion of the piece.

    Args:
        position: (3,), m, of the point.
        places: (n_nodes, 3), m.
        weights: (n_nodes,).
        turns: whether the rotations of nodes count too, by the square of how far nodes are from their
            middle.

    Raises:
        VehicleError: the nodes do not tell the rotation, since they are on a line.
    """
    middle = places.mean(axis=0)
    spread = np.sqrt(np.mean(np.sum((places - middle) ** 2, axis=1)))
    arm = spread or 1.0
    root = np.sqrt(weights)[:, None] * np.repeat([1.0, arm if turns else 0.0], 3)
    scale = np.repeat([1.0, 1 / arm], 3)
    about_middle = (root[:, :, None] * rigid_motions(places - middle) * scale).reshape(-1, 6)
    if np.linalg.matrix_rank(about_middle, rtol=INDEPENDENT) < 6:
        raise VehicleError(
            f"its {len(places)} nodes tell no rotation about the line on which they are; expected "
            'three or more that span a plane, or "rigid:" and nodes with rotations of their own'
        )
    inverse = scale[:, None] * np.linalg.pinv(about_middle) * root.ravel()
    return rigid_motions(position - middle) @ inverse
