"""Vehicle folders whose bodies and mounts stand in tables."""

import csv
import shutil
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook
from scipy.spatial.transform import Rotation

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.export.mount_table import mount_table
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.body_tables.columns import KINDS, NEGATIVE, spoken
from modeviz.files.survey import survey
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import Damper, Spring

POWERTRAIN_HZ = [10.0739, 11.5762, 14.6973, 16.3353, 19.7130, 31.4272]
"""Of a public study's engine on three mounts, solved independently."""

VEHICLE = """name = "engine"
{more}
body_table = "{bodies}"
mount_table = "{mounts}"
"""

BODY = {
    "name": "engine",
    "role": "powertrain",
    "mass [kg]": 117.2,
    "cg_x [mm]": 2371.09,
    "cg_y": -28.66,
    "cg_z": 131.61,
    "Ixx [kg m^2]": 4.583,
    "Iyy": 1.955,
    "Izz": 5.507,
    "Ixy = -int x*y dm": 0.610,
    "Ixz = -int x*z dm": -0.019,
    "Iyz = -int y*z dm": 0.066,
}
PLACE = ("x [m]", "y [m]", "z [m]")
RATE = ("k_x [N/mm]", "k_y [N/mm]", "k_z [N/mm]")
MOUNTS = [
    {"name": name, "body_1": "engine", "body_2": "ground"}
    | dict(zip(PLACE, place, strict=True))
    | dict(zip(RATE, (1.3 * k for k in rates), strict=True))
    for name, place, rates in (
        ("M1", (2.250, 0.2827, 0.200), (180, 73, 320)),
        ("M2", (2.120, -0.1725, 0.050), (240, 120, 480)),
        ("M3", (2.583, -0.200, 0.045), (73, 180, 320)),
    )
]


def csv_file(path: Path, rows: list[dict]) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]))
        table.writeheader()
        table.writerows(rows)


def folder(path: Path, bodies=(BODY,), mounts=MOUNTS, more="") -> Path:
    """A folder with tables in CSV."""
    path.mkdir(exist_ok=True)
    (path / "vehicle.toml").write_text(
        VEHICLE.format(bodies="bodies.csv", mounts="mounts.csv", more=more)
    )
    csv_file(path / "bodies.csv", list(bodies))
    csv_file(path / "mounts.csv", list(mounts))
    return path


def frequencies(vehicle):
    return solve_modes(assemble(vehicle)).frequency_hz


def test_an_engine_from_tables_has_the_known_frequencies(tmp_path):
    found = frequencies(read_vehicle(folder(tmp_path / "engine")))
    assert found == pytest.approx(POWERTRAIN_HZ, abs=1e-4)


def workbook(path: Path, sheets: dict[str, list[dict]]) -> None:
    book = Workbook()
    for title, rows in sheets.items():
        sheet = book.create_sheet(title)
        sheet.append(list(rows[0]))
        for row in rows:
            sheet.append(list(row.values()))
    book.remove(book.worksheets[0])
    book.save(path)


@pytest.mark.parametrize("is_one", [True, False])
def test_workbooks_say_the_same_as_csv(tmp_path, is_one):
    names = ("all.xlsx", "all.xlsx") if is_one else ("bodies.xlsx", "mounts.xlsx")
    if is_one:
        notes = [{"what": "this is our engine"}]
        workbook(tmp_path / "all.xlsx", {"notes": notes, "Mounts": MOUNTS, "Bodies": [BODY]})
    else:
        workbook(tmp_path / "bodies.xlsx", {"Sheet1": [BODY]})
        workbook(tmp_path / "mounts.xlsx", {"Sheet1": MOUNTS})
    text = VEHICLE.format(bodies=names[0], mounts=names[1], more="")
    (tmp_path / "vehicle.toml").write_text(text)
    assert frequencies(read_vehicle(tmp_path)) == pytest.approx(POWERTRAIN_HZ, abs=1e-4)


