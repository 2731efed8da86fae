"""An imported body looks like a mesh of its own, in its coordinates, and is put where the body is."""

import numpy as np
import pytest
from free_network import CORNERS
from network_files import network_unv

from modeviz.cli import main
from modeviz.files import read_vehicle
from modeviz.public import import_component

STL = "solid a\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid a\n"
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
