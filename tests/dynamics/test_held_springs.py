"""Mounts beside a rigid joint of the same two bodies."""

from dataclasses import replace

import numpy as np
from mounted_cabin import SOFT, STIFF, mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import MOTIONS, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates

PLACE = np.tile([1.0, 0.3, 1.4], (2, 1))


def test_a_mount_that_a_rigid_joint_holds_changes_nothing():
    cabin = mounted_cabin()
    box = RigidBody("box", "other", "box", 20.0, PLACE[0], 0.2 * np.eye(3))
    joint = Spring("joint", "joints", ("box", "cab"), PLACE, rigid=MOTIONS)
    joined = replace(cabin, bodies=(*cabin.bodies, box), connections=(*cabin.connections, joint))
    mount = Mount("held", "held", ("box", "cab"), PLACE)
    group = MountGroup("held", "held", MountRates(1e5, 2e5, 0.0), 0.1, (SOFT, STIFF), (mount,))
    beside = replace(joined, mount_groups=(*joined.mount_groups, group))
    without, with_it = (solve(prepare(v), {}, Conditions("flat", 20.0)) for v in (joined, beside))
    np.testing.assert_allclose(with_it.modes.frequency_hz, without.modes.frequency_hz, rtol=1e-9)
    np.testing.assert_allclose(
        with_it.psd, without.psd, rtol=1e-7, atol=1e-12 * np.abs(without.psd).max()
    )
