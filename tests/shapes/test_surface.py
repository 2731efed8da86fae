import numpy as np

from modeviz.shapes.surface import outlines, surface, vertex_areas
from modeviz.vehicle.bodies import Material, MeshPart

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def square(name, size, color=(10, 20, 30), opacity=1.0):
    return MeshPart(name, SQUARE * size, FACES, Material(color, opacity))


def test_parts_keep_their_order_on_one_vertex_array():
    drawn = surface((square("panel", 1.0), square("glass", 0.7, opacity=0.8)))
    assert np.array_equal(drawn.vertices, np.vstack([SQUARE, SQUARE * 0.7]))
    for patch, size in zip(drawn.patches, (1.0, 0.7), strict=True):
        assert np.array_equal(drawn.vertices[patch.faces], (SQUARE * size)[FACES])


def test_small_parts_are_dressing():
    drawn = surface((square("panel", 1.0), square("lamp", 0.2), square("door", 0.8)))
    assert [patch.is_skin for patch in drawn.patches] == [True, False, True]


def test_edges_are_those_of_opaque_skin():
    drawn = surface((square("lamp", 0.2), square("panel", 1.0), square("glass", 1.0, opacity=0.8)))
    assert {tuple(e) for e in drawn.edges.tolist()} == {(4, 5), (5, 6), (6, 7), (4, 7)}


def test_outlines_keep_only_the_vertices_of_edges_and_their_places():
    drawn = surface((square("lamp", 0.2), square("panel", 1.0), square("glass", 1.0, opacity=0.8)))
    alone, kept = outlines(drawn)
    assert kept.tolist() == [4, 5, 6, 7]
    assert np.array_equal(alone.vertices, drawn.vertices[4:8])
    assert np.array_equal(kept[alone.edges], drawn.edges)


def test_vertices_share_the_area_of_their_faces():
    areas = vertex_areas(surface((square("panel", 1.0), square("glass", 3.0))))
    np.testing.assert_allclose(areas[:4], np.array([2, 1, 2, 1]) / 6)
    np.testing.assert_allclose(areas[4:], 9 * areas[:4])
    assert vertex_areas(surface(())).shape == (0,)


def test_body_without_a_mesh_has_nothing_to_draw():
    drawn = surface(())
    assert (drawn.vertices.shape, drawn.patches, drawn.edges.shape) == ((0, 3), (), (0, 2))
