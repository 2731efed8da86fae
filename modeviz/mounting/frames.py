"""The axes along and about which a body's motion is told: the vehicle's, its own, or its crank's."""

import numpy as np
from scipy.optimize import linear_sum_assignment

from modeviz.mounting.rigid_part import RigidPart
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.decoupling import Axes

EQUAL = 1e-6
"""Principal values that differ by no more than this part of the largest have no axes of their own."""


def frame(part: RigidPart, axes: Axes, crank: Floats) -> Floats:
    """Return the axes as rows, (3, 3), right-handed, each as near to the vehicle's as may be.

    Args:
        part: of the body.
        axes: which.
        crank: the direction of its crank, (3,), see `crank_direction`.
    """
    match axes:
        case "vehicle":
            return np.eye(3)
        case "principal":
            return principal_axes(part.inertia)[1]
        case "crank":
            return _turned_to(crank)


def crank_direction(part: RigidPart) -> Floats:
    """Return the direction of a body's crank, (3,), a unit vector.

    The one that the body says; else that of x and y about which its moment of inertia is smaller, for
    an engine with its gearbox is longest along its crank, lengthways or across.
    """
    if part.body.crank_axis is not None:
        return part.body.crank_axis
    along_x, along_y = np.diag(part.inertia)[:2]
    return np.eye(3)[0 if along_x <= along_y * (1 + EQUAL) else 1]


def has_crank(body: Body) -> bool:
    """Whether what `crank_direction` gives for a body is a crank, and not just its long axis."""
    return body.crank_axis is not None or body.role == "powertrain"


def principal_axes(tensor: Floats) -> tuple[Floats, Floats]:
    """Return the principal values of a symmetric tensor, (3,), and their axes as rows, (3, 3).

    In the order of the vehicle's axes that they are nearest to, and along these; right-handed. Axes
    that equal values leave open are laid as near to the vehicle's as they go.
    """
    values, vectors = np.linalg.eigh(tensor)
    rows, columns = linear_sum_assignment(-np.abs(vectors))
    order = columns[np.argsort(rows)]
    values, vectors = values[order], vectors[:, order]
    close = np.abs(values[:, None] - values) <= EQUAL * np.abs(values).max()
    axes = np.empty((3, 3))
    for i in range(3):
        if (close[:i, i]).any():
            continue
        same = np.flatnonzero(close[i])
        basis = vectors[:, same]
        W, _, V = np.linalg.svd(basis.T @ np.eye(3)[:, same])
        axes[same] = (basis @ W @ V).T
    if np.linalg.det(axes) < 0:
        axes[np.argmin(np.abs(np.diag(axes)))] *= -1
    return values, axes


def _turned_to(direction: Floats) -> Floats:
    """The vehicle's axes turned by the least angle that lays the nearest one along a direction."""
    nearest = int(np.argmax(np.abs(direction)))
    begin, end = np.eye(3)[nearest], direction * np.sign(direction[nearest])
    v, c = np.cross(begin, end), float(begin @ end)
    S = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return (np.eye(3) + S + S @ S / (1 + c)).T
