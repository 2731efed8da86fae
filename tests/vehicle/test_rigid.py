import numpy as np

from modeviz.vehicle.rigid import rigid_motions


def test_rigid_motion_is_translation_plus_rotation_cross_arm():
    u, theta, arm = np.array([1.0, 2, 3]), np.array([0.1, -0.2, 0.3]), np.array([0.7, -0.4, 0.5])
    np.testing.assert_allclose(
        rigid_motions(arm) @ np.r_[u, theta], np.r_[u + np.cross(theta, arm), theta], atol=1e-15
    )
