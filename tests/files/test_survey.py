"""A folder with mistakes is read as far as it can be, and every mistake is told, each at its key."""

import time
from pathlib import Path

import pytest
from folders import one_of_everything
from test_files import EDITS, edit

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.survey import Survey, survey

DOZEN = {
    "meshes/cab.glb": ("meshes/cob.glb", "flexible_body[0].mesh", "did you mean 'cab.glb'?"),
    "damping_ratio = 0.03": ("", "flexible_body[0].damping_ratio", "expected a number or a list"),
    "[12.6, 29.6": ("[-12.6, 29.6", "rigid_body[0]", "expected a symmetric matrix with positive"),
    "at = [0.01, -0.02, 0.03]": ("at = [0.01, -0.02, 3]", "added_mass[0]", "at most 0.1 m is allowed"),
    '"C1 left"\nbodies = ["cab"': ('"C1 left"\nbodies = ["cob"', "mount_group[0].mount[0]", "'cab'?"),
    "axes = [[0.6": ("axes = [[0.7", "spring[0]", "expected three orthogonal unit vectors"),
    "damping = [0.0, 0.0, 1234.5]": ("damping = [1]", "damper[0].damping", "of length 3"),
    "track = ": ("trak = ", "tyre[0].trak", "did you mean 'track'?"),
    "roads/road_1.csv": ("../road_1.csv", "road[0].file", "expected a file inside the vehicle folder"),
    'kind = "radial force"': ('kind = "radial"', "wheel_load[1].kind", "there are unbalance, radial"),
    "acceleration_psd": ("acceleration", "base_motion[1].acceleration", "expected a number"),
    "C1 = { vert": ("C2 = { vert", "rates.optimised", "unknown mount group 'C2'"),
    "frequency_step = 0.1": ("frequency_step = 0.3", "highest_frequency", "a whole multiple of"),
    'unbalance = "g m"': ('unbalance = "gm"', "units.unbalance", "did you mean 'g m'?"),
}
"""What stands in the file: what stands there instead, the key that is told, and the remedy."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "truck")
    return tmp_path / "truck"


def told(found: Survey) -> list[str]:
    return [str(problem) for problem in found.problems]


def test_a_folder_without_mistakes_is_the_vehicle_that_is_read(folder):
    found = survey(folder)
    assert not found.problems
    assert found.vehicle is not None
    assert found.vehicle.all_connections[0].name == read_vehicle(folder).all_connections[0].name
    assert [body.name for body in found.bodies] == ["cab", "Engine & box"]


def test_a_dozen_mistakes_are_told_at_once_each_at_its_key_with_its_remedy(folder):
    for old, (new, _, _) in DOZEN.items():
        edit(folder, old, new)
    found = survey(folder)
    keys = {problem.key: problem for problem in found.problems}
    for _, key, remedy in DOZEN.values():
        assert remedy in keys[key].words
    assert len(found.problems) == len(DOZEN)
    assert {problem.file for problem in found.problems} == {"vehicle.toml"}
    assert str(folder) not in "".join(told(found))


@pytest.mark.parametrize("case", EDITS)
def test_what_the_reader_complains_of_is_among_the_problems(folder, case):
    old, new, words = EDITS[case]
    edit(folder, old, new)
    without_place = words.split(" (at line")[0]  # of the line, which is told beside the file
    assert without_place in "\n".join(told(survey(folder)))


def test_a_body_is_read_without_what_can_be_left_out_of_it(folder):
    edit(folder, "meshes/cab.glb", "meshes/cob.glb")
    found = survey(folder)
    assert [problem.left_out for problem in found.problems] == ["flexible_body[0].mesh"]
    assert found.vehicle is not None
    assert found.vehicle.body("cab").mesh == ()
    assert len(found.vehicle.all_connections) == 7


def test_a_body_whose_damping_is_in_percent_is_read_with_none(folder):
    edit(folder, "damping_ratio = 0.03", "damping_ratio = [2.0, 3.0]")
    (problem,) = survey(folder).problems
    assert problem.key == problem.left_out == "flexible_body[0].damping_ratio"
    assert "expected a fraction of critical from 0 to below 1" in problem.words
    assert len(survey(folder).bodies) == 2


def test_what_only_misses_a_body_that_cannot_be_read_is_no_problem_of_its_own(folder):
    edit(folder, "bodies/cab.npz", "bodies/cob.npz")
    found = survey(folder)
    assert [problem.key for problem in found.problems] == ["flexible_body[0].modes"]
    assert found.vehicle is not None
    assert [c.name for c in found.vehicle.all_connections] == ["tyre left"]


def test_what_is_wrong_with_a_connection_of_a_lost_body_is_told_too(folder):
    edit(folder, "bodies/cab.npz", "bodies/cob.npz")
    edit(folder, '"C1 left"\nbodies = ["cab", "Engine', '"C1 left"\nbodies = ["cab", "Motor')
    assert [problem.key for problem in survey(folder).problems] == [
        "flexible_body[0].modes",
        "mount_group[0].mount[0]",
    ]


def test_all_that_is_wrong_in_one_table_is_told_at_once(folder):
    edit(folder, "at = [[0.0, 0.0, 0.0], [0.0, 0.1, 0.7]]\naxes", "at = [1]\nelastic_centre = 1\naxes")
    edit(folder, "stiffness = [100.0, 200.0, 33.333333333333336]", 'stiffness = "hard"')
    edit(folder, 'name = "arm"\nbodies = ["cab", "Engine & box"]\n', "")
    assert [problem.key for problem in survey(folder).problems] == [
        "spring[0].at",
        "spring[0].elastic_centre",
        "spring[0].stiffness",
        "spring[0].name",
        "spring[0].bodies",
    ]


def test_tables_keep_their_numbers_whatever_was_taken_out_before_them(folder):
    edit(folder, 'kind = "unbalance"', 'kind = "none"')
    edit(folder, 'tyre = "tyre left"\namplitude = 35.6', 'tyre = "tyre right"\namplitude = 35.6')
    assert [problem.key for problem in survey(folder).problems] == [
        "wheel_load[0].kind",
        "wheel_load[1]",
    ]


ON_A_MOUNT = """
name = "engine on a mount"

