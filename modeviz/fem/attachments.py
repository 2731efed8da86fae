"""Attachments of a finite-element body: the motion of a named point, made of that of nodes."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats, frozen
from modeviz.vehicle.rigid import rigid_motions

Axis = Literal["x", "y", "z"]

NEAR = 0.09
"""m: a node this far away weighs 1/e."""

N_NEAR = 8


@dataclass(frozen=True, eq=False)
class AttachmentPoint(ABC):
    """A named point that moves with a body, B u, and passes forces on to its nodes, Bᵀ f."""

    name: str
    position: Floats
    """(3,), m."""
    directions: tuple[Axis, ...] = field(default=("x", "y", "z"), kw_only=True)
    """In which ones forces act, so that each gets a residual vector; none for a point that is read."""

    def __post_init__(self) -> None:
        frozen(self, "position", self.position, (3,))

    @abstractmethod
    def motion(self, nodes: Floats) -> sp.csr_array:
        """B (6, n_dofs): x, y, z, rx, ry, rz of the point per motion of the nodes.

        Args:
            nodes: (n_nodes, 3), m, of the body.

        Raises:
            VehicleError: the point cannot hang there.
        """


@dataclass(frozen=True, eq=False)
class OnNode(AttachmentPoint):
    """Held by one node, rigidly at whatever distance."""

    node: int

    def motion(self, nodes: Floats) -> sp.csr_array:
        _check_nodes_exist(self, [self.node], len(nodes))
        return _rows(rigid_motions(self.position - nodes[[self.node]]), [self.node], len(nodes))


@dataclass(frozen=True, eq=False)
class OnFootprint(AttachmentPoint):
    """Carried by several nodes, as the rigid motion nearest to their displacements (least squares).

    Known as RBE3. It stiffens nothing and loads no node in rotation: a heavy thing on sheet metal
    belongs on this one.
    """

    nodes: tuple[int, ...]

    def motion(self, nodes: Floats) -> sp.csr_array:
        _check_nodes_exist(self, self.nodes, len(nodes))
        displacements = rigid_motions(nodes[list(self.nodes)] - self.position)[:, :3]
        weights = np.zeros((len(self.nodes), 6, 6))
        weights[:, :, :3] = self._fit(displacements.reshape(-1, 6)).reshape(6, -1, 3).swapaxes(0, 1)
        return _rows(weights, self.nodes, len(nodes))

    def _fit(self, displacements: Floats) -> Floats:
        """The least-squares inverse (6, 3 n_nodes) of the displacements of a rigid motion."""
        if np.linalg.matrix_rank(displacements, tol=1e-6 * np.abs(displacements).max()) < 6:
            raise VehicleError(
                f"attachment {self.name!r}: found its {len(self.nodes)} nodes on one line, expected "
                "three or more that span a plane"
            )
        return np.asarray(np.linalg.pinv(displacements), float)


@dataclass(frozen=True, eq=False)
class OnNearestNodes(AttachmentPoint):
    """The mean of what the nearest nodes, each rigidly, say of the point; smooth in its position.

    Eight nodes with weights exp(-(d / 9 cm)²).
    """

    def motion(self, nodes: Floats) -> sp.csr_array:
        distance = np.linalg.norm(nodes - self.position, axis=1)
        nearest = np.argsort(distance, kind="stable")[:N_NEAR]
        # Measured from the nearest one, so that a far point doesn't underflow.
        weights = np.exp((distance[nearest[0]] ** 2 - distance[nearest] ** 2) / NEAR**2)
        weights = weights / weights.sum()
        T = rigid_motions(self.position - nodes[nearest])
        return _rows(weights[:, None, None] * T, nearest, len(nodes))


def unit_loads(points: Sequence[AttachmentPoint], nodes: Floats) -> Floats:
    """Unit forces at the points in each of their directions, (n_dofs, n_loads), point after point."""
    columns = [np.zeros((nodes.size * 2, 0))]
    for point in points:
        directions = ["xyz".index(axis) for axis in point.directions]
        columns.append(point.motion(nodes).toarray()[directions].T)
    return np.hstack(columns)


def _check_nodes_exist(point: AttachmentPoint, wanted: Sequence[int], n_nodes: int) -> None:
    for node in wanted:
        if not 0 <= node < n_nodes:
            raise VehicleError(
                f"attachment {point.name!r}: found node {node}, expected 0 to {n_nodes - 1}"
            )


def _rows(blocks: Floats, held: Sequence[int] | np.ndarray, n_nodes: int) -> sp.csr_array:
    """The blocks (n_held, 6, 6) side by side in the columns of the nodes held, (6, n_dofs)."""
    columns = 6 * np.asarray(held)[:, None, None] + np.arange(6)
    columns = np.broadcast_to(columns, blocks.shape)
    rows = np.broadcast_to(np.arange(6)[:, None], blocks.shape)
    triplets = blocks.ravel(), (rows.ravel(), columns.ravel())
    return sp.coo_array(triplets, shape=(6, 6 * n_nodes)).tocsr()
