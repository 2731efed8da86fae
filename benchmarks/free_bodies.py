"""Free bodies of many kinds whose matrices are known: sheets, boxes, frames of beams, solids."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from benchmarks.from_matrices import block
from benchmarks.large_component import Box
from modeviz.fem.attachments import AttachmentPoint, OnFootprint, OnNode
from modeviz.fem.matrices import Matrices, assemble, nodal_matrices
from modeviz.fem.mesh import BeamSection, FiniteElementMesh, PointMass, ShellSection
from modeviz.vehicle.arrays import Array, Floats

STEEL = {"youngs_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850.0}

Place = Callable[[Floats, Floats], Sequence[Floats | float]]


@dataclass(frozen=True, eq=False)
class FreeBody:
    """A free body, and where it is held."""

    kind: str
    """sheet, symmetric, box, frame, bar or solid."""
    name: str
    matrices: Matrices
    points: tuple[AttachmentPoint, ...]


def free_bodies(seed: int = 1) -> Iterator[FreeBody]:
    """Yield them one after the other, each held at nodes, at means of nodes and by long arms."""
    rng = np.random.default_rng(seed)
    for kind, name, mesh in _meshes(rng):
        matrices = assemble(mesh)
        yield FreeBody(kind, name, matrices, _points(matrices.nodes, _spread(mesh), kind, rng))
    for name, nodes, keep in _blocks():
        matrices = _solid(nodes, keep)
        yield FreeBody("solid", name, matrices, _points(matrices.nodes, None, "solid", rng))


def _meshes(rng: np.random.Generator) -> Iterator[tuple[str, str, FiniteElementMesh]]:
    for thickness in (0.001, 0.004):
        for a, b, n in ((1.6, 0.9, 28), (2.4, 0.5, 44), (1.0, 0.8, 24)):
            yield "sheet", f"flat {a} x {b} x {thickness}", _flat(a, b, thickness, n)
        for rise in (0.03, 0.2):
            yield "sheet", f"vaulted {rise} x {thickness}", _vaulted(rise, thickness)
    for waves in (2, 5):
        yield "sheet", f"corrugated {waves}", _corrugated(waves)
    yield "sheet", "swaged and ribbed", _ribbed()
    yield "sheet", "with lumps", _lumped(rng)
    for n in (10, 24):
        yield "symmetric", f"square {n}", _flat(1.0, 1.0, 0.003, n)
    yield "symmetric", "rectangle", _flat(1.6, 0.8, 0.002, 30)
    for sides in ((1.4, 1.1, 0.9), (2.0, 0.4, 0.3)):
        for thickness in (0.001, 0.005):
            yield "box", f"box {sides} x {thickness}", _box(sides, thickness)
    yield "box", "tube", _tube(0.05, 1.5, 0.003)
    yield "box", "drum", _tube(0.35, 1.0, 0.0015)
    yield "box", "channel", _channel()
    for bars in (4, 9):
        yield "frame", f"ladder {bars}", _ladder(bars)
    for number in (3, 4, 5):
        yield "frame", f"space frame {number}", _space_frame(rng)
    yield "bar", "straight", _bar(np.outer(np.linspace(0, 2.0, 41), [1, 0.2, 0.1]))
    angle = np.linspace(0, 2.5, 61)[:, None]
    yield "bar", "bent", _bar(np.hstack([np.cos(angle), np.sin(angle), 0.2 * angle]))


def _blocks() -> Iterator[tuple[str, tuple[int, int, int], Callable[[Floats], Array]]]:
    yield "cube", (13, 11, 10), lambda p: np.ones(len(p), bool)
    yield "slab", (25, 17, 4), lambda p: np.ones(len(p), bool)
    yield "rod", (48, 6, 5), lambda p: np.ones(len(p), bool)
    yield "angle", (21, 16, 4), lambda p: (p[:, 0] < 140) | (p[:, 1] < 100)
    yield "holed", (20, 17, 5), lambda p: np.linalg.norm(p[:, :2] - [200, 150], axis=1) > 90
    yield "bracket", (16, 11, 14), lambda p: (p[:, 2] < 70) | (p[:, 0] < 70)


def shell(place: Place, n_u: int, n_v: int, section: ShellSection) -> FiniteElementMesh:
    """A surface u, v -> (x, y, z) over the unit square."""
    u, v = np.meshgrid(np.linspace(0, 1, n_u + 1), np.linspace(0, 1, n_v + 1), indexing="ij")
    index = np.arange(u.size).reshape(u.shape)
    nodes = np.stack(np.broadcast_arrays(*place(u, v)), axis=-1).reshape(-1, 3).astype(float)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    quads = np.stack(corners, axis=-1).reshape(-1, 4)
    return _merged(FiniteElementMesh(nodes, quads, (section,) * len(quads)))


def _flat(a: float, b: float, thickness: float, n: int) -> FiniteElementMesh:
    n_v = max(4, round(n * b / a))
    return shell(lambda u, v: (a * u, b * v, 0.0), n, n_v, ShellSection(thickness, **STEEL))


def _vaulted(rise: float, thickness: float) -> FiniteElementMesh:
    def place(u: Floats, v: Floats) -> tuple:
        return 1.5 * u, 1.0 * v, rise * np.sin(2.6 * u + 0.2) * np.sin(2.8 * v)

    return shell(place, 27, 18, ShellSection(thickness, **STEEL))


def _corrugated(waves: int) -> FiniteElementMesh:
    def place(u: Floats, v: Floats) -> tuple:
        return 1.6 * u, 0.9 * v, 0.02 * np.cos(waves * np.pi * v) * (1 + 0.3 * u)

    return shell(place, 26, 24, ShellSection(0.002, **STEEL))


def _ribbed() -> FiniteElementMesh:
    mesh = _flat(1.5, 1.0, 0.0015, 15)
    number = np.arange(16 * 11).reshape(16, 11)
    lines = [number[:, 3], number[:, 8], number[6, :], number[12, :]]
    beams = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    rib = BeamSection(2e-4, 4e-8, 2e-8, 1e-8, **STEEL)
    up = np.tile([0.0, 0.0, 1.0], (len(beams), 1))
    sections = (rib,) * len(beams)
    return FiniteElementMesh(mesh.nodes, mesh.quads, mesh.quad_sections, beams, sections, up)


def _lumped(rng: np.random.Generator) -> FiniteElementMesh:
    mesh = _flat(1.4, 1.1, 0.002, 24)
    lumps = rng.choice(len(mesh.nodes), 6, replace=False)
    masses = tuple(PointMass(int(node), 1.5) for node in lumps)
    return FiniteElementMesh(mesh.nodes, mesh.quads, mesh.quad_sections, point_masses=masses)


def _box(sides: Sequence[float], thickness: float) -> FiniteElementMesh:
    """A closed box, a pane on each side."""
    counts = [max(3, round(16 * side / max(sides))) for side in sides]
    panes = []
    for axis in range(3):
        one, other = [i for i in range(3) if i != axis]
        for end in (0.0, 1.0):

            def place(u: Floats, v: Floats, i=one, j=other, k=axis, end=end) -> tuple:
                along = {i: sides[i] * u, j: sides[j] * v, k: end * sides[k]}
                return tuple(along[axis] for axis in range(3))

            panes.append(shell(place, counts[one], counts[other], ShellSection(thickness, **STEEL)))
    return _joined(panes)


def _tube(radius: float, length: float, thickness: float) -> FiniteElementMesh:
    def place(u: Floats, v: Floats) -> tuple:
        return length * v, radius * np.cos(2 * np.pi * u), 0.8 * radius * np.sin(2 * np.pi * u)

    return shell(place, 20, 26, ShellSection(thickness, **STEEL))


def _channel() -> FiniteElementMesh:
    def place(u: Floats, v: Floats) -> tuple:
        corners = np.array([0.0, 0.25, 0.75, 1.0])
        across, up = (np.interp(u, corners, part) for part in ([-1, -1, 1, 1], [1, 0, 0, 1]))
        return 2.0 * v, 0.06 * across, 0.08 * up

    return shell(place, 12, 48, ShellSection(0.003, **STEEL))


def _bar(nodes: Floats) -> FiniteElementMesh:
    beams = np.stack([np.arange(len(nodes) - 1), np.arange(1, len(nodes))], axis=1)
    return _beams(nodes, beams, BeamSection(4e-4, 2e-8, 1e-8, 2.4e-8, **STEEL))


def _ladder(n_bars: int) -> FiniteElementMesh:
    ends = [(x, y, 0.05 * x) for x in np.linspace(0, 3.0, n_bars) for y in (0.0, 0.8)]
    edges = [(i, i + 1) for i in range(0, 2 * n_bars, 2)]
    edges += [(i, i + 2) for i in range(2 * n_bars - 2)]
    return _framework(np.array(ends), edges, BeamSection(1.2e-3, 1.6e-6, 0.8e-6, 1.4e-6, **STEEL))


def _space_frame(rng: np.random.Generator) -> FiniteElementMesh:
    """Corners of a box moved at random, with edges and some diagonals."""
    corners = np.array([(x, y, z) for x in (0, 1.0, 2.0) for y in (0, 0.8) for z in (0, 0.7)])
    corners = corners + 0.12 * rng.standard_normal(corners.shape)
    near = [
        (i, j)
        for i in range(12)
        for j in range(i + 1, 12)
        if np.linalg.norm(corners[i] - corners[j]) < 1.15
    ]
    return _framework(corners, near, BeamSection(3e-4, 4e-8, 3e-8, 5e-8, **STEEL))


def _framework(
    corners: Floats, edges: Sequence[tuple[int, int]], section: BeamSection
) -> FiniteElementMesh:
    """Beams between corners, each in six pieces."""
    nodes, beams = [*corners], []
    for a, b in edges:
        inner = np.arange(len(nodes), len(nodes) + 5)
        nodes += [corners[a] + part * (corners[b] - corners[a]) for part in np.arange(1, 6) / 6]
        line = np.r_[a, inner, b]
        beams.append(np.stack([line[:-1], line[1:]], axis=1))
    return _beams(np.array(nodes), np.concatenate(beams), section)


def _beams(nodes: Floats, beams: Array, section: BeamSection) -> FiniteElementMesh:
    up = np.tile([0.13, 0.31, 0.94], (len(beams), 1))
    return FiniteElementMesh(nodes, beams=beams, beam_sections=(section,) * len(beams), beam_up=up)


def _joined(meshes: Sequence[FiniteElementMesh]) -> FiniteElementMesh:
    first = np.cumsum([0, *(len(mesh.nodes) for mesh in meshes)])
    quads = np.concatenate([mesh.quads + n for mesh, n in zip(meshes, first, strict=False)])
    sections = tuple(section for mesh in meshes for section in mesh.quad_sections)
    return _merged(FiniteElementMesh(np.concatenate([m.nodes for m in meshes]), quads, sections))


def _merged(mesh: FiniteElementMesh) -> FiniteElementMesh:
    """The mesh with nodes at one place made one."""
    _, kept, number = np.unique(np.round(mesh.nodes, 6), axis=0, return_index=True, return_inverse=True)
    return FiniteElementMesh(mesh.nodes[kept], number.reshape(-1)[mesh.quads], mesh.quad_sections)


def _solid(size: tuple[int, int, int], keep: Callable[[Floats], Array]) -> Matrices:
    """A block of cubes without those whose middles are cut away, in metres and kilograms."""
    box = Box(size, 0)
    corners = box.corners() - 1
    kept = corners[keep(box.places()[corners].mean(axis=1))]
    used, kept = np.unique(kept, return_inverse=True)
    mass, stiffness = block(kept.reshape(-1, 8), len(used))
    nodes = box.places()[used] / 1000
    dofs = (6 * np.arange(len(used))[:, None] + np.arange(3)).ravel()
    return nodal_matrices(nodes, sp.csc_array(1e3 * mass), sp.csc_array(1e3 * stiffness), dofs)


def _spread(mesh: FiniteElementMesh) -> FiniteElementMesh | None:
    """The mesh if a footprint may lie on it."""
    return mesh if len(mesh.quads) else None


def _points(
    nodes: Floats, surface: FiniteElementMesh | None, kind: str, rng: np.random.Generator
) -> tuple[AttachmentPoint, ...]:
    """Eight: four on nodes (of symmetric bodies on axes), two on arms, two on means of nodes."""
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    if kind == "symmetric":
        wanted = low + (high - low) * np.array([(0.5, 0.5, 0), (0, 0.5, 0), (0.5, 0, 0), (0, 0, 0)])
        chosen = [int(np.argmin(np.linalg.norm(nodes - place, axis=1))) for place in wanted]
        chosen += rng.choice(len(nodes), 4, replace=False).tolist()
    else:
        chosen = rng.choice(len(nodes), 8, replace=False).tolist()
    points: list[AttachmentPoint] = [OnNode(f"node {n}", nodes[n], n) for n in chosen[:4]]
    size = np.linalg.norm(high - low)
    if kind != "solid":
        for n in chosen[4:6]:
            arm = size * 0.1 * rng.standard_normal(3)
            points.append(OnNode(f"arm {n}", nodes[n] + arm, n))
    if kind in ("frame", "bar"):
        return tuple(points)
    for n in chosen[6:]:
        near = np.argsort(np.linalg.norm(nodes - nodes[n], axis=1))[:9]
        points.append(OnFootprint(f"mean {n}", nodes[near].mean(axis=0), tuple(near.tolist())))
    return tuple(points)
