"""`python -m benchmarks.from_matrices`: components imported from mass and stiffness, and how large.

Blocks of solids, which fill the factors most, and vaulted sheets of shells, which fill them least. Each
is written as `.npz` with a table of nodes, and imported with 50 modes and four attachments.
"""

import argparse
import os
import time
from collections.abc import Sequence
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.sparse as sp

from benchmarks.large_component import Box
from benchmarks.measure import ONE_THREAD, in_own_process, peak_bytes
from modeviz.cli import main as modeviz
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import FiniteElementMesh, ShellSection
from modeviz.vehicle.arrays import Array, Floats

STEEL = {"youngs_modulus": 2.1e5, "poisson_ratio": 0.3, "density": 7.85e-9}
"""mm, t and s."""

STEP = 20.0
"""mm, between nodes of solids."""

SOLIDS = [(40, 24, 12), (60, 36, 14), (80, 48, 17)]
SHELLS = [90, 160, 280]
"""Elements along the shorter side; twice as many along the other."""


@dataclass(frozen=True)
class Taken:
    """What the import of a model takes."""

    n_dofs: int
    seconds: float
    """Of one core, whatever else the machine does."""
    peak_gb: float


def main() -> None:
    """Prints what each import takes."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.from_matrices", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="small ones: shows that all works")
    parser.add_argument(
        "--solids", nargs=3, type=int, action="append", metavar="N", help="nodes along x, y and z"
    )
    parser.add_argument("--shells", type=int, action="append", metavar="N", help="elements in width")
    options = parser.parse_args()
    os.environ.update(ONE_THREAD)
    solids, shells = options.solids or [], options.shells or []
    if not solids and not shells:
        solids, shells = ([(6, 5, 4)], [6]) if options.quick else (SOLIDS, SHELLS)
    for size in [*solids, *shells]:
        with TemporaryDirectory() as folder:
            in_own_process(write_model, Path(folder), size)
            taken = in_own_process(imported, Path(folder))
        kind = "shells" if isinstance(size, int) else "solids"
        print(
            f"{kind} {taken.n_dofs:9,} degrees of freedom"
            f" {taken.seconds:7.1f} s {taken.peak_gb:6.2f} GB",
            flush=True,
        )


def write_model(folder: Path, size: Sequence[int] | int) -> None:
    """Writes the matrices of a block or a sheet and the table of its nodes."""
    if isinstance(size, int):
        nodes, mass, stiffness, mask = _sheet(size)
    else:
        nodes, mass, stiffness, mask = _block(Box((size[0], size[1], size[2]), 0))
    sp.save_npz(folder / "K.npz", stiffness, compressed=False)
    sp.save_npz(folder / "M.npz", mass, compressed=False)
    table = np.column_stack([np.arange(1, len(nodes) + 1), nodes, np.full(len(nodes), mask)])
    np.savetxt(
        folder / "nodes.csv", table, "%d,%.9g,%.9g,%.9g,%d", header="node,x,y,z,dofs", comments=""
    )


def imported(folder: Path) -> Taken:
    """Imports the model by the command line, held at its first node and at three others."""
    n_nodes = len((folder / "nodes.csv").read_text().splitlines()) - 1
    held = np.linspace(1, n_nodes, 4).astype(int).tolist()
    attach = [f"--attach={node}" for node in held]
    files = [str(folder / name) for name in ("K.npz", "M.npz", "nodes.csv")]
    begin = time.process_time()
    with redirect_stdout(StringIO()):
        output = ["--output", str(folder / "vehicle"), "--units", "mm-t-s", *attach]
        status = modeviz(["import", *files, *output])
    seconds = time.process_time() - begin
    assert status == 0
    with np.load(folder / "K.npz") as parts:
        n_dofs = int(parts["shape"][0])
    return Taken(n_dofs, seconds, peak_bytes() / 1e9)


def _sheet(n: int) -> tuple[Floats, sp.csc_array, sp.csc_array, int]:
    """Nodes, mass, stiffness and directions of a vaulted sheet of 2 n by n shells."""
    u, v = np.meshgrid(np.linspace(0, 2, 2 * n + 1), np.linspace(0, 1, n + 1), indexing="ij")
    nodes = np.stack([1000 * u, 1000 * v, 200 * np.sin(4 * u) * np.sin(3 * v)], axis=-1).reshape(-1, 3)
    number = np.arange(u.size).reshape(u.shape)
    around = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    quads = np.stack(around, axis=-1).reshape(-1, 4)
    section = ShellSection(1.5, **STEEL)
    matrices = assemble(FiniteElementMesh(nodes, quads, (section,) * len(quads)))
    return nodes, matrices.mass, matrices.stiffness, 123456


def _block(box: Box) -> tuple[Floats, sp.csc_array, sp.csc_array, int]:
    """Nodes, mass, stiffness and directions of a block of solids, cubes of eight nodes."""
    mass, stiffness = block(box.corners() - 1, box.n_nodes)
    return box.places(), mass, stiffness, 123


def block(corners: Array, n_nodes: int) -> tuple[sp.csc_array, sp.csc_array]:
    """Mass and stiffness of cubes of steel with eight nodes each, (3 n_nodes, 3 n_nodes), in mm and t.

    Args:
        corners: (n_cubes, 8), nodes as `Box.corners` orders them.
        n_nodes: of them all.
    """
    dofs = (3 * corners[:, :, None] + np.arange(3)).reshape(len(corners), -1)
    mass, stiffness = (_assembled(dofs, A, 3 * n_nodes) for A in _cube())
    return mass, stiffness


def _assembled(dofs: Array, A: Floats, n: int) -> sp.csc_array:
    rows, columns = np.repeat(dofs, len(A), axis=1), np.tile(dofs, len(A))
    values = np.tile(A.ravel(), len(dofs))
    return sp.csc_array(sp.coo_array((values, (rows.ravel(), columns.ravel())), shape=(n, n)))


def _cube() -> tuple[Floats, Floats]:
    """Mass and stiffness of a trilinear cube, (24, 24), by two points of Gauss along each side."""
    round_about = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    corners = np.array([(x, y, z) for z in (-1, 1) for x, y in round_about], float)
    E, nu = STEEL["youngs_modulus"], STEEL["poisson_ratio"]
    mu = E / 2 / (1 + nu)
    D = np.diag([2 * mu] * 3 + [mu] * 3)
    D[:3, :3] += E * nu / ((1 + nu) * (1 - 2 * nu))
    M, K, volume = np.zeros((24, 24)), np.zeros((24, 24)), (STEP / 2) ** 3
    for point in corners / np.sqrt(3):
        parts = 1 + corners * point
        N = np.kron(parts.prod(axis=1) / 8, np.eye(3))
        others = np.stack([parts[:, [1, 2]], parts[:, [0, 2]], parts[:, [0, 1]]], axis=1)
        slopes = corners * others.prod(axis=2) / 8 * 2 / STEP
        B = np.zeros((6, 8, 3))
        for axis in range(3):
            B[axis, :, axis] = slopes[:, axis]
            one, other = (axis + 1) % 3, (axis + 2) % 3
            B[3 + axis, :, one], B[3 + axis, :, other] = slopes[:, other], slopes[:, one]
        B = B.reshape(6, 24)
        K += volume * B.T @ D @ B
        M += volume * STEEL["density"] * N.T @ N
    return M, K


if __name__ == "__main__":
    main()
