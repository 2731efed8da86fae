from dataclasses import replace

import numpy as np
import pytest
from small_vehicles import tyre, wheel
from viser.transforms import SO3

from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.server import open_server
from modeviz.viewer.scene.markers import (
    CARD_LETTERS,
    Markers,
    MountMarker,
    card_text,
    short_name,
)
from modeviz.viewer.scene.stage import LIGHT

BOUNDS = (MountRates(1.0, 1.0, 1.0), MountRates(1e6, 1e6, 1e6))
UNITS = WRITTEN_UNITS
RATES = MountRates(1.64e6, 1.21e6, 4.8e5)


def group(*names):
    mounts = tuple(Mount(name, "", ("cab", "frame"), np.zeros((2, 3))) for name in names)
    return MountGroup("C1", "cab front", MountRates(1e5, 1e5, 1e5), 0.1, BOUNDS, mounts)


def test_long_names_make_a_card_of_more_lines():
    text = card_text(group("C1"), RATES, UNITS, 0.1, f"yaw of the {'very ' * 12}long cab")
    assert max(map(len, text.splitlines())) <= CARD_LETTERS
    assert len(text.splitlines()) == 5


def test_card_names_the_group_its_sides_its_rates_and_its_share():
    text = card_text(group("C1 left", "C1 right"), RATES, UNITS, 0.234, "cab yaw")
    assert text == (
        "C1  cab front, left + right\n"
        "vertical 1640  lateral 1210  fore-aft 480 N/mm\n"
        "23 % of strain energy in cab yaw"
    )


def test_a_group_whose_label_is_its_name_is_named_once():
    """As an import names the groups of a table of mounts that has no labels."""
    same = replace(group("C1 left", "C1 right"), label="C1")
    assert card_text(same, RATES, UNITS, 0.1, "pitch").splitlines()[0] == "C1, left + right"
    assert (same.title, same.meaning) == ("C1", "")
    assert (group("C1").title, group("C1").meaning) == ("C1  cab front", "cab front")


def test_card_says_rates_in_the_unit_that_was_chosen():
    text = card_text(group("C1 left"), RATES, {**UNITS, "stiffness": "N/cm"}, 0.234, "cab yaw")
    assert text.splitlines()[1] == "vertical 16400  lateral 12100  fore-aft 4800 N/cm"


def test_lone_mount_has_no_side():
    assert card_text(group("C1"), RATES, UNITS, 0.0, "pitch").splitlines()[0] == "C1  cab front"


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


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


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


@pytest.mark.parametrize("length", [0.3, 60.0])
def test_marks_take_their_size_from_the_vehicle(server, length):
    """A marker of the largest share is at most a thirtieth of the vehicle across, and no dot either."""
    at = np.array([[0.1, -0.2, 0.3], [0.1, -0.2, 0.3]]) * length
    mount = Mount("C1 left", "C1", ("cab", "frame"), at)
    mounted = MountGroup("C1", "cab front", MountRates(1e5, 1e5, 1e5), 0.1, BOUNDS, (mount,))
    stand = (wheel("cab", 0.4), wheel("frame", 0.4))
    ground = replace(tyre(stand[1]), points=np.zeros((2, 3)))
    seat = ResponsePoint("seat", "cab", at[0])
    vehicle = Vehicle("v", stand, (ground,), (mounted,), response_points=(seat,))
    Markers(server.scene, vehicle, LIGHT, length, lambda _: None).show(
        "C1", {"C1": RATES}, UNITS, {"C1": 1.0}, "pitch", {}
    )
    nodes = server.scene._handle_from_node_name
    rubber, ring = nodes["/mounts/C1 left/rubber"], nodes["/mounts/C1 left/ring"]
    sizes = {
        "rubber": 2 * rubber.radius * rubber.scale,
        "washers": np.ptp([nodes[f"/mounts/C1 left/{s}"].position[2] for s in ("above", "below")]),
        "ring": np.ptp(ring.points[..., 0]),
        "patch": np.ptp(nodes[f"/patches/{ground.name}"].points[..., 0]),
        "seat": 2 * nodes["/points/seat"].radius,
    }
    for what, size in sizes.items():
        assert 0.01 < size / length < 0.06, what


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
