from types import SimpleNamespace

import numpy as np
import pytest
import viser
from cabin_session import SOON, open_session

from modeviz.units import factor
from modeviz.viewer.panels.excitation import ExcitationPanel, _speed_limits
from modeviz.viewer.session.commands.looks import Drive

KMH = factor("km/h", "speed")


def road(low_hz, high_hz, speed=20.0):
    return SimpleNamespace(frequency_hz=(low_hz, high_hz), speed=speed)


@pytest.mark.parametrize(
    ("roads", "speed", "limits"),
    [
        ([road(0.05, 60)], 20.0, (5, 200)),  # 20 m/s are 72 km/h
        ([road(0.1, 40)], 20.0, (5, 200)),
        ([road(1.0, 2.0)], 20.0, (8, 200)),  # 0.2 Hz, the band's second line, at 7.2 km/h
        ([road(30.0, 60.0)], 20.0, (5, 95)),  # 39.9 Hz at 95.8 km/h
        ([road(1.0, 2.0), road(30.0, 60.0)], 20.0, (8, 95)),
        ([road(0.01, 400)], 60.0, (5, 216)),
        ([road(0.01, 400)], 1.0, (4, 200)),
        ([], 20.0, (5, 200)),
    ],
)
def test_speeds_are_those_at_which_every_road_says_something_and_the_present_one(roads, speed, limits):
    vehicle = SimpleNamespace(roads=roads, frequency_hz=np.arange(1, 401) / 10)
    assert _speed_limits(vehicle, speed) == limits


def test_the_page_offers_the_classes_of_iso_8608_and_drives_over_them():
    server = viser.ViserServer(port=0, verbose=False)
    try:
        with open_session() as (session, _):
            ExcitationPanel(server.gui, session)
            handles = server.gui._gui_input_handle_from_uuid.values()
            road = next(handle for handle in handles if handle.label == "Road")
            assert road.options[-8:] == tuple(f"ISO {name}" for name in "ABCDEFGH")
            session.do(Drive(road="ISO C"))
            answer = session.wait_for_answer(SOON)
            assert answer.state.conditions.road == "ISO C"
    finally:
        server.stop()
