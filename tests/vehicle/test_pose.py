"""A component moved into the vehicle: by axes and origin, or by points."""

import numpy as np
import pytest
from oracles import Beam
from scipy.spatial.transform import Rotation

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.pose import Pose
from modeviz.vehicle.vehicle import Vehicle

TURN = Rotation.from_rotvec([0.3, -1.1, 0.7]).as_matrix()
ORIGIN = np.array([1.5, -0.4, 0.8])
POINTS = np.array([[0, 0, 0], [1.2, 0.1, 0], [0.4, 0.9, -0.3], [0.2, 0.5, 0.6]])


@pytest.mark.parametrize("n", [3, 4])
def test_points_and_their_places_tell_the_pose(n):
    pose = Pose.from_points(POINTS[:n], POINTS[:n] @ TURN.T + ORIGIN)
    np.testing.assert_allclose(pose.rotation, TURN, atol=1e-12)
    np.testing.assert_allclose(pose.origin, ORIGIN, atol=1e-12)


def test_points_that_are_a_little_off_are_fitted():
    rng = np.random.default_rng(1)
    places = POINTS @ TURN.T + ORIGIN + 5e-4 * rng.standard_normal((4, 3))
    pose = Pose.from_points(POINTS, places)
    np.testing.assert_allclose(pose.places(POINTS), places, atol=2e-3)
    np.testing.assert_allclose(pose.rotation, TURN, atol=3e-3)
    assert pose.misfit == np.linalg.norm(pose.places(POINTS) - places, axis=1).max()
    assert 1e-4 < pose.misfit < 2e-3


@pytest.mark.parametrize("given", [2, 3])
def test_axes_and_an_origin_are_a_pose(given):
    axes = [length * TURN[:, i] for i, length in enumerate((2.0, 0.5, 7.0))]
    pose = Pose.from_axes(*axes[:given], origin=ORIGIN)
    np.testing.assert_allclose(pose.rotation, TURN, atol=1e-12)
    np.testing.assert_allclose(pose.places([0, 0, 0]), ORIGIN)
    np.testing.assert_allclose(pose.places([0, 0, 2.0]), ORIGIN + 2 * TURN[:, 2])


def held(body: FlexibleBody, turn) -> Vehicle:
    springs = tuple(
        Spring(
            f"s{i}",
            "s",
            ("beam", "ground"),
            np.tile(body.attachments[node].position, (2, 1)),
            stiffness=np.array([3e4, 1e4, 2e4]) * (1 + i),
            axes=turn.T,
        )
        for i, node in enumerate((0, 3, 8))
    )
    return Vehicle("v", (body,), springs)


def test_a_moved_body_on_moved_springs_has_the_frequencies_it_had():
    """Places, motions and rotations all turn: springs along the component's axes, at its nodes."""
    body = Beam(8).body("beam", n_modes=20)
    pose = Pose(TURN, ORIGIN)
    moved = pose.moved(body)
    before, after = held(body, np.eye(3)), held(moved, TURN)
    found, expected = (solve_modes(assemble(v)).frequency_hz for v in (after, before))
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-4)
    np.testing.assert_allclose(moved.center_of_gravity, pose.places(body.center_of_gravity), atol=1e-6)
    inertia, turned = (b.rigid_fit.mass_about_center_of_gravity[1] for b in (body, moved))
    np.testing.assert_allclose(turned, TURN @ inertia @ TURN.T, atol=1e-5 * inertia.max())
    np.testing.assert_allclose(moved.nodes, pose.places(body.nodes))
    lifted = np.einsum("ij,njm->nim", TURN, body.shapes[:, :3])
    np.testing.assert_allclose(moved.shapes[:, :3], lifted, atol=1e-5 * np.abs(lifted).max())


@pytest.mark.parametrize(
    ("points", "places", "words"),
    [
        (POINTS[:2], POINTS[:2], "found 2 points and 2 places"),
        (POINTS, POINTS[:3], "found 4 points and 3 places"),
        ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "points lie on a line"),
        (POINTS * 0, POINTS, "points lie on a line"),
        (POINTS, POINTS * 1000, "1000 times as far apart: are they in other units"),
        (POINTS, POINTS + np.diag([0.1, 0, 0, 0])[:, :3], "points 1 and 2 are 1.2.* m apart"),
        (POINTS, POINTS * [1, -1, 1], "is one side mirrored"),
        (POINTS * np.nan, POINTS, "no finite numbers"),
    ],
)
def test_points_that_tell_no_pose_are_refused(points, places, words):
    with pytest.raises(VehicleError, match=words):
        Pose.from_points(points, places)


@pytest.mark.parametrize(
    ("axes", "words"),
    [
        (([1, 0, 0], [0, 0, 0]), "without a direction"),
        (([1, 0, 0], [1, 0, 0]), "90° off right angles"),
        (([1, 0, 0], [0.1, 1, 0]), "5.71° off right angles"),
        (([1, 0, 0], [0, 1, 0], [0, 0, -1]), "left-handed"),
        (([np.inf, 0, 0], [0, 1, 0]), "without a direction"),
    ],
)
def test_axes_that_are_none_are_refused(axes, words):
    with pytest.raises(VehicleError, match=words):
        Pose.from_axes(*axes)


def test_a_rotation_is_one():
    with pytest.raises(VehicleError, match="left-handed"):
        Pose(np.diag([1, 1, -1.0]), ORIGIN)
    with pytest.raises(VehicleError, match="at right angles"):
        Pose(np.ones((3, 3)), ORIGIN)