def test_a_vehicle_of_tables_is_written_and_read_back_the_same(tmp_path):
    turned = {
        "angle_x [deg]": 10,
        "angle_y [deg]": -40,
        "angle_z [deg]": 5,
        "angle_order": "zyx turned",
    }
    more = {"c_z [N s/m]": 200, "k_rx [N m/rad]": 30, "softest_x [N/mm]": 50, "loss_factor": 0.1}
    mounts = [MOUNTS[0] | turned | more, *MOUNTS[1:]]
    vehicle = read_vehicle(folder(tmp_path / "engine", mounts=[{**mounts[0], **m} for m in mounts]))
    write_vehicle(vehicle, tmp_path / "written")
    again = read_vehicle(tmp_path / "written")
    np.testing.assert_allclose(frequencies(again), frequencies(vehicle), rtol=1e-13)
    for old, new in zip(vehicle.mount_groups, again.mount_groups, strict=True):
        assert (new.rates, new.loss_factor, new.bounds) == (old.rates, old.loss_factor, old.bounds)
        np.testing.assert_allclose(new.mounts[0].axes, old.mounts[0].axes, atol=1e-15)
        np.testing.assert_allclose(new.mounts[0].damping, old.mounts[0].damping)


def test_the_tables_of_a_folder_are_not_overwritten(tmp_path):
    engine = folder(tmp_path / "engine")
    with pytest.raises(VehicleError, match="is not a vehicle folder and nothing else"):
        write_vehicle(read_vehicle(engine), engine)


@pytest.mark.parametrize("at", ["origin", "point", "center of gravity", ""])
def test_inertia_about_another_point_is_taken_to_the_center_of_gravity(tmp_path, at):
    """Against the sum over eight point masses, about that point and about their centre."""
    masses, places = np.arange(1.0, 9.0), np.random.default_rng(7).normal(0.5, 0.3, (8, 3))
    center = masses @ places / masses.sum()
    point = {"origin": np.zeros(3), "point": np.array([0.3, -0.2, 1.0])}.get(at, center)

    def inertia(about):
        r = places - about
        return sum(m * (v @ v * np.eye(3) - np.outer(v, v)) for m, v in zip(masses, r, strict=True))

    given = inertia(point)
    body = {"name": "block", "mass [kg]": masses.sum(), "inertia_at": at}
    body |= dict(zip(("cg_x [m]", "cg_y [m]", "cg_z [m]"), center.tolist(), strict=True))
    body |= {
        f"I{a}{b} {'' if a == b else f'= +int {a}*{b} dm '}[kg m^2]": given.item(
            "xyz".index(a), "xyz".index(b)
        )
        * (1 if a == b else -1)
        for a, b in ("xx", "yy", "zz", "xy", "xz", "yz")
    }
    if at == "point":
        body |= {f"point_{a} [m]": x for a, x in zip("xyz", point.tolist(), strict=True)}
    mounts = [m | {"body_1": "block"} for m in MOUNTS]
    (found,) = read_vehicle(folder(tmp_path / "block", [body], mounts)).bodies
    assert isinstance(found, RigidBody)
    np.testing.assert_allclose(found.inertia, inertia(center), rtol=1e-12)


def test_tables_are_in_the_axes_of_the_vehicle_file(tmp_path):
    """The same engine told in axes that point forward and to the left."""
    ours = read_vehicle(folder(tmp_path / "ours"))
    body = BODY | {
        "cg_x [mm]": -2371.09,
        "cg_y": 28.66,
        "Ixz = -int x*z dm": 0.019,
        "Iyz = -int y*z dm": -0.066,
    }
    mounts = [m | {"x [m]": -m["x [m]"], "y [m]": -m["y [m]"]} for m in MOUNTS]
    axes = 'axes = "x forward, y left, z up"'
    theirs = read_vehicle(folder(tmp_path / "theirs", [body], mounts, axes))
    np.testing.assert_allclose(theirs.bodies[0].center_of_gravity, ours.bodies[0].center_of_gravity)
    assert frequencies(theirs) == pytest.approx(frequencies(ours), rel=1e-12)


