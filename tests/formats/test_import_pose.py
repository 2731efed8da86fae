"""Where an imported component stands in the vehicle, on the command line and in Python."""

import numpy as np
import pytest
from free_network import CORNERS, LABELS
from network_files import network_unv

import modeviz as mv
from modeviz.cli import main
from modeviz.files import read_vehicle

TURN = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
"""x of the component points along y of the vehicle, y against x."""
AT = np.array([500.0, -200, 300])


@pytest.fixture
def path(tmp_path):
    (tmp_path / "block.unv").write_text(network_unv())
    return tmp_path / "block.unv"


def place(label):
    """Where a mass is in the vehicle, mm."""
    return TURN @ CORNERS[np.flatnonzero(label == LABELS)[0]] + AT


def points(*labels):
    return "; ".join(f"{label}={','.join(f'{v:g}' for v in place(label))}" for label in labels)


POSES = [
    "x=0,1,0 y=-1,0,0 at 500,-200,300",
    "x=0,2,0, y=-3,0,0, z=0,0,1 at 500, -200, 300",
    "x right, y forward, z up at 500,-200,300",
    points(11, 12, 13),
    points(24, 22, 11, 13),
    "0,0,0=500,-200,300; 1000,0,0=500,800,300; 0,700,0=-200,-200,300",
]


@pytest.mark.parametrize("pose", POSES)
def test_a_component_is_put_where_its_pose_says(path, tmp_path, pose, capsys):
    folder = tmp_path / "vehicle"
    options = ["--units", "mm-t-s", "--attach", "a=24", "--pose", pose]
    assert main(["import", str(path), "--output", str(folder), *options]) == 0
    (body,) = read_vehicle(folder).bodies
    np.testing.assert_allclose(body.attachments[0].position, place(24) / 1000, atol=1e-9)
    corners = {tuple(v) for v in (CORNERS @ TURN.T + AT).round(6)}
    assert {tuple(v) for v in (1000 * body.nodes).round(6)} == corners
    assert {tuple(v) for v in (1000 * body.mesh[0].vertices).round(1)} == corners
    x, y, z = place(24) / 1000
    assert f"attachment 'a' at [{x:.4g}, {y:.4g}, {z:.4g}] m" in capsys.readouterr().out


def test_points_that_do_not_quite_fit_are_told(path, tmp_path, capsys):
    pose = "11=0,0,0; 12=1001,0,0; 13=0,700,0"
    options = ["--units", "mm-t-s", "--pose", pose]
    assert main(["import", str(path), "--output", str(tmp_path / "vehicle"), *options]) == 0
    assert "the points of the pose are up to 0.6" in capsys.readouterr().err


def test_words_for_axes_go_by_those_of_the_vehicle(path, tmp_path):
    folder = tmp_path / "vehicle"
    folder.mkdir()
    (folder / "vehicle.toml").write_text('name = "v"\naxes = "x forward, y left, z up"\n')
    options = ["--units", "mm-t-s", "--attach", "a=24", "--pose", "x rearward, y right, z up"]
    assert main(["import", str(path), "--output", str(folder), *options]) == 0
    (body,) = read_vehicle(folder).bodies  # in our axes, which are those of the component
    np.testing.assert_allclose(body.attachments[0].position, CORNERS[-1] / 1000, atol=1e-9)


def test_a_pose_of_python_is_that_of_the_command(path, tmp_path):
    pose = mv.Pose.from_axes([0, 1, 0], [-1, 0, 0], origin=AT / 1000)
    imported = mv.import_component(path, units="mm-t-s", attach=["a=24"], pose=pose)
    assert imported.vehicle is None
    assert imported.body.name == "block"
    np.testing.assert_allclose(imported.body.attachments[0].position, place(24) / 1000)
    folder = tmp_path / "vehicle"
    written = mv.import_component(
        path, output=folder, name="cab", units="mm-t-s", attach=["a=24"], pose=POSES[0]
    )
    (body,) = read_vehicle(folder).bodies
    assert written.vehicle.bodies[0].name == body.name == "cab"
    np.testing.assert_allclose(body.attachments[0].shapes, imported.body.attachments[0].shapes)


@pytest.mark.parametrize(
    ("pose", "words"),
    [
        ("", "found ''"),
        ("x forward", "expected such as 'x forward, y left, z up'"),
        ("x forward, y right, z up", "left-handed"),
        ("x=1,0,0", "found 'x=1,0,0', expected where its axes point"),
        ("x=1,0,0 y=0,1", "expected where its axes point"),
        ("x=1,0,0 y=0,1,0 z=0,0,-1", "left-handed ones"),
        ("x=1,0,0 y=0,1,0 at 1,2", "expected where its axes point"),
        ("11=0,0,0; 12=1000,0,0", "found 2 points and 2 places"),
        ("11=0,0,0; 12=1000,0,0; 99=0,1,0", "there is no node 99 with a place"),
        ("11=0,0,0; 12=1,0,0; 13=0,0.7,0", "0.001 times as far apart: are they in other units?"),
        ("11=0,0,0; 12=1000,0,0; 500,0,0=500,0,0", "lie on a line"),
        ("11=0,0,0; 12=1000,0,0; 13", "expected where its axes point"),
        ("11=0,0,0; 12=1000,0,nan; 13=0,700,0", "expected where its axes point"),
    ],
)
def test_wrong_poses_are_refused(path, tmp_path, capsys, pose, words):
    folder = tmp_path / "vehicle"
    common = ["--output", str(folder), "--units", "mm-t-s"]
    assert main(["import", str(path), *common, "--pose", pose]) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert words in line
    assert "--pose: " in line
    assert not folder.exists()


def test_a_pose_of_what_is_not_written_is_refused(path, capsys):
    assert main(["import", str(path), "--pose", POSES[0]]) == 2
    assert "--pose is of a body that is written" in capsys.readouterr().err
