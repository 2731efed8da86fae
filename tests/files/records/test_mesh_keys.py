"""Where a display mesh is by the keys of its body: unit and axes of its own, or those of the file."""

from pathlib import Path

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle

HEAD = """name = "x"
{axes}
[units]
length = "m"
mass = "kg"
inertia = "kg m²"
[[rigid_body]]
name = "b"
mass = 1.0
center_of_gravity = [0, 0, 0]
inertia = [1, 1, 1]
mesh = "a.{kind}"
"""
OBJ = "v 0 0 0\nv 4 0 0\nv 0 2 0\nv 0 0 1\nf 1 2 3\nf 1 3 4\n"
DAE = """<COLLADA><asset><unit meter="0.5"/><up_axis>Y_UP</up_axis></asset><library_geometries>
<geometry id="g"><mesh><source id="s"><float_array id="a">0 0 0 4 0 0 0 2 0 0 0 1</float_array>
<technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles>
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes></COLLADA>"""


def vertices(folder: Path, keys: str = "", axes: str = "", kind: str = "obj") -> np.ndarray:
    """Of a mesh with an edge of 4 along its x, one of 2 along its y and one of 1 along its z."""
    (folder / "a.obj").write_text(OBJ)
    (folder / "a.dae").write_text(DAE)
    axes = f'axes = "{axes}"' if axes else ""
    (folder / "vehicle.toml").write_text(HEAD.format(axes=axes, kind=kind) + keys, encoding="utf-8")
    return read_vehicle(folder).body("b").mesh[0].vertices[1:]


def test_a_mesh_is_in_metres_and_in_the_axes_of_its_vehicles_file(tmp_path):
    np.testing.assert_allclose(vertices(tmp_path), np.diag([4.0, 2, 1]))
    np.testing.assert_allclose(
        vertices(tmp_path, axes="x forward, y left, z up"), np.diag([-4.0, -2, 1])
    )


def test_its_own_axes_count_whatever_those_of_the_file_are(tmp_path):
    keys = 'mesh_axes = "x right, y forward, z up"\nmesh_unit = "mm"\n'
    expected = 1e-3 * np.array([[0, 4.0, 0], [-2, 0, 0], [0, 0, 1]])
    for axes in ("", "x forward, y left, z up"):
        np.testing.assert_allclose(vertices(tmp_path, keys, axes), expected)


def test_a_mesh_that_says_unit_and_axes_is_upright_and_as_large_as_it_says(tmp_path):
    expected = 0.5 * np.array([[4.0, 0, 0], [0, 0, 2], [0, -1, 0]])
    np.testing.assert_allclose(vertices(tmp_path, kind="dae"), expected, atol=1e-12)
    np.testing.assert_allclose(
        vertices(tmp_path, 'mesh_unit = "cm"', kind="dae"), expected * 0.02, atol=1e-12
    )
    np.testing.assert_allclose(
        vertices(tmp_path, 'mesh_axes = "x left, y up, z forward"', kind="dae"),
        0.5 * np.array([[0, -4.0, 0], [0, 0, 2], [-1, 0, 0]]),
        atol=1e-12,
    )


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ('mesh_axes = "y up"', r"rigid_body\[0\].mesh_axes: found 'y up', expected such as"),
        ('mesh_axes = "x left, y forward, z up"', "left-handed"),
        ('mesh_unit = "inch"', r"mesh_unit: unknown unit of length 'inch': did you mean 'in'"),
    ],
)
def test_wrong_keys_of_a_mesh_are_explained(tmp_path, keys, words):
    with pytest.raises(VehicleError, match=words):
        vertices(tmp_path, keys)