def test_turned_mounts_have_the_stiffness_of_their_turned_springs(tmp_path):
    turned = {
        "angle_x [deg]": 10,
        "angle_y [deg]": -40,
        "angle_z [deg]": 5,
        "angle_order": "yxz turned",
    }
    vehicle = read_vehicle(folder(tmp_path / "engine", mounts=[m | turned for m in MOUNTS]))
    R = Rotation.from_euler("YXZ", [-40, 10, 5], degrees=True).as_matrix()
    (mount, *_) = vehicle.mounts
    K = R @ np.diag([234e3, 94.9e3, 416e3]) @ R.T
    np.testing.assert_allclose(mount.axes.T @ np.diag(mount.stiffness) @ mount.axes, K, atol=1e-6)


def test_groups_springs_and_dampers_come_of_one_table(tmp_path):
    damper = {"name": "damper", "group": "", "c_z [N s/m]": 900.0} | dict.fromkeys(RATE, "")
    mounts = [
        MOUNTS[0] | {"group": "soft", "c_z [N s/m]": ""},
        MOUNTS[1] | {"group": "soft", "c_z [N s/m]": ""} | dict.fromkeys(RATE, ""),
        MOUNTS[2] | {"group": "", "c_z [N s/m]": ""},
        MOUNTS[2] | damper,
    ]
    vehicle = read_vehicle(folder(tmp_path / "engine", mounts=mounts))
    (group,) = vehicle.mount_groups
    assert [mount.name for mount in group.mounts] == ["M1", "M2"]
    assert [type(c) for c in vehicle.connections] == [Spring, Damper]


BODIES, MOUNT = "bodies.csv: line 2, column ", "mounts.csv: line 2, column "
WRONG = {
    "units missing in bodies": (
        {"mass [kg]": None, "mass": 117.2},
        {},
        BODIES + "mass: found 117.2 without a unit; write it in the header, 'mass [kg]'",
    ),
    "units missing in mounts": (
        {},
        {PLACE[0]: None, PLACE[1]: None, PLACE[2]: None, "x": 2, "y": 0, "z": 0},
        MOUNT + "x: found 2 without a unit; write it in the header, 'x [m]'",
    ),
    "units of something else": (
        {"mass [kg]": None, "mass [N]": 1150},
        {},
        "bodies.csv: line 1: column 'mass [N]': unknown unit of mass 'N', expected one of kg, t, lb",
    ),
    "negative rate": ({}, {RATE[2]: -320}, MOUNT + "k_z [N/mm]: found -320, expected zero or more"),
    "no number": ({}, {RATE[1]: "soft"}, MOUNT + "k_y [N/mm]: found 'soft', expected a number"),
    "unknown body": (
        {},
        {"body_1": "engin"},
        MOUNT + "body_1: unknown body 'engin': did you mean 'engine'?",
    ),
    "no body": ({}, {"body_2": ""}, MOUNT + "body_2: empty, expected one of engine, ground"),
    "joined to itself": ({}, {"body_2": "engine"}, MOUNT + "body_2: joins 'engine' to itself"),
    "no place": ({}, dict.fromkeys(PLACE, ""), MOUNT + "x [m]: empty, expected a place"),
    "half a place": ({}, {PLACE[1]: ""}, MOUNT + "y [m]: empty, expected all of x, y, z"),
    "order of angles": (
        {},
        {"angle_x [deg]": 1, "angle_y [deg]": 2, "angle_order": "xxy fixed"},
        MOUNT + "angle_order: found 'xxy fixed', expected x, y and z in some order",
    ),
    "no order": (
        {},
        {"angle_x [deg]": 1, "angle_y [deg]": 2},
        MOUNT + "angle_order: empty, expected the order of the angles",
    ),
    "angle is no number": (
        {},
        {"angle_x [deg]": "steep"},
        MOUNT + "angle_x [deg]: found 'steep', expected a number",
    ),
    "unknown column in mounts": (
        {},
        {"steifigkeit": 1},
        "mounts.csv: line 1: unknown column 'steifigkeit'",
    ),
    "unknown column in bodies": (
        {"colour of mind": 1},
        {},
        "bodies.csv: line 1: unknown column 'colour of mind'",
    ),
    "column of imports": (
        {},
        {"attachment_1": "7"},
        "mounts.csv: line 1: column 'attachment_1': is read by modeviz import",
    ),
    "missing column": ({"Izz": None}, {}, "bodies.csv: line 1: found no column Izz"),
    "sign not said": (
        {"Ixy = -int x*y dm": None, "Ixy": 0.61},
        {},
        "bodies.csv: line 1: column 'Ixy': does not say its sign, expected 'Ixy = +int",
    ),
    "both signs": (
        {"Ixy = +int x*y dm": -0.61},
        {},
        "bodies.csv: line 1: columns 'Ixy = -int x*y dm' and 'Ixy = +int x*y dm' mean the same",
    ),
    "non-physical inertia": (
        {"Izz": 50},
        {},
        "bodies.csv: line 2, columns Ixx [kg m^2] and others: of the principal moments ",
    ),
    "negative inertia": (
        {"inertia_at": "origin"},
        {},
        "bodies.csv: line 2, columns Ixx [kg m^2] and others: the least principal moment, "
        "taken to the centre of gravity is",
    ),
    "no such point": (
        {"inertia_at": "crank"},
        {},
        BODIES + "inertia_at: found 'crank', expected 'center of gravity', 'origin' or 'point'",
    ),
    "point not said": (
        {"inertia_at": "point"},
        {},
        BODIES + "inertia_at: found 'point', expected it in",
    ),
    "mass of zero": ({"mass [kg]": 0}, {}, BODIES + "mass [kg]: found 0, expected more than 0"),
    "mm read as m": (
        {"cg_x [mm]": None, "cg_x [m]": 2371.09},
        {},
        BODIES + "cg_x [m]: found 2371.09, which is 2371 m from the "
        "origin, expected at most 20 m; if it is in mm, say so: 'cg_x [mm]'",
    ),
    "mounts in mm read as m": ({}, {PLACE[0]: 2250}, MOUNT + "x [m]: found 2250, which is 2250 m from"),
    "role": ({"role": "engin"}, {}, BODIES + "role: unknown role 'engin'"),
    "name of the ground": ({"name": "ground"}, {}, BODIES + "name: 'ground' means what does not move"),
    "missing mesh": ({"mesh": "engine.stl"}, {}, BODIES + "mesh: "),
    "softest above stiffest": (
        {},
        {"softest_z [N/mm]": 900, "stiffest_z [N/mm]": 500},
        "mounts.csv: line 2, column softest_z [N/mm]: found 900, expected less than the stiffest, 500",
    ),
    "group named as a body": (
        {},
        {"group": "engine"},
        "mounts.csv: line 2: connection 'M1': group 'engine' is the name",
    ),
}


