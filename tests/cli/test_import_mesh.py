"""An imported body looks like a mesh of its own, in its coordinates, and is put where the body is."""

import numpy as np
import pytest
from free_network import CORNERS
from network_files import network_unv

from modeviz.cli import main
from modeviz.files import read_vehicle
from modeviz.public import import_component

STL = "solid a\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid a\n"
DAE = """<COLLADA><asset><unit meter="0.5"/><up_axis>Y_UP</up_axis></asset><library_geometries>
<geometry id="g"><mesh><source id="s"><float_array id="a">{}</float_array>
<technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles>
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene><node><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes></COLLADA>"""
TRIANGLE = CORNERS[:3]
"""mm."""


@pytest.fixture
def files(tmp_path):
    (tmp_path / "a.unv").write_text(network_unv(np.geomspace(0.1, 10, 24)))
    text = "".join(f"vertex {x} {y} {z}\n" for x, y, z in TRIANGLE)
    (tmp_path / "a.stl").write_text(STL.format(text))
    return tmp_path


def run(files, *more) -> int:
    given = ["--output", str(files / "v"), "--units", "mm-t-s", "--mesh", str(files / "a.stl")]
    return main(["import", str(files / "a.unv"), *given, *more])


def drawn(files) -> np.ndarray:
    """The corners of the one triangle that is drawn, m, by x, y and z."""
    (part,) = read_vehicle(files / "v").bodies[0].mesh
    return part.vertices[np.lexsort(part.vertices.T[::-1])]


def ordered(points: np.ndarray) -> np.ndarray:
    return points[np.lexsort(points.T[::-1])]


@pytest.mark.parametrize(("unit", "length"), [((), 1e-3), (("--mesh-unit", "in"), 0.0254)])
def test_a_mesh_is_in_the_unit_of_the_files_unless_another_is_said(files, unit, length):
    assert run(files, *unit) == 0
    np.testing.assert_allclose(drawn(files), length * ordered(TRIANGLE), rtol=1e-6, atol=1e-9)


def test_a_mesh_that_says_its_axes_stays_in_the_coordinates_of_the_component(files):
    corners = " ".join(str(x) for x in TRIANGLE.ravel())
    (files / "a.dae").write_text(DAE.format(corners))
    assert run(files, "--mesh", str(files / "a.dae")) == 0
    np.testing.assert_allclose(drawn(files), 0.5 * ordered(TRIANGLE), rtol=1e-6, atol=1e-6)


def test_a_mesh_in_place_of_a_component_is_refused_with_the_way_to_use_it(files, capsys):
    assert main(["import", str(files / "a.stl"), "--output", str(files / "v")]) == 2
    assert "a.stl: is a mesh, which has no modes; give a component's files" in capsys.readouterr().err


def test_a_mesh_goes_with_its_body_where_that_is_put(files):
    assert run(files, "--pose", "x=0,1,0 y=-1,0,0 at 1000,0,0") == 0
    x, y, z = 1e-3 * TRIANGLE.T
    np.testing.assert_allclose(drawn(files), ordered(np.stack([1 - y, x, z], 1)), rtol=1e-6, atol=1e-7)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (["--mesh", "nowhere.stl"], "--mesh: nowhere.stl: there is no such file"),
        (["--mesh-unit", "furlong"], "--mesh-unit: unknown unit of length 'furlong'"),
    ],
)
def test_a_mesh_that_cannot_be_read_leaves_nothing_behind(files, capsys, more, words):
    assert run(files, *more) == 2
    assert words in capsys.readouterr().err
    assert not (files / "v").exists()


def test_a_unit_without_a_mesh_and_a_mesh_without_a_body_are_refused(files, capsys):
    unv = str(files / "a.unv")
    assert main(["import", unv, "--output", str(files / "v"), "--mesh-unit", "mm"]) == 2
    assert "--mesh-unit is of a mesh: give its file with --mesh" in capsys.readouterr().err
    assert main(["import", unv, "--mesh", "a.stl"]) == 2
    assert "--mesh is of a body that is written" in capsys.readouterr().err


def test_python_does_the_same(files):
    imported = import_component(files / "a.unv", units="mm-t-s", mesh=files / "a.stl", mesh_unit="cm")
    (part,) = imported.body.mesh
    np.testing.assert_allclose(ordered(part.vertices), 1e-2 * ordered(TRIANGLE), rtol=1e-6, atol=1e-9)