[units]
length = "mm"
mass = "kg"
inertia = "kg m²"
stiffness = "N/mm"
force = "N"
torque = "N m"

[[rigid_body]]
name = "engine"
mass = 200.0
center_of_gravity = [0.0, 0.0, 500.0]
inertia = [10.0, 8.0, 12.0]
crank_axis = "lateral"

[[mount_group]]
name = "M"
rates = { vertical = 200.0, lateral = 100.0, fore_aft = 100.0 }
[mount_group.dynamic]
reference_frequency = 10.0
[mount_group.dynamic.three_parameter]
stiffening = [0.5, 0.5, 0.5]
corner = 15.0
[[mount_group.curve]]
direction = "vertical"
deflection = [-5.0, 0.0, 5.0]
force = [-900.0, 0.0, 900.0]
[[mount_group.mount]]
name = "left"
bodies = ["engine", "ground"]
at = [0.0, -300.0, 500.0]

[[response_point]]
name = "driver"
body = "engine"
at = [0.0, 0.0, 500.0]

[[load_case]]
name = "first gear"
[[load_case.load]]
body = "engine"
torque = [0.0, 900.0, 0.0]

[[engine]]
name = "four"
body = "engine"
[engine.inline]
cylinders = 4
stroke = 90.0
rod_ratio = 0.3
reciprocating_mass = 0.6
lowest_speed = 700
highest_speed = 4000

