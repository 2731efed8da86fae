"""Turned mounts: their springs' stiffness against rotations of scipy."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from scipy.spatial.transform import Rotation

from modeviz.dynamics.assembly import assemble
from modeviz.errors import VehicleError
from modeviz.vehicle.turned_mounts import with_turned_mounts

ANGLES = (0.3, -0.5, 0.8)


def stiffness(mount):
    """The 3 × 3 stiffness of a mount along the vehicle's axes."""
    return mount.axes.T @ np.diag(mount.stiffness) @ mount.axes


def test_the_stiffness_of_turned_mounts_is_turned_and_mirrored_on_the_other_side():
    vehicle = mounted_cabin()
    turned = with_turned_mounts(vehicle, {"A": ANGLES})
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
    turned = assemble(with_turned_mounts(alike, {"A": ANGLES, "B": (0, 0, 1)})).stiffness
    np.testing.assert_allclose(turned, K, atol=1e-12 * np.abs(K).max())


def test_no_turn_is_the_same_vehicle_and_an_unknown_group_is_refused():
    vehicle = mounted_cabin()
    assert with_turned_mounts(vehicle, {"A": (0.0, 0.0, 0.0)}) is vehicle
    with pytest.raises(VehicleError, match="unknown mount group 'C'"):
        with_turned_mounts(vehicle, {"C": ANGLES})
