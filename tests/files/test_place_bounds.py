"""Bounds of where mounts may be in a problem's file: in any axes, and the lower ones first."""

import pytest
from numpy.testing import assert_allclose
from test_tuned_parts import FILE, GROUPS, folder

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle

PROBLEM = """
[[problem]]
name = "places"
goal = "change"

[[problem.group]]
group = "rubber"
"""


def bounds(path, axes, offset):
    file = FILE.replace('name = "cab"\n', f'name = "cab"\naxes = "{axes}"\n', 1)
    vehicle = read_vehicle(folder(path, f"{GROUPS}{PROBLEM}offset = {offset}\n", file))
    return vehicle.problems[0].groups[0].offsets


@pytest.mark.parametrize(
    ("axes", "expected"),
    [
        ("x rearward, y right, z up", {"x": (-0.02, 0.03), "z": (0.0, 0.05)}),
        ("x forward, y left, z up", {"x": (-0.03, 0.02), "z": (0.0, 0.05)}),
        ("x forward, y right, z down", {"x": (-0.03, 0.02), "z": (-0.05, 0.0)}),
        ("x right, y forward, z up", {"y": (-0.02, 0.03), "z": (0.0, 0.05)}),
    ],
)
def test_they_are_turned_with_the_axes_of_the_file(tmp_path, axes, expected):
    found = bounds(tmp_path / "v", axes, [[-0.02, 0, 0], [0.03, 0, 0.05]])
    assert found.keys() == expected.keys()
    for axis, pair in expected.items():
        assert_allclose(found[axis], pair, atol=1e-15)


@pytest.mark.parametrize("axes", ["x rearward, y right, z up", "x forward, y left, z up"])
def test_the_wrong_way_round_they_are_refused(tmp_path, axes):
    with pytest.raises(VehicleError, match=r"offset: x: found .* mm, expected two numbers, the lower"):
        bounds(tmp_path / "v", axes, [[0.03, 0, 0], [-0.02, 0, 0.05]])
