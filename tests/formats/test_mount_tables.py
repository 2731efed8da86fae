"""Mount tables as csv and openpyxl write them, put into vehicle folders."""

import csv
import re
import shutil
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from openpyxl import Workbook
from scipy.spatial.transform import Rotation
from two_networks import ATTACHED, joined_frequencies, place, two_networks

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.mount_tables.columns import KINDS
from modeviz.files.mount_tables.reading import Reading
from modeviz.files.mount_tables.table import is_mount_table, read_mount_table
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.units import INCH
from modeviz.vehicle.connections import GROUND, Damper, Spring

PAGE = Path(__file__).parents[2].joinpath("docs/mount-tables.md").read_text("utf-8")
NAMED = {"vertical": "z", "lateral": "y", "fore_aft": "x"}

BLOCK = """name = "block"  # as I weighed it
{axes}
[units]
length = "in"
mass = "kg"
inertia = "kg m²"
stiffness = "lbf/in"

[[rigid_body]]
name = "block"
mass = 100.0
center_of_gravity = [0, 0, 20]
inertia = [5.0, 10.0, 12.0]
"""


@pytest.fixture
def block(tmp_path):
    """A folder with a rigid block, in inches."""
    folder = tmp_path / "block"
    folder.mkdir()
    (folder / "vehicle.toml").write_text(BLOCK.format(axes=""))
    return folder


@pytest.fixture(scope="module")
def networks(tmp_path_factory):
    """A folder with two flexible bodies in the same place, not to be changed."""
    scratch = tmp_path_factory.mktemp("networks")
    return two_networks(scratch / "vehicle", scratch)


@pytest.fixture
def pair(networks, tmp_path):
    return Path(shutil.copytree(networks, tmp_path / "pair"))


def written(path: Path, rows, delimiter=",", encoding="utf-8", **kwargs) -> Path:
    with path.open("w", newline="", encoding=encoding) as file:
        csv.writer(file, delimiter=delimiter, **kwargs).writerows(rows)
    return path


def imported(path: Path, folder: Path, *options: str):
    assert main(["import", str(path), "--output", str(folder), *options]) == 0
    return read_vehicle(folder)


def read(path: Path, units=None, notes=None):
    note = (lambda text: None) if notes is None else notes.append
    return read_mount_table(path, Reading(NAMED, note, units.factors if units else {}))


HEADER = [
    "name",
    "body_1",
    "body_2",
    "x [mm]",
    "y [mm]",
    "z [mm]",
    "k_x [N/mm]",
    "k_y [N/mm]",
    "k_z [N/mm]",
]


def hertz(vehicle, n):
    return np.sqrt(np.abs(solve_modes(assemble(vehicle)).omega_n_squared[:n])) / (2 * np.pi)


def test_mounts_between_flexible_bodies_couple_as_the_whole_matrices_do(pair, tmp_path):
    """Turned axes and all modes: only the file's six digits are between them."""
    angles = {11: (20, 0, 0), 14: (0, -35, 0), 22: (0, 0, 50), 23: (10, 20, 30)}
    rates = {node: np.array([10.0, 25.0, 60.0]) * (i + 1) for i, node in enumerate(ATTACHED)}
    header = ["Mount", "Node A", "Node B", "Body A", "Body B", "kx [N/mm]", "ky [N/mm]", "kz [kN/m]"]
    rows = [
        [f"m{node}", node, node, "upper", "lower", *rates[node], *angles[node]] for node in ATTACHED
    ]
    path = written(tmp_path / "m.csv", [[*header, "roll [deg]", "pitch [deg]", "yaw [°]"], *rows])
    vehicle = imported(path, pair)
    turns = {n: Rotation.from_euler("xyz", a, degrees=True).as_matrix() for n, a in angles.items()}
    expected = joined_frequencies([(n, turns[n] * rates[n] @ turns[n].T) for n in ATTACHED])
    np.testing.assert_allclose(hertz(vehicle, 30)[6:], expected[6:30], rtol=2e-4)


def test_bodies_are_those_whose_attachments_are_at_a_place_that_names_none(pair, tmp_path):
    rows = [[f"m{n}", *np.add(place(n), [3, 4, 0]), 10, 10, 10] for n in ATTACHED]
    header = ["name", "x", "y", "z", "kx", "ky", "kz"]
    vehicle = imported(written(tmp_path / "m.csv", [header, *rows]), pair, "--units", "mm-t-s")
    assert {frozenset(mount.bodies) for mount in vehicle.mounts} == {frozenset({"upper", "lower"})}
    for mount, node in zip(vehicle.mounts, ATTACHED, strict=True):
        np.testing.assert_allclose(1000 * mount.points, [np.add(place(node), [3, 4, 0])] * 2)


