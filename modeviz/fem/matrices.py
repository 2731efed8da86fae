"""Sparse mass and stiffness of a free body, assembled from its mesh."""

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from modeviz.errors import ModevizError
from modeviz.fem.mesh import FiniteElementMesh, PointMass
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions


@dataclass(frozen=True, eq=False)
class Matrices:
    """A free body in degrees of freedom that move its nodes: `nodal_matrices` has the usual ones."""

    nodes: Floats
    """(n_nodes, 3), m."""
    mass: sp.csc_array
    """(n_dofs, n_dofs), kg and kg m², symmetric."""
    stiffness: sp.csc_array
    """(n_dofs, n_dofs), N/m and N m/rad, symmetric, without force in rigid motion."""
    motion: sp.csr_array | Floats
    """(6 n_nodes, n_dofs): how each moves the nodes along x, y, z, rx, ry, rz, node after node."""
    rigid: Floats
    """(n_dofs, 6): what they are when the whole moves along x, y, z, rx, ry, rz about the origin."""

    @property
    def n_dofs(self) -> int:
        """The number of degrees of freedom."""
        return len(self.rigid)

    @property
    def turns(self) -> np.ndarray:
        """Whether a degree of freedom turns each node, (n_nodes,): none does those of solids."""
        moved = abs(self.motion).sum(axis=1) > 0
        return np.asarray(moved.reshape(-1, 6)[:, 3:].any(axis=1))

    @property
    def owners(self) -> np.ndarray:
        """The node that each degree of freedom moves, (n_dofs,), the first of several; -1: none."""
        columns = sp.csc_array(self.motion)
        moves = np.diff(columns.indptr) > 0
        owners = np.full(self.n_dofs, -1)
        owners[moves] = columns.indices[columns.indptr[:-1][moves]] // 6
        return owners

    def scaled(self, stiffness_factor: float, mass_factor: float) -> "Matrices":
        """The body in a material so many times as stiff and as heavy."""
        return replace(self, mass=self.mass * mass_factor, stiffness=self.stiffness * stiffness_factor)


def nodal_matrices(
    nodes: Floats, mass: sp.csc_array, stiffness: sp.csc_array, dofs: np.ndarray | None = None
) -> Matrices:
    """Matrices whose degrees of freedom are motions of nodes themselves.

    Args:
        nodes: (n_nodes, 3), m.
        mass: (n_dofs, n_dofs), kg and kg m².
        stiffness: (n_dofs, n_dofs), N/m and N m/rad.
        dofs: (n_dofs,), which they are, 6 node + (0 to 5 for x to rz); all of them, if not given.
    """
    motion = sp.csc_array(sp.eye_array(6 * len(nodes)))
    rigid = rigid_motions(nodes).reshape(-1, 6)
    if dofs is None:
        return Matrices(nodes, mass, stiffness, motion.tocsr(), rigid)
    return Matrices(nodes, mass, stiffness, motion[:, dofs].tocsr(), rigid[dofs])


def assemble(mesh: FiniteElementMesh) -> Matrices:
    """The matrices of a mesh of shells, beams and point masses.

    Raises:
        ModevizError: pyfe3d is not installed.
    """
    try:
        from modeviz.fem import elements
    except ModuleNotFoundError as error:
        raise ModevizError(
            "finite-element models need pyfe3d: install it with: pip install 'modeviz[fem]'"
        ) from error
    corners, ends = mesh.nodes[mesh.quads], mesh.nodes[mesh.beams]
    K_quads, M_quads = elements.shell_matrices(corners, mesh.quad_sections)
    K_beams, M_beams = elements.beam_matrices(ends, mesh.beam_up, mesh.beam_sections)
    lumps = np.array([[p.node] for p in mesh.point_masses], int).reshape(-1, 1)
    M_lumps = np.array([_point_mass_matrix(p) for p in mesh.point_masses]).reshape(-1, 6, 6)
    n_dofs = mesh.nodes.size * 2
    return nodal_matrices(
        mesh.nodes,
        _scatter(n_dofs, (mesh.quads, M_quads), (mesh.beams, M_beams), (lumps, M_lumps)),
        _scatter(
            n_dofs, (mesh.quads, without_rotation_strain(corners, K_quads)), (mesh.beams, K_beams)
        ),
    )


def without_rotation_strain(corners: Floats, stiffness: Floats) -> Floats:
    """Element stiffness that no rigid motion of the true corners strains, as `stiffness`.

    K ← Pᵀ K P with P = I - R (Rᵀ R)⁻¹ Rᵀ, which removes the rigid motions R from what an element
    feels. It changes nothing on a flat one, and by the square of the warp otherwise.

    Args:
        corners: (n_elements, n_corners, 3), m.
        stiffness: (n_elements, n_dofs, n_dofs), N/m and N m/rad.
    """
    n_elements, n_corners, _ = corners.shape
    arms = corners - corners.mean(axis=1, keepdims=True)
    size = np.linalg.norm(arms, axis=2).mean(axis=1)
    # Rotations count as displacements at the element's size, so that both weigh alike in P.
    weights = np.ones((n_elements, 6 * n_corners))
    weights[:, np.arange(6 * n_corners) % 6 >= 3] = size[:, None]
    R = rigid_motions(arms).reshape(n_elements, 6 * n_corners, 6) * weights[:, :, None]
    P = np.eye(6 * n_corners) - R @ np.linalg.pinv(R)
    P = P * weights[:, None, :] / weights[:, :, None]
    return P.swapaxes(1, 2) @ stiffness @ P


def _point_mass_matrix(point: PointMass) -> Floats:
    """The mass of a lump at an offset from its node, (6, 6)."""
    T = rigid_motions(np.array(point.offset))
    return T.T @ np.diag([point.mass] * 3 + list(point.inertia)) @ T


def _scatter(n_dofs: int, *groups: tuple[np.ndarray, Floats]) -> sp.csc_array:
    """The sum of element matrices at the places of their nodes, made exactly symmetric.

    Args:
        n_dofs: of the whole.
        groups: for each kind of element its nodes (n_elements, n) and matrices
            (n_elements, 6 n, 6 n).
    """
    rows, columns, values = [], [], []
    for nodes, matrices in groups:
        dofs = (6 * nodes[:, :, None] + np.arange(6)).reshape(matrices.shape[:2])
        shape = matrices.shape
        rows.append(np.broadcast_to(dofs[:, :, None], shape).ravel())
        columns.append(np.broadcast_to(dofs[:, None, :], shape).ravel())
        values.append(matrices.ravel())
    triplets = np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))
    A = sp.coo_array(triplets, shape=(n_dofs, n_dofs)).tocsc()
    A.eliminate_zeros()
    return ((A + A.T) / 2).tocsc()
