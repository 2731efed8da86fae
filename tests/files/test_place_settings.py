"""Places of mounts as they are written on a command line."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files.place_settings import parse_placements
from modeviz.vehicle.placement import Placement


def test_lengths_move_and_angles_turn():
    found = parse_placements(["C1=20, 0,-10 mm", "C2 = 1,2,3 in", "C1=0,-5,0 deg", "E=0.1,0,1e-2 rad"])
    assert found == {
        "C1": Placement((0.02, 0, -0.01), (0, np.radians(-5), 0)),
        "C2": Placement(tuple(0.0254 * np.array([1, 2, 3]))),
        "E": Placement(angles=(0.1, 0, 0.01)),
    }


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("C1", "expected GROUP=X,Y,Z UNIT"),
        ("C1=1,2 mm", "expected GROUP=X,Y,Z UNIT"),
        ("C1=1,2,3", "expected GROUP=X,Y,Z UNIT"),
        ("C1=1,2,3,4 mm", "expected GROUP=X,Y,Z UNIT"),
        ("C1=1,2,3 kg", "found the unit 'kg', expected one of"),
        ("C1=1,x,3 mm", "'x mm'"),
        ("C1=1,nan,3 mm", "nan"),
    ],
)
def test_what_is_no_place_is_refused(text, words):
    with pytest.raises(VehicleError, match=words):
        parse_placements([text])


@pytest.mark.parametrize(
    ("second", "words"),
    [("C1=5,0,0 cm", "place 'C1=5,0,0 cm': 'C1' is moved twice"), ("C1 = 0,0,1 deg", None)],
)
def test_a_group_is_moved_once_and_turned_once(second, words):
    texts = ["C1=20,0,-10 mm", second]
    if words is None:
        assert parse_placements(texts)["C1"].offset[0] == pytest.approx(0.02)
        return
    with pytest.raises(VehicleError, match=words):
        parse_placements(texts)
