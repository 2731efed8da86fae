"""Vehicles that stand the wrong way round are pointed out, and others are not."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from mounted_cabin import mounted_cabin
from turned_vehicles import text, turned, turned_folder

from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.orientation import orientation_doubts
from modeviz.vehicle.vehicle import Vehicle

OURS = np.eye(3)
CORNERS = ("front left", "front right", "rear left", "rear right")
SHORT = {"front left": "FL", "front right": "FR", "rear left": "RL", "rear right": "RR"}


def car(names: dict[str, str] | None = None, shift: float = 0.0) -> Vehicle:
    """A cabin on tyres that are called after their corners, moved by `shift` metres forward."""
    cabin = mounted_cabin()
    tyres = tuple(
        replace(
            tyre,
            name=(names or {}).get(corner, corner),
            points=tyre.points - [shift, 0, 0],
            wheel_center=tyre.wheel_center - [shift, 0, 0],
        )
        for tyre, corner in zip(cabin.tyres, CORNERS, strict=True)
    )
    return replace(cabin, connections=tyres, wheel_loads=(), rate_sets={})


@pytest.mark.parametrize("names", [{}, SHORT], ids=["words", "letters"])
@pytest.mark.parametrize(
    "words",
    [("forward", "left", "up"), ("forward", "right", "down"), ("rearward", "left", "down")],
    ids=text,
)
def test_a_car_in_other_axes_is_told_which_it_seems_to_have(tmp_path, names, words):
    write_vehicle(turned(car(names, shift=1.2), words), tmp_path / "a")
    (note,) = read_vehicle(tmp_path / "a").notes
    assert f'say axes = "{text(words)}" if that is how the file has them' in note
    assert 'axes taken as "x rearward, y right, z up"' in note


@pytest.mark.parametrize(
    "words", [("rearward", "right", "up"), ("forward", "left", "up"), ("left", "rearward", "up")]
)
def test_a_car_in_the_axes_it_says_raises_no_doubt(tmp_path, words):
    assert read_vehicle(turned_folder(tmp_path / "a", car(shift=1.2), words)).notes == ()


def test_the_axes_that_are_advised_leave_no_doubt(tmp_path):
    """Also where the file says the wrong ones."""
    write_vehicle(turned(car(), ("left", "rearward", "up")), tmp_path / "a")
    file = tmp_path / "a" / "vehicle.toml"
    plain = file.read_text("utf-8")
    file.write_text('axes = "x right, y forward, z up"\n' + plain, "utf-8")
    (note,) = read_vehicle(tmp_path / "a").notes
    assert 'say axes = "x left, y rearward, z up"' in note


def test_a_car_without_names_is_known_by_the_axle_at_its_origin():
    nameless = {corner: f"tyre {i}" for i, corner in enumerate(CORNERS)}
    (note,) = orientation_doubts(turned(car(nameless), ("forward", "left", "up")), OURS)
    assert note.startswith("the axle at the origin is the last")
    assert 'say axes = "x forward, y left, z up"' in note
    assert orientation_doubts(car(nameless), OURS) == ()
    assert orientation_doubts(car(nameless, shift=1.2), OURS) == ()


def test_names_that_are_exchanged_get_no_advice():
    exchanged = dict(
        zip(CORNERS, ("front right", "front left", "rear right", "rear left"), strict=True)
    )
    (note,) = orientation_doubts(car(exchanged), OURS)
    assert note.startswith("'front left' is to the right of 'front right'")
    assert "say axes" not in note


def test_the_built_in_truck_stands_the_right_way_round():
    assert orientation_doubts(builtin_truck(), OURS) == ()


def test_the_two_that_are_named_stand_to_each_other_as_it_is_said():
    """Here FL is to the left of FR, and RL so far out that lefts are to the right of rights."""
    *others, rear_left, rear_right = car(SHORT).tyres
    out = np.array([0, 4.0, 0])
    moved = replace(rear_left, points=rear_left.points + out, wheel_center=rear_left.wheel_center + out)
    vehicle = replace(car(SHORT), connections=(*others, moved, rear_right))
    (doubt,) = orientation_doubts(vehicle, OURS)
    assert doubt.startswith("'RL' is to the right of 'FR'")
