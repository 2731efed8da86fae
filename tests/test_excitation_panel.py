from types import SimpleNamespace

import pytest

from modeviz.units import factor
from modeviz.viewer.panels.excitation import _speed_limits

KMH = factor("km/h", "speed")


def road(low_hz, high_hz, speed=20.0):
    return SimpleNamespace(frequency_hz=(low_hz, high_hz), speed=speed)


@pytest.mark.parametrize(
    ("roads", "speed", "limits"),
    [
        ([road(0.05, 60)], 20.0, (48, 144)),  # 20 m/s are 72 km/h
        ([road(0.1, 40)], 20.0, (72, 73)),
        ([road(0.1, 80), road(0.05, 40)], 20.0, (72, 73)),
        ([road(0.1, 80, 10.0), road(0.05, 40)], 20.0, (72, 73)),
        ([road(0.01, 400)], 50.0, (20, 180)),
    ],
)
def test_speeds_are_those_of_every_road_and_the_present_one(roads, speed, limits):
    assert _speed_limits(roads, speed) == limits
