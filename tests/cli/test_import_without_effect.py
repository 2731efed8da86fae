"""What is asked of files on which it would have no effect is refused, by the command and in Python."""

import numpy as np
import pytest
from crg_files import crg
from network_files import network_op2, network_unv
from op2_files import Op2

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.formats.imported import import_component

SPRINGS = """BEGIN BULK
GRID,1,,0.,0.,0.
GRID,2,,100.,0.,0.
PBUSH,7,K,10.,20.,30.
CBUSH,1,7,1,2,,,,0
ENDDATA
"""

PROPERTY = """[UNITS]
LENGTH = 'mm'
FORCE = 'newton'
ANGLE = 'deg'
MASS = 'kg'
TIME = 'sec'
[DIRECTIONS]
(ACTIVITY)
{ formulation FX FY FZ TX TY TZ }
'CONSTANT_STIFFNESS' 1 0 0 0 0 0
[CONSTANT_STIFFNESS_FX]
K = 6.0
"""

FILES = {
    "run.op2": network_op2(Op2()),
    "run.unv": network_unv().encode(),
    "road.crg": crg(np.random.default_rng(3).uniform(-0.2, 0.2, (300, 3)), 0.1, [-1, 0, 1]),
    "springs.bdf": SPRINGS.encode(),
    "rates.gbs": PROPERTY.encode(),
    "mounts.csv": b"name,body 1,body 2,x [mm],y [mm],z [mm],kz [N/mm]\none,block,ground,0,0,0,5\n",
}

NOT_OF_A_ROAD = "has no effect on a road; leave it out"
NOT_OF_MOUNTS = "has no effect on mounts; leave it out"
NOT_OF_A_TABLE = "has no effect on a table of mounts; leave it out"
NOT_OF_A_BODY = "has no effect on a body; leave it out"
NO_MATRICES = "is of mass and stiffness matrices, of which modes are computed, and"
UNWRITTEN = "written; say where with --output"

WITHOUT_EFFECT = [
    (
        "run.op2",
        "--output vehicle --units mm-t-s --modes 20",
        f"--modes: {NO_MATRICES} run.op2 has none",
    ),
    (
        "run.unv",
        "--output vehicle --units mm-t-s --up-to 90",
        f"--up-to: {NO_MATRICES} run.unv has none",
    ),
    ("run.op2", "--output vehicle --units mm-t-s --up-to 90 --condense guyan", NO_MATRICES),
    ("run.op2", "--modes 20", NO_MATRICES),
    ("run.unv", "--up-to 90", NO_MATRICES),
    ("run.op2", "--output vehicle --units mm-t-s --plane x=0", "--plane is of two halves"),
    ("run.op2", "--output vehicle --units mm-t-s --mesh-unit mm", "--mesh-unit is of a mesh"),
    ("run.op2", "--output vehicle --frequency 0", f"--frequency: {NOT_OF_A_BODY}"),
    ("run.op2", "--output vehicle --bodies a b", f"--bodies: {NOT_OF_A_BODY}"),
    ("run.op2", "--track-width 1.5", f"--track-width: {NOT_OF_A_BODY}"),
    ("run.op2", "--name block", f"--name is of a body that is {UNWRITTEN}"),
    ("springs.bdf", "--frequency 20", f"--frequency is of springs that are {UNWRITTEN}"),
    ("springs.bdf", "--bodies a b", f"--bodies is of springs that are {UNWRITTEN}"),
    ("springs.bdf", "--output there --units mm-t-s --name a", f"--name: {NOT_OF_MOUNTS}"),
    ("springs.bdf", "--output there --units mm-t-s --attach 1", f"--attach: {NOT_OF_MOUNTS}"),
    ("springs.bdf", "--output there --units mm-t-s --modes 0", f"--modes: {NOT_OF_MOUNTS}"),
    (
        "springs.bdf",
        "--output there --units mm-t-s --frequency 20",
        "springs.bdf: --frequency: none of its rates depend on frequency; leave it out",
    ),
    (
        "mounts.csv",
        "--units mm-t-s",
        "mounts.csv: --units: every column says its own unit; leave it out",
    ),
    ("mounts.csv", "--frequency 20", f"--frequency: {NOT_OF_A_TABLE}"),
    ("mounts.csv", "--bodies a b", f"--bodies: {NOT_OF_A_TABLE}"),
    ("mounts.csv", "--output there --pose x=1,0,0", f"--pose: {NOT_OF_A_TABLE}"),
    ("rates.gbs", "--units mm-t-s", "--units: has no effect on a property file"),
    ("rates.gbs", "--frequency 20", "--frequency: has no effect on a property file"),
    ("road.crg", "--name a", "--name is of a road that is written"),
    ("road.crg", "--output there --replace", f"--replace: {NOT_OF_A_ROAD}"),
    ("road.crg", "--output there --units mm-t-s", f"--units: {NOT_OF_A_ROAD}"),
    ("road.crg", "--modes 0", f"--modes: {NOT_OF_A_ROAD}"),
]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder of the files, and in it a vehicle of one body."""
    monkeypatch.chdir(tmp_path)
    for name, content in FILES.items():
        (tmp_path / name).write_bytes(content)
    options = ["--name", "block", "--units", "mm-t-s", "--attach", "1=11", "--output", "there"]
    assert main(["import", "run.unv", *options]) == 0
    return tmp_path


@pytest.mark.parametrize(("file", "options", "words"), WITHOUT_EFFECT)
def test_an_option_that_would_do_nothing_is_refused_in_one_sentence(
    folder, capsys, file, options, words
):
    before = (folder / "there/vehicle.toml").read_bytes()
    capsys.readouterr()
    assert main(["import", file, *options.split()]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    (line,) = said.err.splitlines()
    assert words in line
    assert not (folder / "vehicle").exists()
    assert (folder / "there/vehicle.toml").read_bytes() == before


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"n_modes": 20}, f"--modes: {NO_MATRICES}"),
        ({"up_to_hz": 90.0}, f"--up-to: {NO_MATRICES}"),
        ({"up_to_hz": 90.0, "condense": "guyan"}, NO_MATRICES),
        ({"n_modes": 20, "up_to_hz": 90.0}, "found both, expected one of them"),
        ({"plane": "x=0"}, "--plane is of two halves"),
        ({"mesh_unit": "mm"}, "--mesh-unit is of a mesh"),
        ({"replaces": True}, "--replace is of a body in a folder"),
    ],
)
def test_an_argument_that_would_do_nothing_is_refused(folder, settings, words):
    with pytest.raises(VehicleError, match=words):
        import_component("run.op2", units="mm-t-s", attach=["1=11"], **settings)