def changed(row: dict, changes: dict) -> dict:
    return {key: value for key, value in (row | changes).items() if value is not None}


@pytest.mark.parametrize(("of_body", "of_mount", "words"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_is_told_with_file_line_and_column(tmp_path, of_body, of_mount, words):
    others = {key: value for key, value in of_mount.items() if value is None}
    mounts = [
        changed(dict.fromkeys(of_mount, "") | mount, others if number else of_mount)
        for number, mount in enumerate(MOUNTS)
    ]
    engine = folder(tmp_path / "engine", [changed(BODY, of_body)], mounts)
    with pytest.raises(VehicleError) as error:
        read_vehicle(engine)
    assert words in str(error.value)
    found = survey(engine)
    assert any(words in problem.words for problem in found.problems)


def test_two_of_one_name_are_refused_with_both_lines(tmp_path):
    mounts = [*MOUNTS, MOUNTS[0]]
    with pytest.raises(
        VehicleError, match=r"mounts\.csv: line 5, column name: 'M1' is there twice, in line 2"
    ):
        read_vehicle(folder(tmp_path / "mounts", mounts=mounts))
    with pytest.raises(
        VehicleError, match=r"bodies\.csv: line 3, column name: 'engine' is there twice"
    ):
        read_vehicle(folder(tmp_path / "bodies", bodies=[BODY, BODY]))


def test_a_connection_of_the_file_and_one_of_the_table_have_different_names(tmp_path):
    engine = folder(tmp_path / "engine")
    with (engine / "vehicle.toml").open("a") as file:
        file.write('[units]\nlength = "m"\nstiffness = "N/mm"\n[[spring]]\nname = "M2"\n')
        file.write('bodies = ["engine", "ground"]\nat = [2, 0, 0]\nstiffness = [1, 1, 1]\n')
    with pytest.raises(VehicleError, match=r"mounts\.csv: line 3: connection 'M2' is there twice"):
        read_vehicle(engine)


def test_a_check_lists_what_is_wrong_in_both_tables_and_sums_up_the_rest(tmp_path, capsys):
    more = '[[response_point]]\nname = "seat"\nbody = "cab"\nat = [0, 0, 0]\n'
    bodies = [BODY, BODY | {"name": "cab", "mass [kg]": -5}]
    engine = folder(
        tmp_path / "engine", bodies, [MOUNTS[0] | {RATE[0]: -1}, MOUNTS[1] | {"body_1": "cab"}]
    )
    with (engine / "vehicle.toml").open("a") as file:
        file.write('[units]\nlength = "m"\n' + more)
    words = [problem.words for problem in survey(engine).problems]
    assert [w.split(": found")[0] for w in words] == [
        "bodies.csv: line 3, column mass [kg]",
        "mounts.csv: line 2, column k_x [N/mm]",
    ]
    assert main(["check", str(engine)]) == 2
    assert "2 problems" in capsys.readouterr().out


def test_a_check_of_sound_tables_sums_them_up(tmp_path, capsys):
    assert main(["check", str(folder(tmp_path / "engine"))]) == 0
    out = capsys.readouterr().out
    assert "no problems, no doubts" in out
    assert "117.2" in out


def test_a_table_that_is_not_there_is_told(tmp_path):
    engine = folder(tmp_path / "engine")
    shutil.move(engine / "mounts.csv", engine / "mounts.xlsx")
    with pytest.raises(VehicleError, match=r"mount_table: .*mounts\.csv"):
        read_vehicle(engine)


def test_every_column_of_a_body_table_is_on_the_page():
    page = Path(__file__).parents[2].joinpath("docs/vehicle-folder.md").read_text("utf-8")
    for name in KINDS.keys() - {*NEGATIVE}:
        assert f"`{spoken(name).split(' =')[0]}" in page, name


@pytest.mark.parametrize("unit", ["cm", "mm"])
def test_places_in_other_units_than_those_of_the_body_are_doubted(tmp_path, unit):
    """Metres under a header that says cm or mm: mounts are then near the origin, far from a motor."""
    of_unit = dict(zip(PLACE, (f"x [{unit}]", "y", "z"), strict=True))
    mounts = [{of_unit.get(key, key): value for key, value in mount.items()} for mount in MOUNTS]
    motor = BODY | {"Ixx [kg m^2]": 0.3, "Iyy": 0.2, "Izz": 0.3}
    motor |= dict.fromkeys((key for key in BODY if "int" in key), 0)
    (note,) = survey(folder(tmp_path / "engine", [motor], mounts)).doubts
    assert "from the centre of gravity of 'engine'" in note
    assert "in other units" in note


def test_mounts_that_are_all_in_the_centre_of_gravity_are_doubted(tmp_path):
    body = BODY | {"cg_x [mm]": 0, "cg_y": 0, "cg_z": 0}
    mounts = [
        {key.replace("[m]", "[mm]"): value for key, value in mount.items()} | {"x [mm]": 0.3}
        for mount in MOUNTS
    ]
    (note,) = survey(folder(tmp_path / "engine", [body], mounts)).doubts
    assert note.startswith("all 3 connections are within")


def test_an_exported_table_of_mounts_is_one_of_a_folder(tmp_path):
    """`modeviz export mounts.csv` writes the columns that are read here."""
    turned = {
        "angle_x [deg]": 10,
        "angle_y [deg]": -40,
        "angle_z [deg]": 5,
        "angle_order": "zyx turned",
    }
    mounts = [MOUNTS[0] | turned, *(m | dict.fromkeys(turned, "") for m in MOUNTS[1:])]
    vehicle = read_vehicle(folder(tmp_path / "engine", mounts=mounts))
    (tmp_path / "engine" / "mounts.csv").write_bytes(mount_table(vehicle))
    again = read_vehicle(tmp_path / "engine")
    assert frequencies(again) == pytest.approx(frequencies(vehicle), rel=1e-12)
