"""Local axes of angles in any order, against scipy's rotations."""

from itertools import permutations, product

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from modeviz.errors import VehicleError
from modeviz.vehicle.local_axes import TurnOrder, angles_of_axes, axes_of_angles

ANGLES = np.radians([20.0, -35.0, 50.0])


@pytest.mark.parametrize(
    ("letters", "is_fixed"), list(product(map("".join, permutations("xyz")), (True, False)))
)
def test_axes_of_angles_are_those_of_scipy(letters, is_fixed):
    """Scipy writes turns about fixed axes in small letters, about turned ones in large."""
    in_order = [ANGLES["xyz".index(letter)] for letter in letters]
    seq = letters if is_fixed else letters.upper()
    expected = Rotation.from_euler(seq, in_order).as_matrix().T
    assert axes_of_angles(ANGLES, TurnOrder(letters, is_fixed)) == pytest.approx(expected, abs=1e-14)


def test_turns_about_fixed_axes_are_those_about_turned_ones_in_reverse():
    fixed, turned = (TurnOrder.of(text) for text in ("x y z fixed", "z, y, x turned"))
    assert axes_of_angles(ANGLES, fixed) == pytest.approx(axes_of_angles(ANGLES, turned), abs=1e-14)


@pytest.mark.parametrize("degrees", [(20, -35, 50), (170, 80, -160), (0, 0, 0)])
def test_angles_of_axes_are_those_that_turned_them(degrees):
    angles = np.radians(degrees)
    found = angles_of_axes(axes_of_angles(angles, TurnOrder()))
    assert found == pytest.approx(angles, abs=1e-14)


@pytest.mark.parametrize("y", [90.0, -90.0])
def test_where_x_and_z_are_one_axis_their_angles_turn_alike(y):
    axes = axes_of_angles(np.radians([30, y, 50]), TurnOrder())
    found = angles_of_axes(axes)
    assert found[2] == 0
    assert axes_of_angles(found, TurnOrder()) == pytest.approx(axes, abs=1e-14)


@pytest.mark.parametrize("text", ["xxz fixed", "abc fixed", "xy turned", "", "123"])
def test_an_order_without_each_axis_is_refused(text):
    with pytest.raises(VehicleError, match="expected x, y and z in some order"):
        TurnOrder.of(text)


def test_an_order_says_about_which_axes():
    with pytest.raises(
        VehicleError, match='expected "xyz fixed", about axes that stay, or "xyz turned"'
    ):
        TurnOrder.of("x, y, z")
