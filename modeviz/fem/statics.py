"""Beaming and torsional stiffness of a free body, as engineers compare frames and bodies by.

Both are 1 / (fᵀ u) for a balanced set of vertical forces f that does unit work on the deflection asked
for, so no support adds or takes stiffness. Units are SI; `units` has N/mm and N m/deg.
"""

import numpy as np

from modeviz.errors import SolveError
from modeviz.fem.free import static_response
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Floats

Station = tuple[int, int]
"""The nodes left and right at one place along the vehicle."""


def station(nodes: Floats, position: Floats) -> Station:
    """The nodes nearest to a place on the right side, (3,) in m, and to its mirror image."""
    right = np.asarray(position, float)
    nearest = [int(np.argmin(np.linalg.norm(nodes - p, axis=1))) for p in (right * [1, -1, 1], right)]
    return nearest[0], nearest[1]


def torsional_stiffness(matrices: Matrices, front: Station, rear: Station) -> float:
    """Couple about x over the twist between two stations, N m/rad.

    Opposite couples, each a pair of vertical forces left and right; the twist is the difference of
    the slopes between the nodes of each pair.

    Args:
        matrices: of the body.
        front: where one couple acts.
        rear: where the other does.

    Raises:
        SolveError: the nodes of a station are not side by side, or both stations are one.
    """
    f = np.zeros(matrices.n_dofs)
    for (left, right), couple in (front, 1.0), (rear, -1.0):
        width = matrices.nodes[right, 1] - matrices.nodes[left, 1]
        if width == 0:
            raise SolveError(f"station of nodes {left} and {right}: found no width, expected some")
        f[6 * right + 2] += couple / width
        f[6 * left + 2] -= couple / width
    return _stiffness(matrices, f)


def beaming_stiffness(matrices: Matrices, front: Station, middle: Station, rear: Station) -> float:
    """Vertical force at a middle station over its deflection, N/m, on supports at two others.

    Half of each force acts left and half right. Rigid motion of the supports is taken out, so that
    the deflection is measured from the line that joins them.

    Args:
        matrices: of the body.
        front: one support.
        middle: where the force acts.
        rear: the other support.

    Raises:
        SolveError: the middle is at the same place as the supports, or they are one.
    """
    x_front, x, x_rear = (matrices.nodes[list(s), 0].mean() for s in (front, middle, rear))
    if x_front == x_rear:
        raise SolveError(f"supports: found both at x = {x_front} m, expected two different places")
    share = (x - x_front) / (x_rear - x_front)
    f = np.zeros(matrices.n_dofs)
    for nodes, force in (front, 1 - share), (middle, -1.0), (rear, share):
        for node in nodes:
            f[6 * node + 2] += force / 2
    return _stiffness(matrices, f)


def _stiffness(matrices: Matrices, loads: Floats) -> float:
    flexibility = loads @ static_response(matrices, loads[:, None])[:, 0]
    if not flexibility > 0:
        raise SolveError("the stations carry no deflection: found the same nodes loaded and supported")
    return float(1 / flexibility)
