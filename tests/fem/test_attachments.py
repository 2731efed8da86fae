import numpy as np
import pytest
from small_meshes import plate

from modeviz.errors import VehicleError
from modeviz.fem.attachments import OnFootprint, OnNearestNodes, OnNode, unit_loads
from modeviz.vehicle.rigid import rigid_motions

NODES = plate(4).nodes
POSITION = np.array([0.3, 0.4, 0.2])
POINTS = [
    OnNode("node", POSITION, 6),
    OnFootprint("footprint", POSITION, (0, 3, 12, 20)),
    OnNearestNodes("nearest", POSITION),
]


@pytest.mark.parametrize("point", POINTS, ids=lambda p: p.name)
def test_point_follows_rigid_motion_of_its_body(point):
    rigid = rigid_motions(NODES).reshape(-1, 6)
    np.testing.assert_allclose(point.motion(NODES) @ rigid, rigid_motions(POSITION), atol=1e-12)


@pytest.mark.parametrize("point", POINTS, ids=lambda p: p.name)
def test_force_at_a_point_has_the_same_resultant_on_the_nodes(point):
    force_and_couple = np.array([1.0, -2.0, 3.0, 0.4, 0.5, -0.6])
    nodal = point.motion(NODES).T @ force_and_couple
    about_origin = rigid_motions(NODES).reshape(-1, 6).T @ nodal
    np.testing.assert_allclose(about_origin[:3], force_and_couple[:3], atol=1e-12)
    np.testing.assert_allclose(
        about_origin[3:], force_and_couple[3:] + np.cross(POSITION, force_and_couple[:3]), atol=1e-12
    )


def test_point_on_a_node_moves_with_no_other():
    assert set(OnNode("a", POSITION, 6).motion(NODES).tocoo().col // 6) == {6}


def test_footprint_takes_no_notice_of_rotations():
    B = POINTS[1].motion(NODES).toarray().reshape(6, -1, 6)
    assert (B[:, :, 3:] == 0).all()
    assert set(np.flatnonzero(np.abs(B).max(axis=(0, 2)))) == {0, 3, 12, 20}


def test_footprint_on_a_line_is_refused():
    with pytest.raises(VehicleError, match="'seat': found its 3 nodes on one line"):
        OnFootprint("seat", POSITION, (0, 1, 2)).motion(NODES)


def test_footprint_far_from_its_point_is_accepted():
    OnFootprint("seat", np.array([100.0, 0.0, 0.0]), (0, 3, 12)).motion(NODES)


def test_node_that_does_not_exist_is_refused():
    with pytest.raises(VehicleError, match="'bracket': found node 25, expected 0 to 24"):
        OnNode("bracket", POSITION, 25).motion(NODES)


def test_mean_of_nearest_nodes_weighs_by_distance():
    # A point on a node: the four neighbours at 0.25 m weigh exp(-(25 / 9)²) of it.
    B = OnNearestNodes("seat", NODES[12]).motion(NODES).toarray().reshape(6, -1, 6)
    assert np.count_nonzero(B[2, :, 2]) == 8
    np.testing.assert_allclose(B[2, 7, 2] / B[2, 12, 2], np.exp(-((25 / 9) ** 2)), rtol=1e-12)


def test_mean_of_nearest_nodes_is_smooth_in_the_position():
    z = np.sin(5 * NODES[:, 0]) * NODES[:, 1]
    u = np.zeros((len(NODES), 6))
    u[:, 2] = z

    def height(y):
        return (OnNearestNodes("p", np.array([0.5, y, 0.0])).motion(NODES) @ u.ravel())[2]

    fine = [height(y) for y in np.linspace(0.4, 0.6, 201)]
    assert np.abs(np.diff(fine)).max() < 0.02 * np.ptp(z)


def test_unit_loads_are_the_directions_asked_for_in_order():
    points = [OnNode("a", NODES[3], 3, directions=("z", "x")), OnNode("b", NODES[5], 5, directions=())]
    F = unit_loads(points, NODES)
    assert F.shape == (150, 2)
    assert F[20, 0] == F[18, 1] == 1
    assert np.count_nonzero(F) == 2


def test_no_points_make_no_loads():
    assert unit_loads([], NODES).shape == (150, 0)
