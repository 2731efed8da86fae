"""How do components of your own become a vehicle whose mounts are tuned?

From another program's files to a card for it: the matrices of a ladder frame and of a cab, which any
finite-element program writes (here SciPy does, as Matrix Market files in mm and t), become bodies of a
vehicle folder; a table that a spreadsheet could have saved puts the cab on four mounts; a few lines
more set it on tyres and a driver into it. Then it is checked, solved on a road of ISO 8608, tuned, and
the rates go back as PBUSH cards. Every step is what one would type. It needs the extra `fem`.
"""

import shlex
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import scipy.io
import scipy.sparse as sp

import modeviz as mv
from modeviz.cli import main
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import BeamSection, FiniteElementMesh, PointMass

STEEL = {"youngs_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850.0}
RAIL = BeamSection(1.4e-3, 4.2e-6, 1.6e-6, 2.8e-6, **STEEL)
PILLAR = BeamSection(8e-4, 1.1e-6, 0.9e-6, 1.5e-6, added_mass=4.0, **STEEL)

MOUNTS = """name,group,body 1,body 2,x [mm],y [mm],z [mm],kx [N/mm],ky [N/mm],kz [N/mm],loss factor
front left,front,cab,frame,-700,-400,650,150,150,300,0.12
front right,front,cab,frame,-700,400,650,,,,
rear left,rear,cab,frame,700,-400,650,150,150,300,0.12
rear right,rear,cab,frame,700,400,650,,,,
"""

REST = """
[[response_point]]
name = "seat"
body = "cab"
at = [0.7, -0.4, 0.7]
"""

TYRE = """
[[tyre]]
name = "{name}"
bodies = ["frame", "ground"]
at = [[{x}, {y}, 0.6], [{x}, {y}, 0.0]]  # wheel and road
wheel_center = [{x}, {y}, 0.6]
stiffness = [40.0, 40.0, 60.0]
damping = [1500.0, 1500.0, 3000.0]
"""


def beams(nodes: np.ndarray, lines: list[tuple[int, int]], section: BeamSection) -> FiniteElementMesh:
    """Beams between nodes, m, each cut in four."""
    places, cut = list(nodes), []
    for a, b in lines:
        between = [nodes[a] + part * (nodes[b] - nodes[a]) for part in (0.25, 0.5, 0.75)]
        chain = [a, *range(len(places), len(places) + 3), b]
        places += between
        cut += pairwise(chain)
    along = np.array([places[b] - places[a] for a, b in cut])
    up = np.where(
        np.abs(along[:, 2:]) > 0.5 * np.linalg.norm(along, axis=1)[:, None], [1, 0, 0], [0, 0, 1]
    )
    return FiniteElementMesh(
        np.array(places),
        beams=np.array(cut),
        beam_sections=(section,) * len(cut),
        beam_up=up,
    )


def frame() -> FiniteElementMesh:
    """Two rails of 4.2 m with four cross members, and the engine on the first of these."""
    x = (-2.1, -0.7, 0.7, 2.1)
    nodes = np.array([[at, y, 0.6] for y in (-0.4, 0.4) for at in x])
    lines = [*pairwise(range(4)), *pairwise(range(4, 8)), *((i, i + 4) for i in range(4))]
    mesh = beams(nodes, lines, RAIL)
    engine = tuple(PointMass(node, 150.0, inertia=(6.0, 9.0, 9.0)) for node in (0, 4))
    return FiniteElementMesh(
        mesh.nodes,
        beams=mesh.beams,
        beam_sections=mesh.beam_sections,
        beam_up=mesh.beam_up,
        point_masses=engine,
    )


def cab() -> FiniteElementMesh:
    """A box of pillars, 1.4 m long and high, braced on every side."""
    nodes = np.array([[x, y, z] for z in (0.7, 2.1) for y in (-0.4, 0.4) for x in (-0.7, 0.7)])
    floor = [(0, 1), (2, 3), (0, 2), (1, 3), (0, 3)]
    roof = [(a + 4, b + 4) for a, b in floor]
    sides = [(0, 4), (1, 5), (2, 6), (3, 7), (0, 5), (2, 7), (0, 6), (1, 7)]
    return beams(nodes, floor + roof + sides, PILLAR)


def write_matrices(mesh: FiniteElementMesh, name: str, folder: Path) -> None:
    """Writes mass, stiffness and nodes of a mesh as another program has them, in mm and t."""
    matrices = assemble(mesh)
    to_metres = sp.diags_array(np.tile([1e-3] * 3 + [1.0] * 3, len(mesh.nodes)))
    for letter, matrix in (("K", matrices.stiffness), ("M", matrices.mass)):
        in_millijoules = 1000 * (to_metres @ matrix @ to_metres)
        scipy.io.mmwrite(folder / f"{name}_{letter}.mtx", sp.coo_array(in_millijoules))
    lines = [f"{i},{x:.1f},{y:.1f},{z:.1f}" for i, (x, y, z) in enumerate(1000 * mesh.nodes, start=1)]
    text = "\n".join(["node,x,y,z", *lines, ""])
    (folder / f"{name}_nodes.csv").write_text(text, encoding="utf-8")


def modeviz(line: str) -> None:
    """Runs a command, which is printed as one would type it."""
    print(f"\n$ modeviz {line}")
    assert main(shlex.split(line)) == 0


def walk_through(home: Path) -> tuple[mv.Study, str]:
    """Goes the whole way in a folder; the study of the vehicle with its tuned rates, and the cards."""
    write_matrices(frame(), "frame", home)
    write_matrices(cab(), "cab", home)
    at_frame = ["-2100,-400,600", "-2100,400,600", "2100,-400,600", "2100,400,600"]
    at_frame += ["-700,-400,600", "-700,400,600", "700,-400,600", "700,400,600"]
    attach = " ".join(f"--attach 'p{i}={place}'" for i, place in enumerate(at_frame, start=1))
    truck = home / "truck"
    modeviz(
        f"import {home}/frame_K.mtx {home}/frame_M.mtx {home}/frame_nodes.csv --output {truck} "
        f"--units mm-t-s --name frame --modes 30 {attach}"
    )
    attach = " ".join(f"--attach c{node}={node}" for node in (1, 2, 3, 4))
    modeviz(
        f"import {home}/cab_K.mtx {home}/cab_M.mtx {home}/cab_nodes.csv --output {truck} "
        f"--units mm-t-s --name cab --modes 30 {attach}"
    )
    (home / "mounts.csv").write_text(MOUNTS, encoding="utf-8")
    modeviz(f"import {home}/mounts.csv --output {truck}")
    wheels = (("front left", -2.1, -0.4), ("front right", -2.1, 0.4))
    wheels += (("rear left", 2.1, -0.4), ("rear right", 2.1, 0.4))
    with (truck / "vehicle.toml").open("a", encoding="utf-8") as file:
        file.write(REST + "".join(TYRE.format(name=f"tyre {n}", x=x, y=y) for n, x, y in wheels))
    modeviz(f"check {truck}")
    modeviz(f"modes {truck}")
    modeviz(f"optimise {truck} --starts 4 --output {home}/tuned.csv")
    modeviz(f"psd {truck} --rates {home}/tuned.csv")
    modeviz(f"export {truck} {home}/rates.bdf --rates {home}/tuned.csv")
    study = mv.Study(str(truck))
    study.rates.use(str(home / "tuned.csv"))
    return study, (home / "rates.bdf").read_text("utf-8")


with TemporaryDirectory() as folder:
    study, cards = walk_through(Path(folder))

if __name__ == "__main__":
    print(f"\n{cards}")
