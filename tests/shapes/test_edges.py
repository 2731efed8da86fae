import numpy as np
import pytest

from modeviz.shapes.edges import feature_edges

BOX = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
BOX_QUADS = np.array(
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
)


def triangles(quads):
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def folded_strip(angle):
    rise = np.array([np.cos(angle), 0, np.sin(angle)])
    vertices = np.array([[-1.0, 0, 0], [-1, 1, 0], [0, 0, 0], [0, 1, 0], rise, rise + np.eye(3)[1]])
    return vertices, triangles(np.array([[0, 2, 3, 1], [2, 4, 5, 3]]))


def as_set(edges):
    return {tuple(edge) for edge in edges.tolist()}


def test_box_has_its_twelve_edges_and_no_diagonals():
    edges = feature_edges(BOX, triangles(BOX_QUADS))
    lengths = np.linalg.norm(BOX[edges[:, 0]] - BOX[edges[:, 1]], axis=1)
    assert len(edges) == 12
    assert lengths == pytest.approx(np.ones(12))


def test_corners_in_one_place_are_welded_so_a_box_of_loose_sides_has_the_same_edges():
    loose = BOX[BOX_QUADS].reshape(-1, 3)
    edges = feature_edges(loose, triangles(np.arange(24).reshape(6, 4)))
    ends = {frozenset(map(tuple, loose[edge].tolist())) for edge in edges}
    whole = feature_edges(BOX, triangles(BOX_QUADS))
    assert ends == {frozenset(map(tuple, BOX[edge].tolist())) for edge in whole}
    assert len(edges) == 12


@pytest.mark.parametrize(("degrees", "n_edges"), [(24, 6), (26, 7), (180 - 24, 6), (180 - 26, 7)])
def test_fold_is_drawn_from_twenty_five_degrees(degrees, n_edges):
    assert len(feature_edges(*folded_strip(np.radians(degrees)))) == n_edges


def test_turning_a_face_round_changes_nothing():
    vertices, faces = folded_strip(np.radians(10))
    turned = faces.copy()
    turned[:2] = turned[:2, ::-1]
    assert as_set(feature_edges(vertices, turned)) == as_set(feature_edges(vertices, faces))


def test_junction_of_three_sheets_is_drawn():
    vertices, faces = folded_strip(0.0)
    vertices = np.vstack([vertices, [[0, 0, 1], [0, 1, 1]]])
    wall = triangles(np.array([[2, 6, 7, 3]]))
    # the wall between the two level sheets, so that first and last face of the edge are level
    assert (2, 3) in as_set(feature_edges(vertices, np.vstack([faces[:2], wall, faces[2:]])))
    assert (2, 3) not in as_set(feature_edges(vertices, faces))


def test_surface_without_faces_has_no_edges():
    assert feature_edges(BOX, np.zeros((0, 3), int)).shape == (0, 2)


@pytest.mark.parametrize("length", [1e-5, 1.0, 1e4])
def test_edges_do_not_depend_on_the_size_of_a_vehicle(length):
    loose, faces = BOX[BOX_QUADS].reshape(-1, 3), triangles(np.arange(24).reshape(6, 4))
    assert as_set(feature_edges(length * loose, faces)) == as_set(feature_edges(loose, faces))