def test_the_ground_is_the_second_end_wherever_the_table_has_it(block, tmp_path):
    """And what acts a fifth of the way from the first acts four fifths from the other."""
    header = [*HEADER, "x_2 [mm]", "y_2 [mm]", "z_2 [mm]", "elastic_center"]
    rows = [["a", "Ground", "block", 0, 0, 0, 1, 2, 3, 0, 0, 100, 0.2]]
    (mount,) = imported(written(tmp_path / "m.csv", [header, *rows]), block).mounts
    assert mount.bodies == ("block", GROUND)
    np.testing.assert_allclose(mount.points, [[0, 0, 0.1], [0, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(mount.center, [0, 0, 0.02])


def test_an_end_without_a_place_is_where_the_other_one_is(pair, tmp_path):
    header = ["name", "node 1", "body 1", "body 2", "kx [N/mm]"]
    rows = [["a", 11, "upper", "ground", 1], ["b", 14, "upper", "lower", 1]]
    vehicle = imported(written(tmp_path / "m.csv", [header, *rows]), pair)
    for mount, node in zip(vehicle.mounts, (11, 14), strict=True):
        np.testing.assert_allclose(1000 * mount.points, [place(node)] * 2)


def test_what_stands_in_the_file_stays_and_numbers_come_in_its_units(block, tmp_path):
    before = (block / "vehicle.toml").read_text()
    header = [*HEADER, "k_rx [Nm/deg]", "loss factor [%]", "group"]
    rows = [["a", "block", "ground", 254, 0, 508, 17.5, 18, 19, 2, 12, "M"]]
    vehicle = imported(written(tmp_path / "m.csv", [header, *rows]), block)
    after = (block / "vehicle.toml").read_text()
    assert after.replace('rotational_stiffness = "N m/rad"\n', "", 1).startswith(before)
    assert "at = [10.0, 0.0, 20.0]" in after
    (mount,) = vehicle.mounts
    np.testing.assert_allclose(mount.points, [[10 * INCH, 0, 20 * INCH]] * 2)
    np.testing.assert_allclose(mount.stiffness, [17_500, 18_000, 19_000])
    np.testing.assert_allclose(mount.rotational_stiffness, [2 * 180 / np.pi, 0, 0])
    assert mount.loss_factor == pytest.approx(0.12)
    assert vehicle.mount_groups[0].name == "M"


@pytest.mark.parametrize(
    ("axes", "mapped"),
    [
        ("", np.eye(3)),
        ('axes = "x forward, y left, z up"', np.diag([-1, -1, 1])),
        ('axes = "x left, y up, z forward"', np.array([[0, 0, -1], [-1, 0, 0], [0, 1, 0]])),
    ],
)
def test_places_axes_and_directions_are_those_of_the_vehicles_file(tmp_path, axes, mapped):
    """k_x is along the file's x; vertical is up in every file."""
    folder = tmp_path / "v"
    folder.mkdir()
    (folder / "vehicle.toml").write_text(BLOCK.format(axes=axes))
    path = written(
        tmp_path / "m.csv",
        [
            [*HEADER, "vertical [N/mm]", "lateral [N/mm]", "fore-aft [N/mm]", "yaw [deg]", "group"],
            ["a", "block", "ground", 100, 200, 300, 1, 2, 3, "", "", "", 30, ""],
            ["b", "block", "ground", 100, 200, 300, "", "", "", 4, 5, 6, "", "B"],
        ],
    )
    vehicle = imported(path, folder)
    by_name = {c.name: c for c in vehicle.all_connections}
    turn = Rotation.from_euler("z", 30, degrees=True).as_matrix()
    K = turn @ np.diag([1000, 2000, 3000]) @ turn.T
    for name, expected in (("a", mapped @ K @ mapped.T), ("b", np.diag([6000, 5000, 4000]))):
        c = by_name[name]
        np.testing.assert_allclose(c.axes.T * c.stiffness @ c.axes, expected, atol=1e-9)
        np.testing.assert_allclose(c.points[0], mapped @ [0.1, 0.2, 0.3])


def test_two_vectors_make_the_axes_of_angles(tmp_path):
    turn = Rotation.from_euler("xyz", [0.1, -0.7, 2.0])
    axes = turn.as_matrix().T
    names = [f"{a}_axis_{c}" for a in "xyz" for c in "xyz"]
    for kept in ((0, 1), (0, 2), (1, 2)):
        cells = [np.round(5 * v, 12) if row in kept else "" for row in range(3) for v in axes[row]]
        rows = [[*HEADER, *names], ["a", "b", GROUND, 0, 0, 0, 1, 1, 1, *cells]]
        (found,) = read(written(tmp_path / "m.csv", rows))
        np.testing.assert_allclose(found.axes, axes, atol=1e-11)
    angles = [*HEADER, "roll [rad]", "pitch [rad]", "yaw [rad]"]
    rows = [angles, ["a", "b", GROUND, 0, 0, 0, 1, 1, 1, 0.1, -0.7, 2.0]]
    np.testing.assert_allclose(read(written(tmp_path / "m.csv", rows))[0].axes, axes, atol=1e-12)


def test_angles_turn_in_the_order_that_is_said(tmp_path):
    names = [*HEADER, "angle_x [deg]", "angle_y [deg]", "angle_z [deg]", "angle_order"]
    for order, seq in (("zxy fixed", "zxy"), ("z, x, y turned", "ZXY")):
        rows = [names, ["a", "b", GROUND, 0, 0, 0, 1, 1, 1, 10, 20, 30, order]]
        axes = Rotation.from_euler(seq, [30, 10, 20], degrees=True).as_matrix().T
        np.testing.assert_allclose(read(written(tmp_path / "m.csv", rows))[0].axes, axes, atol=1e-12)


@pytest.mark.parametrize(
    ("order", "words"),
    [
        ("", "line 2, column angle_order: empty, expected the order of the angles"),
        ("yyz fixed", "line 2, column angle_order: found 'yyz fixed', expected x, y and z"),
        ("xyz", "line 2, column angle_order: found 'xyz', expected \"xyz fixed\""),
    ],
)
def test_angles_without_an_order_are_refused(tmp_path, order, words):
    names = [*HEADER, "angle_x [deg]", "angle_y [deg]", "angle_z [deg]", "angle_order"]
    rows = [names, ["a", "b", GROUND, 0, 0, 0, 1, 1, 1, 10, 20, 0, order]]
    with pytest.raises(VehicleError, match=re.escape(words)):
        read(written(tmp_path / "m.csv", rows))


def test_every_line_that_is_wrong_is_named(tmp_path):
    rows = [
        HEADER,
        *([name, "b", GROUND, 0, 0, 0, 1, 1, k] for name, k in (("a", -1), ("b", 1), ("c", "?"))),
    ]
    with pytest.raises(VehicleError, match=r"m\.csv: line 2, .*-1.*; m\.csv: line 4, .*'\?'"):
        read(written(tmp_path / "m.csv", rows))


ROW = ["a", "block", "ground", 254, -127.5, 508, 17.5, 18.25, 19]


def decimal(cells):
    return [str(cell).replace(".", ",") for cell in cells]


@pytest.mark.parametrize(
    "write",
    [
        lambda path: written(path, [HEADER, ROW]),
        lambda path: written(path, [HEADER, ROW], encoding="utf-8-sig"),
        lambda path: written(path, [HEADER, ROW], encoding="utf-16", delimiter="\t"),
        lambda path: written(path, [HEADER, decimal(ROW)], delimiter=";"),
        lambda path: written(path, [HEADER, decimal(ROW)], delimiter="\t", lineterminator="\r\n"),
        lambda path: written(path, [[], HEADER, [], ROW, [""] * 9, []], lineterminator="\r\n"),
        lambda path: written(path, [[*HEADER, "", ""], [*ROW, "", ""]], quoting=csv.QUOTE_ALL),
        lambda path: path.write_text(
            "sep=;\n" + written(path, [HEADER, decimal(ROW)], delimiter=";").read_text()
        ),
    ],
)
def test_tables_are_read_as_editors_and_spreadsheets_leave_them(tmp_path, write):
    write(tmp_path / "m.csv")
    (found,) = read(tmp_path / "m.csv")
    np.testing.assert_allclose(found.stiffness, [17_500, 18_250, 19_000, 0, 0, 0])
    np.testing.assert_allclose(found.ends[0].place, [0.254, -0.1275, 0.508])
    assert (found.ends[0].body, found.ends[1].body) == ("block", "ground")


@pytest.mark.parametrize(
    "header",
    [
        [
            "Mount name",
            "From",
            "To",
            "X (mm)",
            "Y (mm)",
            "Z (mm)",
            "Kx (N/mm)",
            "Ky (N/mm)",
            "Kz (N/mm)",
        ],
        [
            "ID",
            "Part 1",
            "Part 2",
            "pos x, mm",
            "pos y, mm",
            "pos z, mm",
            "k1 [N/mm]",
            "K2 [N/mm]",
            "k3 [N/mm]",
        ],
        [
            "bushing",
            "Body I",
            "Body J",
            "x / mm",
            "y / mm",
            "z / mm",
            "K_x / (N/mm)",
            "k_y in N/mm",
            "kz in N/mm",
        ],
        [
            "isolator",
            "body a",
            "body b",
            "X Coord [mm]",
            "Y coord [mm]",
            "Z coord [mm]",
            "Stiffness X [N / mm]",
            "Stiffness Y [n/mm]",
            "Stiffness Z [kN/m]",
        ],
        [
            "Name",
            "Component 1",
            "Component 2",
            "location x [cm]",
            "location y [cm]",
            "location z [cm]",
            "fore-aft rate [N/mm]",
            "lateral rate [N/mm]",
            "vertical rate [N/mm]",
        ],
    ],
)
def test_headers_mean_what_engineers_write(tmp_path, header):
    (found,) = read(written(tmp_path / "m.csv", [header, ROW]))
    length = 1e-2 if "cm" in header[3] else 1e-3
    np.testing.assert_allclose(found.stiffness, [17_500, 18_250, 19_000, 0, 0, 0])
    np.testing.assert_allclose(found.ends[1].place, np.array([254, -127.5, 508]) * length)
    assert (found.name, found.ends[0].body, found.ends[1].body) == ("a", "block", "ground")


def test_units_below_the_header_and_a_column_that_means_nothing_here(tmp_path):
    plain = [re.sub(r" \[.*", "", header) for header in HEADER]
    units = ["", "", "", "mm", "mm", "mm", "N/mm", "N/mm", "N/mm", ""]
    notes = []
    path = written(tmp_path / "m.csv", [[*plain, "Comment"], units, [*ROW, "soft"]])
    (found,) = read(path, notes=notes)
    np.testing.assert_allclose(found.stiffness[:3], [17_500, 18_250, 19_000])
    assert notes == ["columns Comment are left out"]


def test_numbers_that_may_be_a_rate_which_has_no_column_are_refused(tmp_path):
    def without_x(*more):
        return [[*HEADER[:6], *HEADER[7:], *(header for header, _ in more)],
                [*ROW[:6], *ROW[7:], *(cell for _, cell in more)]]  # fmt: skip

    for header in ("steifigkeit x", "Steifigkeit längs [N/mm]", "längs"):
        with pytest.raises(VehicleError, match=f"found no column k_x, .* '{re.escape(header)}'"):
            read(written(tmp_path / "m.csv", without_x((header, 17.5))))
    notes = []
    others = without_x(("Preload [N]", 300), ("Comment", "soft"), ("Steifigkeit x [N/mm]", ""))
    (found,) = read(written(tmp_path / "m.csv", others), notes=notes)
    np.testing.assert_allclose(found.stiffness[:3], [0, 18_250, 19_000])
    assert notes[-1] == "there is no column k_x: this stiffness is taken as zero"
    alone = [["name", "k_z [N/mm]", "shore"], ["a", 3, 60]]
    assert read(written(tmp_path / "m.csv", alone))[0].stiffness[2] == 3000
    alone[0][2] = "starr_y"
    with pytest.raises(VehicleError, match="found no column k_x, k_y, and numbers in 'starr_y'"):
        read(written(tmp_path / "m.csv", alone))


def test_titles_above_the_header_are_left_out_and_told(tmp_path):
    for delimiter in ",;":
        rows = [["Mounts of the cab"], ["rev 3"], [], HEADER, ROW]
        notes = []
        (found,) = read(written(tmp_path / "m.csv", rows, delimiter), notes=notes)
        assert found.where == "line 5"
        assert notes == ["what stands above the header in line 4 is left out"]
    book = Workbook()
    for row in (["Mounts", None, "rev 3"], HEADER, ["", "", "", *["-"] * 6], ROW):
        book.active.append(row)
    book.save(tmp_path / "m.xlsx")
    (found,) = read(tmp_path / "m.xlsx")
    np.testing.assert_allclose(found.stiffness[:3], [17_500, 18_250, 19_000])


def test_a_unit_that_one_column_says_holds_for_others_of_its_quantity(tmp_path):
    header = ["name", "from", "to", "x [mm]", "y", "z", "kx [kN/m]", "ky", "vertical", "krx [N m/deg]"]
    (found,) = read(written(tmp_path / "m.csv", [header, [*ROW, 2]]))
    np.testing.assert_allclose(found.stiffness[:3], [17_500, 18_250, 19_000])
    np.testing.assert_allclose(found.ends[0].place, [0.254, -0.1275, 0.508])
    (own,) = read(
        written(
            tmp_path / "m.csv",
            [["name", "from", "to", "kx", "kx min [N/mm]", "units"], ["a", "b", "c", 3000, 1, "N/m"]],
        )
    )
    assert (own.stiffness[0], own.softest[0]) == (3000, 1000)
    header[4] = "y [cm]"
    with pytest.raises(VehicleError, match="line 2, column z: found 508 without a unit"):
        read(written(tmp_path / "m.csv", [header, [*ROW, 2]]))


def test_a_group_has_the_travel_and_the_ratios_of_its_first_line(block, tmp_path):
    header = [*HEADER, "group", "least_travel_z [mm]", "travel vertical max [cm]", "mintravelx [m]",
              "max travel x [m]", "static_ratio", "least_ratio", "most_ratio"]  # fmt: skip
    rows = [[*ROW, "M", -8, 0.5, -0.01, 0.01, 1.5, 0.2, 1.2], ["b", *ROW[1:], "M", *[""] * 7]]
    path = written(tmp_path / "m.csv", [header, *rows])
    assert main(["import", str(path), "--output", str(block)]) == 0
    group = read_vehicle(block).mount_group("M")
    assert group.static_ratio == 1.5
    assert group.ratio_limits == (0.2, 1.2)
    assert set(group.travel) == {"vertical", "fore-aft"}
    assert group.travel["vertical"] == pytest.approx((-0.008, 0.005))
    assert group.travel["fore-aft"] == pytest.approx((-0.01, 0.01))


def test_a_static_rate_of_another_program_is_left_out_and_no_misspelt_ratio(tmp_path):
    header = [*HEADER, "static rate [N/mm]", "group"]
    (found,) = read(written(tmp_path / "m.csv", [header, [*ROW, 11, "M"]]))
    assert np.isnan(found.limits.static_ratio)


def test_numbers_without_units_are_in_those_that_are_named(tmp_path):
    names = ["name", "body_1", "body_2", "x", "y", "z", "kx", "ky", "kz", "krx", "cx", "crx"]
    path = written(tmp_path / "m.csv", [names, ["a", "b", GROUND, 1, 2, 3, 4, 5, 6, 7, 8, 9]])
    for name, length, force in (("m-kg-s", 1, 1), ("mm-t-s", 1e-3, 1), ("mm-kg-mN", 1e-3, 1e-3)):
        (found,) = read(path, UNIT_SYSTEMS[name])
        np.testing.assert_allclose(found.ends[0].place, np.array([1, 2, 3]) * length)
        np.testing.assert_allclose(
            found.stiffness[:4], [*(np.array([4, 5, 6]) * force / length), 7 * force * length]
        )
        np.testing.assert_allclose(found.damping[[0, 3]], [8 * force / length, 9 * force * length])


def test_a_workbook_is_read_with_its_first_sheet_that_is_not_empty(block, tmp_path):
    book = Workbook()
    book.active.title = "empty"
    sheet = book.create_sheet("mounts")
    sheet.append([])
    sheet.append([*HEADER, "group"])
    sheet.append([])
    sheet.append([*ROW, 7])
    sheet.append(["b", *ROW[1:6], None, "18,25", None, "7"])
    path = tmp_path / "m.xlsx"
    book.save(path)
    sheet.cell(5, 8).value = None
    book.save(path)
    vehicle = imported(path, block)
    assert [m.name for m in vehicle.mounts] == ["a", "b"]
    assert vehicle.mount_groups[0].name == "7"
    np.testing.assert_allclose(vehicle.mounts[1].stiffness, [17_500, 18_250, 19_000])


def test_without_a_group_lines_are_springs_and_dampers_and_without_the_column_all_are_tuned(
    block, tmp_path
):
    header = [*HEADER, "cx [N s/m]", "group"]
    rows = [[*ROW, "", "M"], ["b", *ROW[1:], 5, ""], ["c", *ROW[1:6], "", "", "", 700, ""]]
    vehicle = imported(written(tmp_path / "m.csv", [header, *rows]), block)
    spring, damper = vehicle.connections
    assert (type(spring), type(damper)) == (Spring, Damper)
    assert damper.damping.tolist() == [700, 0, 0]
    assert spring.damping.tolist() == [5, 0, 0]
    second = [["s", *ROW[1:]], ["t", *ROW[1:6], 1, 2, 3]]
    vehicle = imported(written(tmp_path / "n.csv", [HEADER, *second]), block)
    assert [g.name for g in vehicle.mount_groups] == ["M", "s", "t"]


def test_bounds_that_are_given_hold_and_the_others_are_usual(block, tmp_path):
    header = [*HEADER, "vertical min [N/mm]", "kx max [N/mm]", "stiffest_y [N/mm]"]
    vehicle = imported(written(tmp_path / "m.csv", [header, [*ROW, 10, 40, 20]]), block)
    softest, stiffest = vehicle.mount_groups[0].bounds
    np.testing.assert_allclose(softest.local(), [17_500 / 4, 18_250 / 4, 10_000])
    np.testing.assert_allclose(stiffest.local(), [40_000, 20_000, 4 * 19_000])


def test_a_vehicle_written_and_read_by_its_mount_table_has_the_same_frequencies(block, tmp_path):
    """To the last digit: the numbers of the table are those of the vehicle."""
    rng = np.random.default_rng(4)
    rows = [
        [
            f"m{i}",
            "block",
            "ground",
            *map(repr, rng.uniform(-400, 400, 3).tolist()),
            *map(repr, rng.uniform(20, 90, 3).tolist()),
        ]
        for i in range(4)
    ]
    vehicle = imported(written(tmp_path / "m.csv", [HEADER, *rows]), block)
    write_vehicle(vehicle, tmp_path / "again")
    again = read_vehicle(tmp_path / "again")
    assert hertz(again, 6).tolist() == hertz(vehicle, 6).tolist()


def test_the_blank_table_of_the_page_is_read(tmp_path):
    (text,) = re.findall(r"```csv\n(.*?)```", PAGE, re.DOTALL)
    path = tmp_path / "m.csv"
    path.write_text(text)
    left, right = read(path)
    assert left.stiffness.tolist() == right.stiffness.tolist() == [120_000, 120_000, 240_000, 0, 0, 0]
    assert left.group == right.group == "C1"
    assert (left.ends[0].place * [1, -1, 1]).tolist() == right.ends[0].place.tolist()


def test_the_page_has_every_column():
    named = set(re.findall(r"`([\w]+)`", "".join(re.findall(r"(?m)^\| (`[a-z].*?) \|", PAGE))))
    directions = {n for n in KINDS if n.endswith(("vertical", "lateral", "fore_aft"))}
    assert set(KINDS) - directions == named


def bad(rows):
    return lambda path: written(path, rows)


def cell(column, value, header=None):
    """A table with another value in a cell."""
    header = HEADER if header is None else header
    row = [*ROW, *[""] * (len(header) - len(ROW))]
    row[header.index(column)] = value
    return bad([header, row])


X_AXIS = [*HEADER, "x_axis_x", "x_axis_y", "x_axis_z", "y_axis_x", "y_axis_y", "y_axis_z"]
BAD = {
    "no text": (lambda path: path.write_bytes(b"\0\1\2"), "found no text"),
    "nothing": (lambda path: path.write_text(""), "expected those of mounts"),
    "a header alone": (bad([HEADER]), "a header and no mounts"),
    "no names": (bad([HEADER[1:], ROW[1:]]), "expected those of mounts"),
    "rates of groups": (
        bad([["group", "units", "vertical", "lateral", "fore_aft"], ["M", "N/mm", 1, 2, 3]]),
        "with --rates",
    ),
    "a road": (bad([["frequency_hz", "left"], [1, 2]]), "the table of a road or a load is named in"),
    "two columns of one meaning": (bad([[*HEADER, "Kx [N/m]"], [*ROW, 3]]), "both mean k_x"),
    "a column misspelt": (bad([[*HEADER, "loss_facter"], [*ROW, 3]]), "did you mean loss_factor"),
    "an unknown unit": (
        bad([[*HEADER[:6], "kx [N/furlong]"], ROW[:7]]),
        "line 1: column 'kx [N/furlong]': unknown unit",
    ),
    "a unit of something else": (bad([["name", "x [N/mm]"], ["a", 1]]), "unknown unit of length"),
    "no unit": (bad([["name", "kx"], ["a", 1]]), "line 2, column kx: found 1 without a unit"),
    "no unit of an angle": (bad([[*HEADER, "roll"], [*ROW, 3]]), "'roll [deg]'"),
    "no name": (cell("name", ""), "line 2, column name: empty"),
    "no number": (
        cell("k_y [N/mm]", "soft"),
        "line 2, column k_y [N/mm]: found 'soft', expected a number",
    ),
    "not finite": (cell("k_y [N/mm]", "inf"), "expected a finite number"),
    "not a number": (cell("x [mm]", "nan"), "line 2, column x [mm]: found 'nan'"),
    "a rate beyond any vehicle": (cell("k_z [N/mm]", "1e40"), "found 1e40, which is beyond any"),
    "a negative rate": (
        cell("k_z [N/mm]", -5),
        "line 2, column k_z [N/mm]: found -5, expected zero or more",
    ),
    "a body that is not there": (
        cell("body_1", "blok"),
        "line 2, column body_1: unknown body 'blok': did you mean 'block'?",
    ),
    "a body to itself": (cell("body_2", "block"), "joins 'block' to itself"),
    "half a place": (cell("y [mm]", ""), "line 2, column y [mm]: empty, expected all of x, y, z"),
    "no place": (
        bad([["name", "body_1", "body_2", "kx [N/m]"], ["a", "block", "ground", 1]]),
        "neither place nor attachment",
    ),
    "no bodies": (bad([["name", *HEADER[3:]], ["a", *ROW[3:]]]), "name the bodies"),
    "neither bodies nor place": (
        bad([["name", "kx [N/m]"], ["a", 1]]),
        "expected a body, an attachment or a place",
    ),
    "no such attachment": (
        bad([["name", "node 1", "body 2", "kx [N/m]"], ["a", 7, "ground", 1]]),
        "unknown attachment '7'",
    ),
    "no rates": (bad([HEADER, [*ROW[:6], "", "", ""]]), "'a' has no rates"),
    "only zero rates": (bad([HEADER, [*ROW[:6], 0, 0, 0]]), "no rate that is not zero"),
    "a name twice": (bad([HEADER, ROW, ROW]), "line 3, column name: 'a' is there twice, in line 2 too"),
    "mounts of a group that differ": (
        bad([[*HEADER, "group"], [*ROW, "M"], ["b", *ROW[1:8], 20, "M"]]),
        "line 3, column k_z [N/mm]: found 20, expected 19 as 'a' has it in line 2",
    ),
    "a loss factor that differs": (
        bad([[*HEADER, "group", "eta [%]"], [*ROW, "M", 8], ["b", *ROW[1:], "M", 10]]),
        "line 3, column eta [%]: found 10, expected 8 as 'a' has it in line 2",
    ),
    "a bound that only one has": (
        bad(
            [
                [*HEADER, "group", "max vertical [kN/m]", "min lateral [kN/m]"],
                [*ROW, "M", 40, ""],
                ["b", *ROW[1:], "M", "", 9],
            ]
        ),
        "line 3, column min lateral [kN/m]: found 9, expected nothing as 'a' has it",
    ),
    "stiffest below softest": (
        bad([[*HEADER, "kx max [kN/m]"], [*ROW, 4]]),
        "line 2, column kx max [kN/m]: found 4, expected more than the softest, 4.375",
    ),
    "half a travel": (
        bad([[*HEADER, "group", "travel z min [mm]", "travel z max [mm]"], [*ROW, "M", -5, ""]]),
        "column travel z max [mm]: empty, expected a length, zero or above",
    ),
    "a travel upside down": (
        bad([[*HEADER, "group", "travel z min [mm]", "travel z max [mm]"], [*ROW, "M", 5, 8]]),
        "column travel z min [mm]: found 5, expected zero or below",
    ),
    "no travel at all": (
        bad([[*HEADER, "group", "travel z min [mm]", "travel z max [mm]"], [*ROW, "M", 0, 0]]),
        "column travel z max [mm]: found no travel at all",
    ),
    "another travel": (
        bad(
            [
                [*HEADER, "group", "travel z min [mm]", "travel z max [mm]"],
                [*ROW, "M", -5, 5],
                ["b", *ROW[1:], "M", -5, 6],
            ]
        ),
        "line 3, column travel z max [mm]: found 6, expected 5 as 'a' has it in line 2",
    ),
    "a travel of the ground": (
        bad(
            [
                [*HEADER, "group", "travel z min [mm]", "travel z max [mm]"],
                ["a", "ground", "block", *ROW[3:], "M", -5, 6],
            ]
        ),
        "the first of 'a' is the ground; give the ground as the second",
    ),
    "a travel of what is not tuned": (
        bad([[*HEADER, "group", "travel z min [mm]", "travel z max [mm]"], [*ROW, "", -5, 5]]),
        "travel and ratios are of mounts that are tuned; give 'a' a group",
    ),
    "a static ratio of nothing": (
        bad([[*HEADER, "static_ratio"], [*ROW, 0]]),
        "column static_ratio: found 0, expected more than zero",
    ),
    "half of the ratios": (
        bad([[*HEADER, "least_ratio", "most_ratio"], [*ROW, 0.2, ""]]),
        "column most_ratio: empty, expected the other ratio too",
    ),
    "ratios upside down": (
        bad([[*HEADER, "least_ratio", "most_ratio"], [*ROW, 0.5, 0.2]]),
        "column most_ratio: found 0.2, expected more than the least, 0.5",
    ),
    "softest above stiffest": (
        bad([[*HEADER, "kx min [N/mm]", "kx max [N/mm]"], [*ROW, 30, 20]]),
        "line 2, column kx min [N/mm]: found 30, expected less than the stiffest, 20",
    ),
    "two axes along a line": (bad([X_AXIS, [*ROW, 1, 0, 0, 2, 0, 0]]), "are 0° apart, expected 90°"),
    "an axis of no length": (bad([X_AXIS, [*ROW, 0, 0, 0, 0, 1, 0]]), "which has no direction"),
    "one axis": (bad([X_AXIS, [*ROW, 1, 0, 0, "", "", ""]]), "found 1 of the local axes, expected two"),
    "axes and angles": (
        bad([[*X_AXIS, "roll [deg]"], [*ROW, 1, 0, 0, 0, 1, 0, 3]]),
        "vectors and angles",
    ),
    "an elastic centre outside": (
        bad([[*HEADER, "elastic_center"], [*ROW, 1.5]]),
        "expected 0 (at the first end) to 1",
    ),
    "a cell too many": (bad([HEADER, [*ROW, 5]]), "line 2: found 10 cells, expected 9"),
    "a quote that does not end": (
        lambda path: path.write_text('name,"kx\n1,2\n'),
        "a quote does not end",
    ),
    "a property file that is not there": (
        cell("property", "c.bus", [*HEADER[:6], "property", *HEADER[7:]]),
        "rates beside it",
    ),
    "a property file outside": (
        bad([[*HEADER[:6], "property"], [*ROW[:6], "../c.bus"]]),
        "expected a file inside",
    ),
    "a name of a body": (bad([[*HEADER, "group"], [*ROW, "block"]]), "has the name of a body"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_table_is_refused_in_one_sentence_and_changes_nothing(block, tmp_path, capsys, name):
    write, expected = BAD[name]
    path = tmp_path / "m.csv"
    write(path)
    before = {p.name: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
    assert main(["import", str(path), "--output", str(block)]) == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert "m.csv" in error
    assert expected in error
    assert {p.name: p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()} == before


def test_a_place_beyond_the_reach_of_attachments_is_refused_with_how_far_it_is(pair, tmp_path, capsys):
    rows = [["a", "upper", "ground", *(place(11) - [300, 0, 0]), 1, 1, 1]]
    path = written(tmp_path / "m.csv", [HEADER, *rows])
    assert main(["import", str(path), "--output", str(pair)]) == 2
    error = capsys.readouterr().err
    assert "line 2, column body_1" in error
    assert "300 mm from '11', the nearest attachment of 'upper'; expected at most 100 mm" in error


def test_an_attachment_that_two_bodies_have_needs_its_body(pair, tmp_path, capsys):
    path = written(
        tmp_path / "m.csv", [["name", "node 1", "body_2", "kx [N/m]"], ["a", 11, "ground", 1]]
    )
    assert main(["import", str(path), "--output", str(pair)]) == 2
    assert "upper, lower have an attachment '11' each; name the body too" in capsys.readouterr().err


def test_what_the_vehicle_has_already_is_refused(block, tmp_path, capsys):
    path = written(tmp_path / "m.csv", [[*HEADER, "group"], [*ROW, "M"]])
    imported(path, block)
    assert main(["import", str(path), "--output", str(block)]) == 2
    assert "has a connection 'a' already" in capsys.readouterr().err
    other = written(tmp_path / "n.csv", [[*HEADER, "group"], ["b", *ROW[1:], "M"]])
    assert main(["import", str(other), "--output", str(block)]) == 2
    assert "has a mount group 'M' already" in capsys.readouterr().err


def test_a_folder_without_bodies_is_refused(tmp_path, capsys):
    path = written(tmp_path / "m.csv", [HEADER, ROW])
    assert main(["import", str(path), "--output", str(tmp_path / "new")]) == 2
    assert "import the bodies first" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("m.xls", b"\xd0\xcf\x11\xe0", "save it as .xlsx or .csv"),
        ("m.xlsx", b"PK\3\4 cut", "damaged"),
        ("m.xlsx", b"name,kx\n", "damaged"),
    ],
)
def test_a_bad_workbook_is_refused(tmp_path, name, content, expected):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(VehicleError, match=expected):
        read(tmp_path / name)


def test_a_workbook_without_its_reader_says_what_to_install(tmp_path, monkeypatch):
    Workbook().save(tmp_path / "m.xlsx")
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(VehicleError, match=r"pip install 'modeviz\[excel\]', or save it as .csv"):
        read(tmp_path / "m.xlsx")


def test_a_workbook_that_would_fill_the_memory_is_refused(tmp_path):
    import zipfile

    path = tmp_path / "m.xlsx"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/worksheets/sheet1.xml", b" " * 250_000_000)
    with pytest.raises(VehicleError, match="bytes unpacked, expected at most 100,000,000"):
        read(path)


@pytest.mark.parametrize("header", ["eta [%]", "eta"])
def test_a_loss_factor_with_a_percent_sign_is_that_whatever_its_header_says(tmp_path, header):
    (found,) = read(written(tmp_path / "m.csv", [[*HEADER, header], [*ROW, "12 %"]]))
    assert found.loss_factor == pytest.approx(0.12)
    book = Workbook()
    book.active.append([*HEADER, header])
    book.active.append([*ROW, 0.12])
    book.active.cell(2, len(ROW) + 1).number_format = "0%"
    book.save(tmp_path / "m.xlsx")
    (found,) = read(tmp_path / "m.xlsx")
    assert found.loss_factor == pytest.approx(0.12)


@pytest.mark.parametrize("arguments", [["view", "m.csv"], ["import", "m.csv", "cab.op2"]])
def test_a_table_of_mounts_among_files_of_a_body_is_said_to_be_one(
    tmp_path, monkeypatch, capsys, arguments
):
    monkeypatch.chdir(tmp_path)
    written(Path("m.csv"), [HEADER, ROW])
    assert main(arguments) == 2
    assert "m.csv: is a table of mounts; import the bodies first" in capsys.readouterr().err


def test_a_table_of_nodes_is_none_of_mounts(tmp_path):
    assert not is_mount_table(written(tmp_path / "n.csv", [["id", "x", "y", "z"], [1, 0, 0, 0]]))


def test_more_mounts_than_a_vehicle_has_are_refused_at_once(tmp_path):
    rows = [HEADER, *([f"m{i}", *ROW[1:]] for i in range(2001))]
    with pytest.raises(VehicleError, match="lines, expected at most 2,001"):
        read(written(tmp_path / "m.csv", rows))
    book = Workbook(write_only=True)
    sheet = book.create_sheet()
    for row in rows:
        sheet.append(row)
    book.save(tmp_path / "m.xlsx")
    with pytest.raises(VehicleError, match="lines, expected at most 2,001"):
        read(tmp_path / "m.xlsx")


def test_a_workbook_with_a_line_far_below_is_refused_at_once(tmp_path):
    book = Workbook()
    book.active.append(HEADER)
    book.active.append(ROW)
    book.active.cell(1_048_576, 1).value = "x"
    book.save(tmp_path / "m.xlsx")
    start = time.process_time()
    with pytest.raises(VehicleError, match=r"m.xlsx: found 10,001 lines, expected at most"):
        read(tmp_path / "m.xlsx")
    assert time.process_time() - start < 10


def test_a_formula_whose_value_is_not_stored_is_said_to_be_one(tmp_path):
    book = Workbook()
    for row in (HEADER, [*ROW[:8], "=2*A1"]):
        book.active.append(row)
    book.save(tmp_path / "m.xlsx")
    with pytest.raises(VehicleError, match=r"line 2, column k_z \[N/mm\]: found '=2\*A1', a formula"):
        read(tmp_path / "m.xlsx")


def test_line_ends_of_windows_stay_where_units_and_tables_are_added(block, tmp_path):
    toml = block / "vehicle.toml"
    before = toml.read_bytes().replace(b"\n", b"\r\n")
    toml.write_bytes(before)
    rows = [[*HEADER, "k_rx [N m/rad]"], [*ROW, 3]]
    assert imported(written(tmp_path / "m.csv", rows), block).mounts
    after = toml.read_bytes().replace(b'rotational_stiffness = "N m/rad"\n', b"", 1)
    assert after.startswith(before)


def test_units_that_cannot_be_added_are_asked_for(tmp_path, capsys):
    folder = tmp_path / "v"
    folder.mkdir()
    text = BLOCK.format(axes="").split("[units]")[0]
    units = 'units = { length = "m", mass = "kg", inertia = "kg m²" }\n'
    (folder / "vehicle.toml").write_text(text + units + BLOCK[BLOCK.index("[[rigid") :])
    path = written(tmp_path / "m.csv", [HEADER, ROW])
    assert main(["import", str(path), "--output", str(folder)]) == 2
    assert 'write stiffness = "N/mm" into it' in capsys.readouterr().err


@pytest.mark.parametrize(
    ("bounds", "words"),
    [
        (("400", ""), "line 2, column stiffest_c_z [N s/m]: empty, expected the other bound too"),
        (("900", "400"), "line 2, column stiffest_c_z [N s/m]: found 400, expected more than"),
    ],
)
def test_bounds_of_a_damper_are_two_and_in_order(bounds, words, tmp_path):
    header = [*HEADER, "c_z [N s/m]", "softest_c_z [N s/m]", "stiffest_c_z [N s/m]"]
    line = ["D", "cab", "frame", "0", "0", "0", "0", "0", "0", "800", *bounds]
    with pytest.raises(VehicleError) as error:
        read(written(tmp_path / "mounts.csv", [header, line]))
    assert words in str(error.value)