[[problem]]
name = "idle"
goal = "idle"
[[problem.group]]
group = "M"
"""


@pytest.mark.parametrize(
    ("right", "wrong", "key"),
    [
        ("corner = 15.0", "corner = 0.0", "mount_group[0].dynamic.three_parameter.corner"),
        ("0.0, 900.0]", "0.0, -900.0]", "mount_group[0].curve[0].force[2]"),
        ("cylinders = 4", "cylinders = 0", "engine[0].inline.cylinders"),
        ('"engine"\ntorque', '"motor"\ntorque', "load_case[0]"),
        ('name = "first gear"', 'name = "a"\n[[load_case]]\nname = "a"', "load_case[1]"),
    ],
)
def test_a_mistake_in_what_mounts_and_engines_have_is_one_problem(tmp_path, right, wrong, key):
    assert right in ON_A_MOUNT
    (tmp_path / "vehicle.toml").write_text(ON_A_MOUNT.replace(right, wrong), "utf-8")
    found = survey(tmp_path)
    assert [problem.key for problem in found.problems] == [key]
    assert found.problems[0].line
    assert [body.name for body in found.bodies] == ["engine"]


def test_a_folder_without_anything_to_read_is_one_problem(folder, tmp_path):
    assert [p.words for p in survey(tmp_path).problems] == [
        "found no vehicle.toml; a vehicle is a folder with a vehicle.toml, and the modes, meshes and "
        "roads that it names"
    ]


def test_a_line_that_is_no_toml_is_told_and_the_rest_is_read_without_it(folder):
    edit(folder, "speed = 8", "speed = = 8")
    edit(folder, 'mesh = "meshes/cab.glb"', 'mesh = "meshes/cob.glb')
    edit(folder, "[[mount_group.mount]]", "[[mount_group.mount]")
    edit(folder, "at = [0.01, -0.02, 0.03]", "at = [0.01, -0.02")
    edit(folder, "acceleration_psd", "acceleration")
    found = survey(folder)
    lines = (folder / "vehicle.toml").read_text().splitlines()
    by_key = {problem.key: problem for problem in found.problems}
    broken = {lines[p.line - 1].split(" ")[0] for p in found.problems if p.words.startswith("not TOML")}
    assert broken == {"speed", "mesh", "[[mount_group.mount]", "at"}
    below = {key for key in by_key if key.startswith("mount_group[0].")}  # taken for the table before
    assert set(by_key) - below == {"", "base_motion[1].acceleration", "added_mass[0].at"}
    assert len(found.bodies) == 2


@pytest.mark.parametrize(
    "text", ["\0", "a = 1e", "[" * 5000, "x" * 5000, "=\n" * 500, '"""', "a.b\n" * 30]
)
def test_what_is_no_toml_at_all_is_few_problems(folder, text):
    (folder / "vehicle.toml").write_text(text)
    found = survey(folder)
    assert found.vehicle is None
    assert 1 <= len(found.problems) <= 3


def test_hundreds_of_mistakes_take_seconds_and_the_last_says_that_there_may_be_more(folder):
    path = folder / "vehicle.toml"
    path.write_text(path.read_text() + '[[spring]]\nname = "a"\nbodies = [1, "x"]\n' * 1000)
    start = time.process_time()
    found = survey(folder)
    assert time.process_time() - start < 10
    assert found.problems[-1].words.startswith("there may be more")


def test_every_line_that_is_left_out_leaves_a_folder_that_is_read_or_whose_problems_are_told(folder):
    lines = (folder / "vehicle.toml").read_text().splitlines()
    for number in range(len(lines)):
        (folder / "vehicle.toml").write_text("\n".join(lines[:number] + lines[number + 1 :]))
        found = survey(folder)
        try:
            read_vehicle(folder)
        except VehicleError as error:
            first = str(error).removeprefix(f"{folder}/vehicle.toml: ")
            assert found.problems[0].words.split(";")[0][:60] in first.replace(f"{folder}/", "")
        else:
            assert not found.problems
