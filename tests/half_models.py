"""A corrugated sheet that is symmetric to a plane, by its full matrices and by runs of one half."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy.linalg
from small_meshes import STEEL, grid

from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import FiniteElementMesh, PointMass, ShellSection
from modeviz.formats.component import Component, Modes

SHIFT = 1e3
"""rad²/s²: of nodes' turning about the normal of the sheet, which has no inertia."""

HELD = {"symmetric": (1, 3, 5), "antisymmetric": (0, 2, 4), "free": ()}
"""What is held at the plane y = 0, of x, y, z, rx, ry, rz."""

SECTION = ShellSection(0.003, **STEEL)


@dataclass(frozen=True, eq=False)
class Run:
    """The lowest modes of a mesh that is held at y = 0, mass-normalised."""

    nodes: np.ndarray
    quads: np.ndarray
    frequency_hz: np.ndarray
    shapes: np.ndarray
    """(n_nodes, 6, n_modes)."""

    def component(self, first_id=1) -> Component:
        n = len(self.frequency_hz)
        none = np.full(n, np.nan)
        modes = Modes(self.frequency_hz, np.ones(n), none, self.shapes)
        ids = np.arange(first_id, first_id + len(self.nodes))
        return Component(ids, self.nodes, {"quad": self.quads}, modes)


def half_mesh():
    """Nodes and quads with y from 0 to 0.45 m."""
    return grid(lambda u, v: (1.4 * u, 0.45 * v, 0.05 * np.cos(4 * v) * (1 + u) + 0.1 * u**2), 8, 5)


def full_mesh():
    """The same with its image; nodes of the half come first."""
    nodes, quads = half_mesh()
    image = np.arange(len(nodes))
    own = np.flatnonzero(nodes[:, 1] > 0)
    image[own] = len(nodes) + np.arange(len(own))
    mirrored = image[quads][:, ::-1]
    return np.vstack([nodes, nodes[own] * [1, -1, 1]]), np.vstack([quads, mirrored])


@cache
def run(held: str, n_modes: int = 30) -> Run:
    """Of the half where something is held, of the whole where nothing is."""
    nodes, quads = full_mesh() if held == "free" else half_mesh()
    heavy = np.flatnonzero((nodes[:, 0] > 1.39) & (np.abs(nodes[:, 1]) > 0.44))
    lumps = tuple(PointMass(int(node), 3.0) for node in heavy)
    mesh = FiniteElementMesh(nodes, quads, (SECTION,) * len(quads), point_masses=lumps)
    matrices = assemble(mesh)
    in_plane = np.flatnonzero(np.abs(nodes[:, 1]) < 1e-9)
    fixed = (6 * in_plane[:, None] + np.array(HELD[held], int)).ravel()
    free = np.setdiff1d(np.arange(6 * len(nodes)), fixed)
    M, K = (matrix.toarray()[np.ix_(free, free)] for matrix in (matrices.mass, matrices.stiffness))
    last = len(free) - 1
    values, vectors = scipy.linalg.eigh(M, K + SHIFT * M, subset_by_index=[last - n_modes + 1, last])
    shapes = np.zeros((6 * len(nodes), n_modes))
    shapes[free] = vectors[:, ::-1] / np.sqrt(values[::-1])
    squares = 1 / values[::-1] - SHIFT
    hertz = np.sign(squares) * np.sqrt(np.abs(squares)) / (2 * np.pi)
    return Run(nodes, quads, hertz, shapes.reshape(len(nodes), 6, -1))
