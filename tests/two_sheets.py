"""Two corrugated sheets that mounts join at four places, by their full matrices and by modes."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy.linalg
from small_meshes import STEEL, shell

from modeviz.fem.attachments import OnNode
from modeviz.fem.component import body_from_matrices
from modeviz.fem.matrices import Matrices, assemble
from modeviz.fem.mesh import ShellSection
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.vehicle import Vehicle

PLACES = np.array([(0.15, 0.1, 0.04), (1.3, 0.05, 0.04), (0.3, 0.7, 0.04), (1.4, 0.8, 0.04)])
"""m, where no symmetry leaves modes still."""
SHIFT = 1e3
"""rad²/s²: of the sheets' turning about their normals, which has no inertia."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """One of them."""

    name: str
    matrices: Matrices
    points: tuple[OnNode, ...]

    def body(self, n_modes: int, with_residuals: bool = False) -> FlexibleBody:
        body = body_from_matrices(
            self.name, "frame", self.name, self.matrices, self.points, n_modes, 0.01
        )
        return body if with_residuals else body.truncated(n_modes)

    @property
    def rows(self) -> Floats:
        """(12, n_dofs): motions of the points along x, y and z."""
        nodes, motion = self.matrices.nodes, self.matrices.motion
        return np.vstack([(point.motion(nodes) @ motion).toarray()[:3] for point in self.points])

    @property
    def compliance(self) -> Floats:
        """(4, 3), m/N, of the free sheet at its points, from all its modes."""
        body = self.body(120, with_residuals=True)
        phi = np.array([a.shapes[:3, 6:] for a in body.attachments])
        return np.sum(phi**2 / body.omega_n_squared[6:], axis=2)


def _sheet(name, n_u, n_v, thickness, height, waves) -> Sheet:
    def place(u, v):
        return 1.6 * u, 0.9 * v, height + 0.02 * np.cos(waves * np.pi * v) * (1 + 0.3 * u)

    matrices = assemble(shell(place, n_u, n_v, ShellSection(thickness, **STEEL)))
    points = []
    for i, wanted in enumerate(PLACES):
        node = int(np.argmin(np.linalg.norm(matrices.nodes[:, :2] - wanted[:2], axis=1)))
        points.append(
            OnNode(f"{name} {i}", wanted * [0, 0, 1] + matrices.nodes[node] * [1, 1, 0], node)
        )
    return Sheet(name, matrices, tuple(points))


@cache
def sheets() -> tuple[Sheet, Sheet]:
    return _sheet("floor", 12, 8, 0.003, 0.03, 3), _sheet("roof", 12, 8, 0.004, 0.05, 2)


def mount_stiffness(part: float) -> Floats:
    """(4, 3), N/m: that part of what both sheets together are stiff across; half as much along them."""
    floor, roof = sheets()
    across = part / (floor.compliance + roof.compliance)[:, 2:]
    return across * np.array([0.5, 0.5, 1.0])


def joined(floor: FlexibleBody, roof: FlexibleBody, stiffness: Floats) -> Vehicle:
    springs = tuple(
        Spring(f"mount {i}", "mounts", ("floor", "roof"), np.tile(p.position, (2, 1)), stiffness=k)
        for i, (p, k) in enumerate(zip(sheets()[0].points, stiffness, strict=True))
    )
    return Vehicle("sheets", (floor, roof), springs)


def direct_frequencies(stiffness: Floats) -> Floats:
    """Hz of the full matrices of both with the mounts between them, rising, 100 of them."""
    floor, roof = sheets()
    M = scipy.linalg.block_diag(floor.matrices.mass.toarray(), roof.matrices.mass.toarray())
    K = scipy.linalg.block_diag(floor.matrices.stiffness.toarray(), roof.matrices.stiffness.toarray())
    R = np.hstack([floor.rows, -roof.rows])
    K = K + R.T @ (stiffness.ravel()[:, None] * R)
    last = len(M) - 1
    found = scipy.linalg.eigh(M, K + SHIFT * M, eigvals_only=True, subset_by_index=[last - 99, last])
    return np.sqrt(np.maximum(1 / found[::-1] - SHIFT, 0)) / (2 * np.pi)
