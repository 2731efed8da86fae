import numpy as np
import pytest

from modeviz.formats.component import Component, Modes
from modeviz.formats.surface import MOST_POINTS, display_mesh, outer_triangles, tubes

CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
FAR = CUBE + np.array([1, 0, 0])
HEXA = [0, 1, 3, 2, 4, 5, 7, 6]


def volume(nodes, faces) -> float:
    """What a closed surface encloses, by the divergence theorem; its faces are seen from outside."""
    a, b, c = np.moveaxis(nodes[faces], 1, 0)
    return float(np.sum(a * np.cross(b, c)) / 6)


@pytest.mark.parametrize(
    ("kind", "corners", "n_triangles", "expected"),
    [
        ("hexa", HEXA, 12, 1.0),
        ("wedge", [0, 1, 2, 4, 5, 6], 8, 1 / 2),
        ("tetra", [0, 1, 2, 4], 4, 1 / 6),
        ("pyramid", [0, 1, 3, 2, 4], 6, 1 / 3),
    ],
)
def test_the_faces_of_a_solid_enclose_its_volume(kind, corners, n_triangles, expected):
    faces = outer_triangles({kind: np.array([corners])})
    assert len(faces) == n_triangles
    assert volume(CUBE, faces) == pytest.approx(expected)


def test_a_face_that_two_solids_share_is_inside():
    nodes = np.concatenate([CUBE, FAR])
    other = [1, 9, 11, 3, 5, 13, 15, 7]  # its left face is the right one of the first
    faces = outer_triangles({"hexa": np.array([HEXA, other])})
    assert len(faces) == 2 * 10
    assert volume(nodes, faces) == pytest.approx(2)


def test_a_face_that_solids_of_two_kinds_share_is_inside():
    top = [4, 5, 7, 6, 8]
    nodes = np.concatenate([CUBE, [[0.5, 0.5, 2]]])
    faces = outer_triangles({"hexa": np.array([HEXA]), "pyramid": np.array([top])})
    assert len(faces) == 2 * 5 + 4
    assert volume(nodes, faces) == pytest.approx(1 + 1 / 3)


def test_shells_are_drawn_wherever_they_are():
    faces = outer_triangles({"quad": np.array([[0, 1, 3, 2]] * 2), "triangle": np.array([[0, 1, 2]])})
    assert len(faces) == 2 * 2 + 1


def test_lines_are_tubes_of_a_radius_around_both_ends():
    ends = np.array([[[0, 0, 0], [3, 0, 0]], [[1, 1, 1], [1, 2, 3]]], float)
    vertices, faces = tubes(ends, 0.1)
    around = vertices.reshape(2, 2, 3, 3)
    np.testing.assert_allclose(np.linalg.norm(around - ends[:, :, None], axis=-1), 0.1)
    along = ends[:, 1] - ends[:, 0]
    np.testing.assert_allclose(
        np.einsum("lesx,lx->les", around - ends[:, :, None], along), 0, atol=1e-12
    )
    assert faces.shape == (12, 3)
    assert sorted(set(faces.ravel().tolist())) == list(range(12))


@pytest.mark.parametrize("n_nodes", [8, MOST_POINTS, MOST_POINTS + 1, 130_000])
def test_of_many_nodes_without_elements_some_are_drawn(n_nodes):
    """As of large matrices with a table of nodes: all of them would be more faces than a page turns."""
    none = np.zeros(0)
    nodes = np.random.default_rng(0).random((n_nodes, 3))
    modes = Modes(none, none, none, np.zeros((n_nodes, 6, 0)))
    mesh, drawn = display_mesh(Component(np.arange(n_nodes), nodes, {}, modes), 1.0)
    assert min(n_nodes, MOST_POINTS / 2) <= len(drawn) <= MOST_POINTS
    assert len(mesh[0].faces) == 8 * len(drawn)
    np.testing.assert_allclose(np.ptp(nodes[drawn], axis=0), 1, atol=0.6)
