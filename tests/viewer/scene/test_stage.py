from dataclasses import replace

import numpy as np
import pytest
from small_vehicles import tyre, wheel

from modeviz.vehicle.bodies import Material, MeshPart, RigidBody
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.server import open_server
from modeviz.viewer.scene.cameras import Cameras
from modeviz.viewer.scene.stage import (
    CARD_FRACTION,
    CARD_HEIGHT,
    FIELD_OF_VIEW,
    FILLED,
    ISO,
    LIGHT,
    SMALLEST,
    VIEWS,
    Box,
    Stage,
    bodies_box,
    box,
    camera,
    framed_box,
    points_box,
)

TRUCK = Box((-1.05, -1.0, 0.0), (4.35, 1.0, 1.8))
CORNERS = np.array([[x, y, z] for x in (-1.05, 4.35) for y in (-1, 1) for z in (0, 1.8)])


SIZES = [(440, 360), (592, 720), (1060, 1080), (1600, 900)]


def on_picture(points, position, look_at, aspect):
    """Where a camera sees points, from -1 to 1 across and up its picture."""
    forward = (look_at - position) / np.linalg.norm(look_at - position)
    right = np.cross(forward, [0, 0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    seen = (points - position) @ np.stack([right, up, forward], axis=1)
    half = np.tan(FIELD_OF_VIEW / 2)
    return seen[:, :2] / seen[:, 2:] / [half * aspect, half]


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize(("width", "height"), SIZES)
def test_vehicle_fills_every_view_as_far_as_the_card_lets_it(view, width, height):
    seen = on_picture(CORNERS, *camera(TRUCK, view, width, height), width / height)
    lowest = FILLED * (2 * min(CARD_HEIGHT / height, CARD_FRACTION) - 1)
    assert np.abs(seen).max() <= FILLED + 1e-9
    assert seen[:, 1].min() >= lowest - 1e-9
    fills_width = np.ptp(seen[:, 0]) == pytest.approx(2 * FILLED)
    fills_height = np.ptp(seen[:, 1]) == pytest.approx(FILLED - lowest)
    assert fills_width or fills_height


def test_first_view_has_the_front_on_the_left_and_the_drivers_side_towards_us():
    position, look_at = camera(TRUCK, "Iso", 1000, 1000)
    front, rear, top, ground = on_picture(
        np.array([[-1.05, 0, 0.5], [4.35, 0, 0.5], [1.6, 0, 1.8], [1.6, 0, 0]]), position, look_at, 1.0
    )
    assert front[0] < rear[0]
    assert ground[1] < top[1]
    assert position[1] < TRUCK.low[1]


def test_box_holds_meshes_connections_and_the_ground():
    part = MeshPart(
        "p", np.array([[0, 0, 1.0], [5, 0, 1], [0, 2, 2]]), [[0, 1, 2]], Material((0, 0, 0))
    )
    body = RigidBody("body", "cabin", "body", 1.0, np.zeros(3), np.eye(3), (part,))
    axle = replace(wheel("axle", x=-1.0, y=-0.5), mesh=(part,))
    found = box(Vehicle("v", (body, axle), (tyre(axle),)))
    assert (found.low, found.high) == ((-1.0, -0.5, 0.0), (5.0, 2.0, 2.0))
    assert found.length == 6.0


def test_mere_blocks_leave_room_for_labels_and_meshes_fill_the_picture():
    body = RigidBody("body", "powertrain", "body", 150.0, np.array([1.0, 0, 1]), np.diag([9, 7, 8.0]))
    blocks = Vehicle("v", (body,), ())
    around = framed_box(blocks)
    np.testing.assert_allclose(
        np.subtract(around.high, around.low), 1.4 * np.ptp(box(blocks).corners, axis=0)
    )
    np.testing.assert_allclose(around.middle, box(blocks).middle)
    part = MeshPart("p", np.eye(3), [[0, 1, 2]], Material((0, 0, 0)))
    meshed = Vehicle("v", (replace(body, mesh=(part,)),), ())
    assert framed_box(meshed) == box(meshed)


def test_vehicle_without_meshes_or_connections_still_has_a_place():
    assert box(Vehicle("v", (wheel("axle"),), ())).length > 0


def test_what_has_no_size_is_seen_from_beside_it():
    position, look_at = camera(points_box([]), ISO, 800, 600)
    assert np.linalg.norm(position - look_at) == pytest.approx(SMALLEST)


def test_vertices_that_no_face_names_and_the_origin_do_not_frame_the_picture():
    corners = [[50, 0, 1.0], [55, 0, 1], [50, 2, 2], [9e4, 0, 0]]
    part = MeshPart("p", np.array(corners), [[0, 1, 2]], Material((0, 0, 0)))
    body = RigidBody("body", "cabin", "body", 1.0, np.zeros(3), np.eye(3), (part,))
    for found in (box(Vehicle("v", (body,), ())), bodies_box([body])):
        assert (found.low, found.high) == ((50.0, 0.0, 1.0), (55.0, 2.0, 2.0))


@pytest.mark.parametrize("length", [0.03, 5.4, 2000.0])
def test_ground_and_camera_go_with_the_size_of_the_vehicle(length):
    """Ground in cells of a tenth of the length, the vehicle far from the ends of what cameras see."""
    server = open_server(port=0)
    try:
        space = Box((0.0, 0.0, 0.0), (length, 0.4 * length, 0.3 * length))
        Stage(server.scene, space, LIGHT)
        Cameras(server, space)
        ground = server.scene._handle_from_node_name["/ground"]
        assert 0.06 < ground.cell_size / length < 0.15
        assert 2 < ground.width / length < 3
        camera = server.initial_camera
        distance = np.linalg.norm(np.subtract(camera.position, camera.look_at))
        assert camera.near < distance / 100
        assert camera.far > 10 * distance
    finally:
        server.stop()
