from dataclasses import replace

import numpy as np
import pytest
from marked_group import BOUNDS
from small_vehicles import tyre, wheel

from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.server import open_server
from modeviz.viewer.scene.markers import Markers
from modeviz.viewer.scene.stage import LIGHT

UNITS = WRITTEN_UNITS
RATES = MountRates(1.64e6, 1.21e6, 4.8e5)


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


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
