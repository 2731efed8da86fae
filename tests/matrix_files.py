"""Two structures of shells and beams with their full matrices, as files and joined without modes."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.linalg
import scipy.sparse as sp
from small_meshes import BAR, STEEL, bar, grid

from modeviz.fem.matrices import Matrices, assemble
from modeviz.fem.mesh import FiniteElementMesh, ShellSection

FIRST = 101
"""The number of the first node."""


@dataclass(frozen=True, eq=False)
class Structure:
    """A mesh whose nodes are numbered, in SI."""

    matrices: Matrices

    @property
    def ids(self) -> np.ndarray:
        return FIRST + np.arange(len(self.matrices.nodes))

    def in_mm_t_s(self) -> tuple[sp.csc_array, sp.csc_array, np.ndarray]:
        """Mass, stiffness and places in mm, t and s: u = 0.001 of one, forces N, moments N mm."""
        n = len(self.matrices.nodes)
        D = sp.diags_array(np.tile([1e-3, 1e-3, 1e-3, 1.0, 1.0, 1.0], n))
        # Energy in N mm = mJ.
        K = sp.csc_array(1e3 * (D @ self.matrices.stiffness @ D))
        M = sp.csc_array(1e3 * (D @ self.matrices.mass @ D))
        return M, K, 1e3 * self.matrices.nodes


def ribbed_panel() -> Structure:
    """An arched sheet, 0.9 m by 0.6 m, with two beams along its edges."""
    nodes, quads = grid(lambda u, v: (0.9 * u, 0.6 * v, 0.05 * np.sin(np.pi * v)), 9, 6)
    edges = np.vstack([[[7 * i, 7 * i + 7], [7 * i + 6, 7 * i + 13]] for i in range(9)])
    mesh = FiniteElementMesh(
        nodes,
        quads,
        (ShellSection(0.002, **STEEL),) * len(quads),
        beams=edges,
        beam_sections=(BAR,) * len(edges),
        beam_up=np.tile([0.0, 0.0, 1.0], (len(edges), 1)),
    )
    return Structure(assemble(mesh))


def beam() -> Structure:
    """A beam of 0.9 m along an edge of the panel; every second of its nodes is at one of that."""
    return Structure(assemble(bar(18, 0.9)))


def write_table(path: Path, structure: Structure, dofs: str = "") -> Path:
    lines = ["node,x,y,z" + (",dofs" if dofs else "")]
    places = structure.in_mm_t_s()[2]
    for label, place in zip(structure.ids, places, strict=True):
        numbers = ",".join(f"{value:.17g}" for value in place)
        lines.append(f"{label},{numbers}" + (f",{dofs}" if dofs else ""))
    path.write_text("\n".join(lines) + "\n")
    return path


def joined_frequencies(
    structures: list[Structure], springs: list[tuple[int, int, np.ndarray]]
) -> np.ndarray:
    """Hz of two structures with springs between nodes along x, y, z, of their full matrices.

    Args:
        structures: the first and the second.
        springs: the numbers of a node of each, and the stiffness along x, y, z, N/m.
    """
    M = sp.block_diag([s.matrices.mass for s in structures]).toarray()
    K = sp.block_diag([s.matrices.stiffness for s in structures]).toarray()
    second = structures[0].matrices.n_dofs
    for one, other, stiffness in springs:
        for direction, k in enumerate(stiffness):
            i, j = 6 * (one - FIRST) + direction, second + 6 * (other - FIRST) + direction
            K[[i, j], [i, j]] += k
            K[[i, j], [j, i]] -= k
    flexibility = scipy.linalg.eigh(M, K + 100 * M, eigvals_only=True)[::-1]
    flexibility = flexibility[flexibility > 1e-12]
    return np.sqrt(np.maximum(1 / flexibility - 100, 0)) / (2 * np.pi)
