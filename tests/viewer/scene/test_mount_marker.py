import numpy as np
import pytest
from marked_group import group
from viser.transforms import SO3

from modeviz.vehicle.connections import Mount
from modeviz.viewer.page.server import open_server
from modeviz.viewer.scene.mount_marker import MountMarker, short_name


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


@pytest.mark.parametrize(
    ("names", "labels"),
    [
        (["C1 left", "C1 right"], ["C1 L", "C1 R"]),
        (["C1 left", "C1 lower"], ["C1 left", "C1 lower"]),
        (["front left", "front right"], ["C1 front left", "C1 front right"]),
        (["gearbox mount"], ["C1"]),
        (["C1", "C1 other"], ["C1", "C1 O"]),
    ],
)
def test_labels_tell_mounts_apart_by_an_initial_only_if_that_does(names, labels):
    shown = group(*names)
    assert [short_name(mount, shown) for mount in shown.mounts] == labels


def test_a_mark_is_sent_again_only_when_an_eye_would_see_it(server):
    c1 = group("C1 left")
    marker = MountMarker(server.scene, c1.mounts[0], c1, 5.4)

    def is_sent(share, selected=False):
        before = server._websock_server._broadcast_buffer.message_counter
        marker.show(share, selected, False)
        return server._websock_server._broadcast_buffer.message_counter > before

    assert is_sent(0.50)
    assert not is_sent(0.51)
    assert is_sent(0.90)
    assert is_sent(0.90, selected=True)


def test_a_mount_is_marked_where_it_acts(server):
    ends = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.6]])
    mount = Mount("C1 left", "", ("cab", "frame"), ends, elastic_center=0.25)
    marker = MountMarker(server.scene, mount, group("C1 left"), 5.4)
    assert marker._frame.position == pytest.approx((0.0, 0.0, 0.9))


def test_a_selected_mount_shows_its_own_axes(server):
    axes = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0.0]])
    mount = Mount("C1 left", "", ("cab", "frame"), np.zeros((2, 3)), axes=axes)
    marker = MountMarker(server.scene, mount, group("C1 left"), 5.4)
    marker.show(0.5, selected=True, carded=True)
    assert marker._frame.show_axes
    assert SO3(np.array(marker._frame.wxyz)).as_matrix() == pytest.approx(axes.T)
    marker.show(0.5, selected=False, carded=False)
    assert not marker._frame.show_axes


def damped_mount(stiffness, damping):
    """A mount with dampers along its axes."""
    at = np.zeros((2, 3))
    return Mount("C1 right", "", ("cab", "frame"), at, stiffness=stiffness, damping=damping)


def test_a_spring_with_a_damper_is_drawn_as_a_strut(server):
    c1 = group("C1 left")
    rubber = MountMarker(server.scene, c1.mounts[0], c1, 5.4)
    damped = damped_mount(np.full(3, 1e5), np.array([0, 0, 900.0]))
    strut = MountMarker(server.scene, damped, c1, 5.4)
    for marker in (rubber, strut):
        marker.show(1.0, selected=False, carded=False)
    middle, *washers = strut._pieces
    assert middle.height > 1.5 * rubber._pieces[0].height
    assert middle.radius < rubber._pieces[0].radius
    ends = 0.5 * middle.height * middle.scale
    assert [w.position[2] for w in washers] == pytest.approx([1.06 * ends, -1.06 * ends])


@pytest.mark.parametrize("axis", range(3))
def test_what_only_damps_is_drawn_as_a_tube_and_a_rod_along_the_axis_that_it_damps(server, axis):
    damping = np.full(3, 10.0)
    damping[axis] = 900.0
    marker = MountMarker(server.scene, damped_mount(np.zeros(3), damping), group("C1 left"), 5.4)
    marker.show(1.0, selected=False, carded=False)
    tube, rod, *eyes = marker._pieces
    assert rod.radius < 0.5 * tube.radius
    along = np.array([piece.position for piece in (eyes[1], tube, rod, eyes[0])])
    assert (np.diff(along[:, axis]) > 0).all()
    assert np.delete(along, axis, axis=1) == pytest.approx(0.0, abs=1e-12)
    assert SO3(np.array(tube.wxyz)).apply(np.array([0, 0, 1.0])) == pytest.approx(np.eye(3)[axis])
