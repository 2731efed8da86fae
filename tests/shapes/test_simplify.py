"""A mesh of very many faces is drawn with fewer, and looks the same."""

import time

import numpy as np
import pytest
import trimesh

from modeviz.shapes.simplify import simplified
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import Material, MeshPart, RigidBody
from modeviz.vehicle.mesh_doubts import MOST_DRAWN, mesh_doubts
from modeviz.vehicle.vehicle import Vehicle


def part(vertices, faces, name="a") -> MeshPart:
    return MeshPart(name, vertices, faces, Material((1, 2, 3)))


def of(mesh: trimesh.Trimesh) -> tuple[MeshPart]:
    return (part(mesh.vertices, mesh.faces),)


def loose(mesh: trimesh.Trimesh) -> tuple[MeshPart]:
    """With vertices of its own for each face, as STL has them."""
    return (part(mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(mesh.faces.size).reshape(-1, 3)),)


def triangles(mesh) -> np.ndarray:
    return np.concatenate([p.vertices[p.faces] for p in mesh])


def volume(mesh) -> float:
    a, b, c = triangles(mesh).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def area(mesh) -> float:
    a, b, c = triangles(mesh).transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def grid(n: int, at: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """A flat square of n x n vertices, and its faces."""
    x, y = np.meshgrid(np.linspace(at, at + 1, n), np.linspace(0, 1, n))
    q = np.arange(n * n).reshape(n, n)
    halves = [(q[:-1, :-1], q[:-1, 1:], q[1:, 1:]), (q[:-1, :-1], q[1:, 1:], q[1:, :-1])]
    faces = np.concatenate([np.stack(half, -1).reshape(-1, 3) for half in halves])
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), faces


SPHERE = trimesh.creation.icosphere(subdivisions=6)
BOX = trimesh.creation.box((4, 2, 1))
for _ in range(6):
    BOX = BOX.subdivide()


def test_a_mesh_of_few_faces_is_the_same():
    mesh = of(SPHERE)
    assert simplified(mesh, len(SPHERE.faces)) is mesh


@pytest.mark.parametrize("as_file", [of, loose], ids=["joined", "each face by itself"])
def test_a_sphere_stays_round_and_whole(as_file):
    (found,) = simplified(as_file(SPHERE), 8_000)
    assert 4_000 < len(found.faces) <= 8_000
    radii = np.linalg.norm(found.vertices, axis=1)
    side = np.sqrt(4 * np.pi / (len(found.faces) / 2))
    assert radii == pytest.approx(1, abs=side**2)  # a chord of that length is side²/8 inside
    assert volume((found,)) == pytest.approx(4 / 3 * np.pi, rel=side**2)
    edges = np.sort(found.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, n_faces = np.unique(edges, axis=0, return_counts=True)
    assert (n_faces == 1).mean() < 0.002  # nothing but flaps that lay on each other


@pytest.mark.parametrize("as_file", [of, loose], ids=["joined", "each face by itself"])
def test_a_box_keeps_its_corners_edges_and_volume(as_file):
    (found,) = simplified(as_file(BOX), 5_000)
    assert len(found.faces) <= 5_000
    assert volume((found,)) == pytest.approx(8, rel=1e-9)
    assert area((found,)) == pytest.approx(28, rel=1e-9)
    np.testing.assert_allclose(np.ptp(found.vertices, axis=0), [4, 2, 1], rtol=1e-12)


def test_a_plate_keeps_its_free_border():
    (found,) = simplified((part(*grid(150)),), 4_000)
    assert area((found,)) == pytest.approx(1, rel=1e-9)


def test_parts_that_touch_still_do():
    mesh = part(*grid(120)), part(*grid(120, at=1.0), "b")
    first, second = simplified(mesh, 6_000)
    shared = {tuple(v) for v in first.vertices} & {tuple(v) for v in second.vertices}
    assert len(shared) > 30
    assert np.ptp([v[1] for v in shared]) == pytest.approx(1)
    assert area((first, second)) == pytest.approx(2, rel=1e-9)
    assert (first.name, second.name) == ("a", "b")


def test_the_picture_goes_round_the_same_way():
    (found,) = simplified(of(SPHERE), 3_000)
    a, b, c = found.vertices[found.faces].transpose(1, 0, 2)
    outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a + b + c)
    assert (outward > 0).mean() > 0.99  # a few fold over


@pytest.mark.parametrize(
    "vertices",
    [
        np.zeros((300, 3)),
        np.linspace([0, 0, 0], [1, 1, 1], 300),
        np.random.default_rng(1).normal(size=(300, 3)) * 1e-12 + [9e4, 0, 0],
        np.random.default_rng(1).normal(size=(300, 3)) * [1e4, 1e-9, 1e-9],
    ],
    ids=["a point", "a line", "tiny and far", "long and thin"],
)
def test_what_has_hardly_a_surface_is_no_trouble(vertices):
    faces = np.random.default_rng(2).integers(0, 300, (2_000, 3))
    assert sum(len(p.faces) for p in simplified((part(vertices, faces),), 1_000)) <= 1_000


def test_hundreds_of_thousands_of_faces_are_drawn_as_fewer_within_seconds_and_that_is_noted():
    mesh = of(SPHERE.subdivide())
    body = RigidBody("ball", "other", "ball", 1.0, np.zeros(3), np.eye(3), mesh)
    start = time.process_time()
    drawn = surface(mesh)
    assert time.process_time() - start < 20
    assert sum(len(patch.faces) for patch in drawn.patches) <= MOST_DRAWN
    (note,) = mesh_doubts(Vehicle("x", (body,), ()))
    assert note == (
        f"body 'ball': mesh: has {len(mesh[0].faces):,} faces; a coarser surface is drawn, of at most "
        "100,000"
    )
