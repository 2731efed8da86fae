"""How mounts are turned in vehicle.toml: three axes, two vectors, or angles in a stated order."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle

VEHICLE = """name = "block"
axes = "{axes}"
[units]
length = "m"
mass = "kg"
inertia = "kg m²"
stiffness = "N/m"
angle = "deg"
[[rigid_body]]
name = "block"
mass = 100
center_of_gravity = [0, 0, 0]
inertia = [5, 6, 7]
[[spring]]
name = "s"
bodies = ["block", "ground"]
at = [0.1, 0.2, 0.3]
stiffness = [1000, 2000, 3000]
{how}
"""
OURS, THEIRS = "x rearward, y right, z up", "x up, y forward, z left"
T = {OURS: np.eye(3), THEIRS: np.array([[0, -1, 0], [0, 0, -1], [1, 0, 0.0]])}
"""What turns these axes into ours."""


def stiffness(tmp_path, how, axes=OURS):
    """The stiffness (3, 3) of the spring in our axes."""
    (tmp_path / "vehicle.toml").write_text(VEHICLE.format(axes=axes, how=how))
    (spring,) = read_vehicle(tmp_path).connections
    return spring.axes.T * spring.stiffness @ spring.axes


def turned(rotation, axes):
    R = T[axes] @ rotation.as_matrix()
    return R @ np.diag([1000, 2000, 3000]) @ R.T


@pytest.mark.parametrize("axes", [OURS, THEIRS])
@pytest.mark.parametrize(("order", "seq"), [("xyz fixed", "xyz"), ("z, x, y turned", "ZXY")])
def test_angles_turn_in_their_order_and_in_the_axes_of_the_file(tmp_path, axes, order, seq):
    angles = {"x": 10, "y": -20, "z": 70}
    how = f'angles = [10, -20, 70]\nangle_order = "{order}"'
    rotation = Rotation.from_euler(seq, [angles[a] for a in seq.lower()], degrees=True)
    np.testing.assert_allclose(stiffness(tmp_path, how, axes), turned(rotation, axes), atol=1e-9)


@pytest.mark.parametrize("axes", [OURS, THEIRS])
def test_two_vectors_are_the_local_x_and_y(tmp_path, axes):
    rotation = Rotation.from_euler("xyz", [10, -20, 70], degrees=True)
    x, y, z = rotation.as_matrix().T
    two = f"axes = [{(3 * x).tolist()}, {(0.2 * y).tolist()}]"
    three = f"axes = {[x.tolist(), y.tolist(), z.tolist()]}"
    for how in (two, three):
        np.testing.assert_allclose(stiffness(tmp_path, how, axes), turned(rotation, axes), atol=1e-9)


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("angles = [1, 2, 0]", r"spring\[0\]\.angle_order: missing, expected the order of the angles"),
        (
            'angles = [1, 2, 0]\nangle_order = "xyy fixed"',
            r"spring\[0\]\.angle_order: found 'xyy fixed'",
        ),
        ('angles = [1, 2, 0]\nangle_order = "xyz"', r"spring\[0\]\.angle_order: .*xyz turned"),
        ('angles = ["a", 2, 0]', r"spring\[0\]\.angles\[0\]: found 'a', expected a number"),
        (
            "angles = [1, 0, 0]\naxes = [[0, 1, 0], [0, 0, 1]]",
            r"spring\[0\]\.angles: found beside axes",
        ),
        ("axes = [[1, 0, 0], [1, 0, 0]]", r"spring\[0\]\.axes: the local x and y axes are 0° apart"),
        ("axes = [[1, 0, 0]]", r"spring\[0\]\.axes: .*length at least 2"),
    ],
)
def test_what_is_no_orientation_is_refused(tmp_path, how, words):
    with pytest.raises(VehicleError, match=words):
        stiffness(tmp_path, how)


def test_angles_need_their_unit(tmp_path):
    text = VEHICLE.replace('angle = "deg"\n', "").format(axes=OURS, how="angles = [1, 0, 0]")
    (tmp_path / "vehicle.toml").write_text(text)
    with pytest.raises(VehicleError, match=r"units\.angle: missing, expected one of deg, rad"):
        read_vehicle(tmp_path)
