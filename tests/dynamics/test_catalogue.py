"""The named motions of made-up shares, by hand."""

import numpy as np
import pytest
from cars import rigid

from modeviz.dynamics.catalogue import Shares, named_motions
from modeviz.dynamics.roles import Axle, Unit


def shares(**given) -> Shares:
    """Of one mode that has nothing but what is given."""
    values = {
        "axles": (), "units": (), "whole": np.zeros((6, 1)), "ends": np.zeros((0, 1)),
        "wheels": np.zeros((0, 2, 1)), "bending": np.zeros((0, 1)), "rigid": np.zeros((0, 6, 1)),
        "energy": np.zeros((0, 1)),
    }  # fmt: skip
    return Shares(**values | given)


def scores(**given):
    return {name: score[0] for name, score in named_motions(shares(**given)).items()}


CAB, ENGINE = (
    Unit(name, (rigid(name, role, 1, (0, 0, 0), (1, 1, 1)),))
    for name, role in (("cab", "cabin"), ("engine", "powertrain"))
)
FRONT, REAR = Axle("front", 0.0, CAB.bodies), Axle("rear", 3.0, CAB.bodies)


def test_a_vehicle_without_parts_has_no_named_motions():
    assert scores() == {}


def test_bounce_belongs_to_the_end_that_moves():
    heave = np.array([0, 0, 0.6, 0, 0.3, 0])[:, None]
    found = scores(
        axles=(FRONT, REAR),
        wheels=np.zeros((2, 2, 1)),
        whole=heave,
        ends=np.array([[-3.0], [1.0]]),
    )
    assert found["front bounce"] == pytest.approx(0.9 * 9 / 10)
    assert found["rear bounce"] == pytest.approx(0.9 * 1 / 10)


@pytest.mark.parametrize(("ride", "hop", "yaw"), [(0.6, 0.2, 0.1), (0.8, 0.0, 0.0)])
def test_a_ride_mode_is_called_by_ride_motions_only(ride, hop, yaw):
    whole = np.array([0, ride, 0, 0, 0, 0])[:, None]
    found = scores(
        axles=(FRONT, REAR),
        units=(CAB,),
        whole=whole,
        ends=np.ones((2, 1)),
        wheels=np.array([[[0.2], [0.0]], [[0.0], [0.0]]]),
        rigid=np.array([0, 0, 0, 0, 0, 0.1])[None, :, None],
    )
    assert (found["front hop"], found["cab yaw"]) == (hop, yaw)
    assert found["roll"] == (ride if ride > 0.7 else 0.0)


def test_engine_pitch_and_cab_bounce_is_full_where_both_have_half():
    rows = np.array([[0, 0, 0.1, 0, 0.4, 0], [0, 0, 0.1, 0, 0.45, 0]])[:, :, None]
    for part, expected in ((1.0, 1.0), (0.5, 0.5)):
        found = scores(units=(CAB, ENGINE), rigid=part * rows)
        assert found["engine pitch and cab bounce"] == pytest.approx(expected)
    assert "engine pitch and cab bounce" not in scores(units=(CAB,), rigid=rows[:1])


def test_a_single_unit_is_called_after_its_six_motions():
    rows = np.eye(6)[:, :, None][:1]
    words = ("fore-aft", "lateral", "bounce", "roll", "pitch", "yaw")
    assert list(scores(units=(ENGINE,), rigid=rows)) == [f"engine {word}" for word in words]
