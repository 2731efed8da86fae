import numpy as np
import pytest

from modeviz.vehicle.connections import Mount, MountGroup, MountRates
from modeviz.viewer.doors import open_server
from modeviz.viewer.markers import MountMarker, card_text

BOUNDS = (MountRates(1.0, 1.0, 1.0), MountRates(1e6, 1e6, 1e6))
RATES = MountRates(1.64e6, 1.21e6, 4.8e5)


def group(*names):
    mounts = tuple(Mount(name, "", ("cab", "frame"), np.zeros((2, 3))) for name in names)
    return MountGroup("C1", "cab front", MountRates(1e5, 1e5, 1e5), 0.1, BOUNDS, mounts)


def test_card_names_the_group_its_sides_its_rates_and_its_share():
    text = card_text(group("C1 left", "C1 right"), RATES, "N/mm", 0.234, "cab yaw")
    assert text == (
        "C1  cab front, left + right\n"
        "vertical 1640  lateral 1210  fore-aft 480 N/mm\n"
        "23 % of strain energy in cab yaw"
    )


def test_card_says_rates_in_the_unit_that_was_chosen():
    text = card_text(group("C1 left"), RATES, "N/cm", 0.234, "cab yaw")
    assert text.splitlines()[1] == "vertical 16400  lateral 12100  fore-aft 4800 N/cm"


def test_lone_mount_has_no_side():
    assert card_text(group("C1"), RATES, "N/mm", 0.0, "pitch").splitlines()[0] == "C1  cab front"


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


def test_a_mark_is_sent_again_only_when_an_eye_would_see_it(server):
    c1 = group("C1 left")
    marker = MountMarker(server.scene, c1.mounts[0], c1)

    def is_sent(share, selected=False):
        before = server._websock_server._broadcast_buffer.message_counter
        marker.show(share, selected, False)
        return server._websock_server._broadcast_buffer.message_counter > before

    assert is_sent(0.50)
    assert not is_sent(0.51)
    assert is_sent(0.90)
    assert is_sent(0.90, selected=True)
