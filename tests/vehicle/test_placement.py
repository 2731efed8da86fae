"""Placed mounts: their springs' stiffness against rotations of scipy, their places in the mirror."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from scipy.spatial.transform import Rotation

from modeviz.dynamics.assembly import assemble
from modeviz.errors import VehicleError
from modeviz.vehicle.placement import Placement, placed_mounts, with_placements

ANGLES = (0.3, -0.5, 0.8)


def stiffness(mount):
    """The 3 × 3 stiffness of a mount along the vehicle's axes."""
    return mount.axes.T @ np.diag(mount.stiffness) @ mount.axes


def test_the_stiffness_of_turned_mounts_is_turned_and_mirrored_on_the_other_side():
    vehicle = mounted_cabin()
    turned = with_placements(vehicle, {"A": Placement(angles=ANGLES)})
    R, mirror = Rotation.from_euler("xyz", ANGLES).as_matrix(), np.diag([1, -1, 1])
    before, after = vehicle.mount_group("A").mounts, turned.mount_group("A").mounts
    sides = np.sign([mount.center[1] for mount in before])
    assert set(sides) == {-1, 1}
    for old, new, side in zip(before, after, sides, strict=True):
        turn = R if side == sides[0] else mirror @ R @ mirror
        np.testing.assert_allclose(stiffness(new), turn @ stiffness(old) @ turn.T, atol=1e-6)
    assert turned.mount_group("B") is vehicle.mount_group("B")
    assert "mounts 'A' are turned" in turned.notes[-1]


def test_turning_equal_springs_changes_nothing():
    vehicle = mounted_cabin()
    alike = vehicle.with_rates({g.name: replace(g.rates, lateral=1e5, fore_aft=1e5, vertical=1e5)
                                for g in vehicle.mount_groups})  # fmt: skip
    K = assemble(alike).stiffness
    turns = {"A": Placement(angles=ANGLES), "B": Placement(angles=(0, 0, 1))}
    turned = assemble(with_placements(alike, turns)).stiffness
    np.testing.assert_allclose(turned, K, atol=1e-12 * np.abs(K).max())


def test_no_placement_is_the_same_vehicle_and_an_unknown_group_is_refused():
    vehicle = mounted_cabin()
    assert with_placements(vehicle, {"A": Placement()}) is vehicle
    with pytest.raises(VehicleError, match="unknown mount group 'C'"):
        with_placements(vehicle, {"C": Placement(angles=ANGLES)})


def test_moved_mounts_take_both_ends_along_and_mirror_on_the_other_side():
    vehicle = mounted_cabin()
    moved = with_placements(vehicle, {"A": Placement((0.02, 0.03, -0.01), ANGLES)})
    before, after = vehicle.mount_group("A").mounts, moved.mount_group("A").mounts
    for old, new in zip(before, after, strict=True):
        inward = 0.03 * np.sign(before[0].center[1]) * np.sign(old.center[1])
        np.testing.assert_allclose(new.points - old.points, [[0.02, inward, -0.01]] * 2, atol=1e-15)
    assert "mounts 'A' are moved by 20, 30, -10 mm along x, y and z" in moved.notes[-2]
    assert "mounts 'A' are turned" in moved.notes[-1]


def test_a_mount_in_the_middle_is_placed_as_the_first():
    vehicle = mounted_cabin()
    group = vehicle.mount_group("A")
    middle = replace(group.mounts[1], points=group.mounts[1].points * [1, 0, 1])
    placed = placed_mounts(replace(group, mounts=(group.mounts[0], middle)), Placement((0, 0.1, 0)))
    np.testing.assert_allclose(placed[1].center - middle.center, [0, 0.1, 0], atol=1e-15)


@pytest.mark.parametrize("offset", [(0, 0), (0, float("nan"), 0)])
def test_a_placement_that_is_no_three_numbers_is_refused(offset):
    with pytest.raises(VehicleError, match=r"offset: found .*, expected three numbers"):
        Placement(offset)
