"""The vehicle folder: what is written comes back, and what is wrong in it is said."""

import contextlib
import dataclasses
import json
import re
import tomllib
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from builtin_truck import builtin_truck
from folders import flexible_body, one_of_everything, part

from modeviz.errors import VehicleError
from modeviz.files import builtin_vehicle, read_vehicle, write_vehicle
from modeviz.files import folder as folder_module
from modeviz.files.meshes import read_mesh, write_mesh
from modeviz.files.schema.scaling import written
from modeviz.vehicle.bodies import FlexibleBody, Material, RigidBody
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

RNG = np.random.default_rng(0)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(one_of_everything(), tmp_path / "truck")
    return tmp_path / "truck"


def edit(folder: Path, old: str, new: str) -> None:
    """Changes the first `old` of vehicle.toml."""
    path = folder / "vehicle.toml"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))


def complaint(folder: Path) -> str:
    with pytest.raises(VehicleError) as caught:
        read_vehicle(folder)
    return str(caught.value)


def said_of(folder: Path) -> str:
    """What reading a folder has to note or to complain about."""
    try:
        return " ".join(read_vehicle(folder).notes)
    except VehicleError as error:
        return str(error)


def content(folder: Path) -> dict[str, bytes]:
    return {
        str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()
    }


def assert_same(found, expected) -> None:
    """Equal to the last bit, dataclasses field by field."""
    assert type(found) is type(expected)
    if dataclasses.is_dataclass(expected):
        for field in dataclasses.fields(expected):
            assert_same(getattr(found, field.name), getattr(expected, field.name))
    elif isinstance(expected, tuple):
        assert len(found) == len(expected)
        for pair in zip(found, expected, strict=True):
            assert_same(*pair)
    elif isinstance(expected, dict):
        assert list(found) == list(expected)
        for key in expected:
            assert_same(found[key], expected[key])
    elif isinstance(expected, np.ndarray):
        assert found.dtype == expected.dtype
        np.testing.assert_array_equal(found, expected)
    else:
        assert found == expected


def test_vehicle_comes_back_to_the_last_bit(folder):
    assert_same(replace(read_vehicle(folder), file=""), one_of_everything())


def test_display_mesh_keeps_names_order_and_materials(folder):
    mesh = read_vehicle(folder).body("cab").mesh
    assert [(p.name, p.material.opacity) for p in mesh] == [("skin", 1.0), ("door, left", 0.4)]


def test_every_srgb_colour_survives_linear_light(tmp_path):
    levels = [(n, 255 - n, (7 * n) % 256) for n in range(256)]
    mesh = tuple(replace(part(str(n), RNG), material=Material(c)) for n, c in enumerate(levels))
    write_mesh(tmp_path / "a.glb", mesh)
    assert [p.material.color for p in read_mesh(tmp_path / "a.glb")] == levels


def test_gltf_has_linear_colours_as_its_standard_says(tmp_path):
    write_mesh(tmp_path / "a.glb", (replace(part("a", RNG), material=Material((188, 0, 255))),))
    data = (tmp_path / "a.glb").read_bytes()
    tree = json.loads(data[20 : 20 + int.from_bytes(data[12:16], "little")])
    factor = tree["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
    # IEC 61966-2-1: sRGB 188 is 50.3 % of white
    np.testing.assert_allclose(factor, [0.5029, 0, 1, 1], atol=5e-5)


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".ply"])
def test_other_mesh_files_are_read_with_the_colour_of_the_toml(folder, suffix):
    surface = trimesh.creation.box((1.0, 2.0, 3.0))
    surface.export(folder / f"meshes/cab{suffix}")
    edit(folder, 'cab.glb"', f'cab{suffix}"\ncolor = [1, 2, 3]')
    (read,) = read_vehicle(folder).body("cab").mesh
    assert read.material.color == (1, 2, 3)
    np.testing.assert_array_equal(read.vertices[read.faces], surface.vertices[surface.faces])


def test_writing_twice_gives_the_same_bytes_wherever_the_numbers_come_from(folder, tmp_path):
    write_vehicle(read_vehicle(folder), tmp_path / "again")
    assert content(folder) == content(tmp_path / "again")


def test_bytes_do_not_depend_on_how_arrays_lie_in_memory(folder, tmp_path):
    vehicle = one_of_everything()
    cab = replace(flexible_body(), shapes=np.asfortranarray(flexible_body().shapes))
    write_vehicle(replace(vehicle, bodies=(cab, vehicle.bodies[1])), tmp_path / "x")
    assert content(tmp_path / "x") == content(folder)


@pytest.mark.parametrize("home", ["site/modeviz", "site"])
def test_the_truck_is_found_in_an_installed_package_and_in_a_checkout(monkeypatch, tmp_path, home):
    truck = tmp_path / home / "assets" / "truck"
    truck.mkdir(parents=True)
    (truck / "vehicle.toml").touch()
    monkeypatch.setattr(folder_module, "__file__", str(tmp_path / "site/modeviz/files/folder.py"))
    assert builtin_vehicle() == truck


def test_builtin_truck_is_a_vehicle_folder():
    assert builtin_truck().tyres


def test_archive_of_modes_has_no_date_of_its_own(folder):
    with zipfile.ZipFile(folder / "bodies/cab.npz") as archive:
        assert {info.date_time for info in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_names_of_any_characters_come_back(tmp_path):
    name = "".join(map(chr, range(0x300)))
    write_vehicle(replace(one_of_everything(), name=name, rate_sets={name: {}}), tmp_path / "a")
    vehicle = read_vehicle(tmp_path / "a")
    assert vehicle.name == name
    assert list(vehicle.rate_sets) == [name]


def test_file_is_in_the_units_it_names(folder):
    data = tomllib.loads((folder / "vehicle.toml").read_text())
    assert data["units"]["stiffness"] == "N/mm"
    assert data["mount_group"][0]["rates"] == {
        "vertical": 1094.0,
        "lateral": 670.0,
        "fore_aft": 131 / 3,
    }
    assert [w["amplitude"] for w in data["wheel_load"]] == [12.3, 35.6]  # g m and N
    assert data["road"][0]["speed"] == 72.0
    assert data["rates"]["optimised"]["C1"]["loss_factor"] == 0.1


def numbers(vehicle: Vehicle) -> dict[str, list[np.ndarray]]:
    """What of the vehicle each quantity is."""
    body = vehicle.body("Engine & box")
    assert isinstance(body, RigidBody)
    joints, tyre, group = vehicle.connections, vehicle.tyres[0], vehicle.mount_groups[0]
    rates = [group.rates, *group.bounds, vehicle.rate_sets["optimised"]["C1"]]
    values = {
        "length": [
            body.center_of_gravity,
            joints[0].points,
            joints[1].points,
            vehicle.added_masses[0].position,
            vehicle.response_points[0].position,
            tyre.wheel_center,
            tyre.trail,
            *map(np.array, group.travel.values()),
            group.curves["lateral"].deflection,
            vehicle.load_cases[1].loads[1].position,
        ],
        "mass": [body.mass, vehicle.added_masses[0].mass],
        "inertia": [body.inertia],
        "stiffness": [*(c.stiffness for c in joints), *(r.as_tuple() for r in rates)],
        "rotational_stiffness": [joints[2].rotational_stiffness],
        "damping": [joints[1].damping, joints[3].damping],
        "force": [
            vehicle.wheel_loads[1].amplitude,
            group.curves["lateral"].force,
            vehicle.load_cases[1].loads[1].force,
        ],
        "torque": [vehicle.load_cases[1].loads[0].torque],
        "unbalance": [vehicle.wheel_loads[0].amplitude],
        "speed": [vehicle.speed, vehicle.roads[0].speed],
    }
    return {quantity: [np.asarray(v) for v in found] for quantity, found in values.items()}


@pytest.mark.parametrize(
    ("quantity", "unit", "ratio"),
    [
        ("length", "mm", 1e-3),
        ("mass", "lb", 0.45359237),
        ("inertia", "kg mm²", 1e-6),
        ("stiffness", "N/m", 1e-3),
        ("rotational_stiffness", "N mm/rad", 1e-3),
        ("damping", "N s/mm", 1e3),
        ("force", "kN", 1e3),
        ("torque", "kN m", 1e3),
        ("unbalance", "g mm", 1e-3),
        ("speed", "m/s", 3.6),
    ],
)
def test_unit_scales_its_quantity_and_nothing_else(folder, quantity, unit, ratio):
    before = numbers(read_vehicle(folder))
    path = folder / "vehicle.toml"
    path.write_text(
        re.sub(rf'\n{quantity} = ".*"', f'\n{quantity} = "{unit}"', path.read_text(), count=1)
    )
    for name, found in numbers(read_vehicle(folder)).items():
        for value, old in zip(found, before[name], strict=True):
            expected = old * (ratio if name == quantity else 1)
            np.testing.assert_allclose(value, expected, rtol=1e-15 if name == quantity else 0)


def test_number_in_another_unit_is_short_and_within_one_rounding():
    assert written(20.0, 1 / 3.6) == 72.0
    assert written(131e3, 1e3) == 131.0
    assert written(0.0123, 1e-3) == 12.3
    for value in np.random.default_rng(4).lognormal(size=1000):
        assert abs(written(value, 1e3) * 1e3 - value) <= np.spacing(value)


def test_what_means_nothing_need_not_be_said(folder):
    text = (folder / "vehicle.toml").read_text()
    text = re.sub(r"^(role|label|group|speed = 8\d|softest|stiffest).*\n", "", text, flags=re.MULTILINE)
    (folder / "vehicle.toml").write_text(text)
    vehicle = read_vehicle(folder)
    assert [(b.role, b.label) for b in vehicle.bodies] == [("other", b.name) for b in vehicle.bodies]
    groups = [connection.group for connection in vehicle.connections]
    assert groups == ["springs", "rods", "bolts", "dampers", "tyres"]
    assert vehicle.roads[0].label == "road 1"
    assert vehicle.speed == 20.0
    (group,) = vehicle.mount_groups
    own = np.array(group.rates.as_tuple())
    softest, stiffest = (rates.as_tuple() for rates in group.bounds)
    assert group.label == "C1"
    np.testing.assert_allclose(softest, own / 4, rtol=1e-15)
    np.testing.assert_allclose(stiffest, own * 4, rtol=1e-15)


@pytest.mark.parametrize(
    ("rates", "stiffest"),
    [((0.0, 1e5, 4e5), (16e5, 4e5, 16e5)), ((0.0, 0.0, 0.0), (4e6, 4e6, 4e6))],
)
def test_a_rate_of_zero_may_rise(rates, stiffest):
    bounds = usual_bounds(MountRates(*rates))
    assert bounds[0].as_tuple() == tuple(rate / 4 for rate in rates)
    assert bounds[1].as_tuple() == stiffest


@pytest.mark.parametrize(
    ("keys", "columns"),
    [
        ("keep_modes = 7", [*range(7), 9, 10]),
        ("keep_modes = 7\nresidual_vectors = false", range(7)),
        ("residual_vectors = false", range(9)),
    ],
)
def test_modes_to_keep_choose_the_columns(folder, keys, columns):
    edit(folder, "damping_ratio", f"{keys}\ndamping_ratio")
    found, whole = read_vehicle(folder).body("cab"), flexible_body()
    assert isinstance(found, FlexibleBody)
    np.testing.assert_array_equal(found.omega_n_squared, whole.omega_n_squared[columns])
    np.testing.assert_array_equal(found.shapes, whole.shapes[:, :, columns])
    assert found.n_residuals == (0 if "false" in keys else 2)


def test_products_of_inertia_are_plus_integrals(folder):
    """A pair of masses at ±(1, 1, 0) has Ixy = +∫ xy dm = 2 m, so -2 m in the matrix."""
    edit(folder, "inertia = [12.6, 29.6, 20.3, 0.3, -1.7, 0.0]", "inertia = [3, 3, 5, 2, 0, 0]")
    body = read_vehicle(folder).body("Engine & box")
    assert isinstance(body, RigidBody)
    np.testing.assert_array_equal(body.inertia, [[3, -2, 0], [-2, 3, 0], [0, 0, 5]])


EDITS = {
    "negative rate": (
        "vertical = 1094.0",
        "vertical = -5",
        "mount_group[0].rates.vertical: found -5, expected a number of zero or more",
    ),
    "text for a number": ("1094.0", '"hard"', "rates.vertical: found 'hard', expected a number"),
    "truth for a number": ("1094.0", "true", "rates.vertical: found True, expected a number"),
    "not a number": ("1094.0", "nan", "mount_group[0].rates.vertical: found nan, expected a finite"),
    "infinite": ("1094.0", "inf", "mount_group[0].rates.vertical: found inf, expected a finite"),
    "beyond float": ("1094.0", "9" * 400, "rates.vertical: found 9999"),
    "beyond int": ("1094.0", "9" * 5000, "not TOML: it has a whole number of more than 4,300"),
    "mass not positive": ("240.5", "0", "rigid_body[0].mass: found 0, expected a number above zero"),
    "unknown key": (
        "damping_ratio",
        "damping_ratios",
        "flexible_body[0].damping_ratios: unknown key 'damping_ratios': did you mean 'damping_ratio'?",
    ),
    "unknown table": ("[[bolt]]", "[[bolts]]", "bolts: unknown key 'bolts': did you mean 'bolt'?"),
    "missing key": ("damping_ratio = 0.03", "", "flexible_body[0].damping_ratio: missing"),
    "unknown role": (
        '"cabin"',
        '"cabim"',
        "flexible_body[0].role: unknown value 'cabim': did you mean 'cabin'? there are cabin, frame",
    ),
    "unknown load": (
        'kind = "unbalance"',
        'kind = "imbalance"',
        "wheel_load[0].kind: unknown value 'imbalance': did you mean 'unbalance'? there are",
    ),
    "two coordinates": ("at = [0.01, -0.02, 0.03]", "at = [1, 2]", "added_mass[0].at: found [1, 2]"),
    "half a place": (
        "at = [[0.0, 0.0, 0.0], [0.0, 0.1, 0.7]]",
        "at = [[0, 0, 0], 1]",
        "spring[0]: at: found [(0.0, 0.0, 0.0), 1.0], expected [x, y, z] or two of them",
    ),
    "beyond its ends": (
        "elastic_center = 0.3",
        "elastic_center = 1.3",
        "spring[0]: connection 'arm': elastic_center: found 1.3, expected 0 (at the first of its ends)",
    ),
    "a rod of no length": (
        "at = [[0.0, 0.0, 0.0], [0.0, 0.1, 0.7]]\nstiffness = 13000.0",
        "at = [[0, 0, 0], [0, 0, 0]]\nstiffness = 13000.0",
        "rod[0]: rod 'rod': found both ends at [0.0, 0.0, 0.0], expected two places",
    ),
    "a rod in one place": (
        "at = [[0.0, 0.0, 0.0], [0.0, 0.1, 0.7]]\nstiffness = 13000.0",
        "at = [0, 0, 0]\nstiffness = 13000.0",
        "rod[0].at: found [0, 0, 0], expected a list",
    ),
    "four moments": (", 0.3, -1.7, 0.0]", ", 0.3]", "inertia: found 4 numbers, expected 3 or 6"),
    "impossible inertia": ("12.6, 29.6", "-1, 29.6", "rigid_body[0]: body 'Engine & box': inertia"),
    "unknown unit": (
        '"N/mm"',
        '"N/mmm"',
        "unknown unit of stiffness 'N/mmm': did you mean",
    ),
    "unit of something else": ('"N/mm"', '"kg"', "units.stiffness: unknown unit of stiffness 'kg'"),
    "unknown quantity": (
        "stiffness =",
        "stifness =",
        "units.stifness: unknown quantity 'stifness': did you mean 'stiffness'? there are length, mass",
    ),
    "no unit": (
        'stiffness = "N/mm"\n',
        "",
        "units.stiffness: missing, expected one of N/m, N/mm, N/cm, kN/mm",
    ),
    "unit that is no text": ('"N/mm"', "3", "units.stiffness: found 3, expected text"),
    "units that are no table": (
        "[units]",
        "units = 3\n[other]",
        "units: found 3, expected a table",
    ),
    "unknown body": (
        'body = "cab"',
        'body = "cob"',
        "added mass 'driver': unknown body 'cob': did you mean 'cab'? there are cab, Engine & box",
    ),
    "unknown body in a connection": (
        'bodies = ["cab"',
        'bodies = ["Cob"',
        "connection 'C1 left': unknown body 'Cob': did you mean 'cab'?",
    ),
    "joined to itself": ('["cab", "Engine & box"]', '["cab", "cab"]', "joins 'cab' to itself"),
    "one body": (
        '["cab", "Engine & box"]',
        '["cab"]',
        "mount[0].bodies: found ['cab'], expected a list",
    ),
    "far from everything": ("[0.01, -0.02, 0.03]", "[9, 0, 0]", "8.91 m from the nearest attachment"),
    "unknown tyre": (
        'tyre = "tyre left"',
        'tyre = "tyre rihgt"',
        "wheel load 'unbalance left': unknown tyre 'tyre rihgt': did you mean 'tyre left'?",
    ),
    "tyre twice": ('"shock"', '"arm"', "connection 'arm' is there twice"),
    "body twice": ('name = "Engine & box"', 'name = "cab"', "body 'cab' is there twice"),
    "no name": ('name = "driver"', 'name = ""', "added_mass[0].name: found '', expected text"),
    "too many modes": ("damping_ratio", "keep_modes = 10\ndamping_ratio", "found 10, expected 6 to 9"),
    "too few modes": (
        "damping_ratio",
        "keep_modes = 5\ndamping_ratio",
        "flexible_body[0].keep_modes: body 'cab': modes to keep: found 5, expected 6 to 9",
    ),
    "overdamped": ("0.03", "1.5", "damping_ratio: found 1.5, expected a fraction of critical"),
    "bounds the wrong way round": ("lateral = 2000.0", "lateral = 1", "bounds: lateral: found 100 to"),
    "unknown group in a set": ("C1 = {", "C9 = {", "rates 'optimised': unknown mount group 'C9'"),
    "negative rate in a set": (
        "lateral = 131.0",
        "lateral = -131.0",
        "rates.optimised.C1.lateral: found -131.0, expected a number of zero or more",
    ),
    "rates that are no table": ("C1 = {", "C1 = 3 #", "rates.optimised.C1: found 3, expected a table"),
    "missing mesh": ("meshes/cab.glb", "meshes/cob.glb", "meshes/cob.glb: there is no such file"),
    "mesh of another kind": ("meshes/cab.glb", "bodies/cab.npz", "expected one of .glb, .stl, .obj"),
    "missing modes": ("bodies/cab.npz", "bodies/cob.npz", "bodies/cob.npz: there is no such file"),
    "missing road": ("roads/road_1.csv", "roads/x.csv", "roads/x.csv: there is no such file"),
    "mesh outside": ("meshes/cab.glb", "../../x.glb", "flexible_body[0].mesh: found '../../x.glb'"),
    "modes outside": ("bodies/cab.npz", "/etc/passwd", "flexible_body[0].modes: found '/etc/passwd'"),
    "road outside": ("roads/road_1.csv", "roads/../../x", "road[0].file: found 'roads/../../x'"),
    "a case of nothing": (
        "load_g = [-0.5, 0.0, -3.0]",
        "load_g = [0, 0, 0]",
        "load_case[0]: load case 'pothole': nothing acts in it, expected a load",
    ),
    "a load on nobody": (
        'body = "Engine & box"\ntorque',
        'body = "Engine"\ntorque',
        "load case 'forward torque': unknown body 'Engine': did you mean 'Engine & box'?",
    ),
    "no unit of torque": ('torque = "N m"\n', "", "units.torque: missing, expected one of N m, kN m"),
    "travel the wrong way round": (
        "[-0.0085, 0.005]",
        "[0.005, -0.0085]",
        "mount group 'C1': travel: vertical: found 5 to -8.5 mm, expected the least first",
    ),
    "a curve that falls back": (
        "force = [-5000.0, -1000.0, 2500.0,",
        "force = [-5000.0, -1000.0, -1000.0,",
        "mount_group[0].curve[0].force[2]: is not above the value before it; deflections and forces",
    ),
    "a curve of fewer forces": (
        "force = [-5000.0, -1000.0, 2500.0,",
        "force = [-5000.0, -1000.0,",
        "mount_group[0].curve[0]: found 4 deflections and 3 forces, expected as many",
    ),
    "two curves of a direction": (
        "[[mount_group.curve]]",
        "[[mount_group.curve]]\ndirection = 'lateral'\ndeflection = [0, 1]\nforce = [0, 1]\n\n"
        "[[mount_group.curve]]",
        "mount_group[0]: curve of 'lateral' is there twice",
    ),
    "a curve of nothing": (
        "deflection = [-0.01",
        "#",
        "mount_group[0].curve[0]: found 0 deflections and 4 forces, expected as many",
    ),
    "a curve in a file and here": (
        "deflection = [-0.01",
        "file = 'x.csv'\ndeflection = [-0.01",
        "mount_group[0].curve[0]: expected either file, or deflection and force",
    ),
    "no rate and no curve": (
        "vertical = 1094.0, ",
        "",
        "mount_group[0].rates.vertical: missing; only a direction that has a [[mount_group.curve]]",
    ),
    "no static ratio": ("static_ratio = 1.45", "static_ratio = 0", "static_ratio: found 0, expected"),
    "file name with a zero": ("roads/road_1.csv", "a\\u0000b", "road[0].file: found 'a\\x00b'"),
    "folder for a file": ("bodies/cab.npz", "bodies", "bodies: cannot be read"),
    "broken TOML": ("speed = 8", "speed = = 8", "not TOML: Invalid value (at line 2, column 9)"),
}


@pytest.mark.parametrize("case", EDITS)
def test_wrong_vehicle_file_is_explained(folder, case):
    old, new, words = EDITS[case]
    edit(folder, old, new)
    text = complaint(folder)
    assert text.startswith(f"{folder / 'vehicle.toml'}: ")
    assert words in text
    assert "\n" not in text


def test_folder_that_is_no_vehicle_is_told_what_one_is(tmp_path):
    assert complaint(tmp_path).startswith(f"{tmp_path}: found no vehicle.toml; a vehicle is a folder")
    nowhere = tmp_path / "nowhere"
    assert complaint(nowhere) == f"{nowhere}: there is no such folder"


def test_bytes_that_are_no_text_are_refused(folder):
    (folder / "vehicle.toml").write_bytes(b'name = "\xff"')
    assert "vehicle.toml: found bytes that are not UTF-8 text" in complaint(folder)


def resave(folder: Path, **arrays: np.ndarray | None) -> None:
    """Changes arrays of the cab's modes file, or leaves them out."""
    path = folder / "bodies/cab.npz"
    with np.load(path) as old:
        new = {k: v for k, v in ({**old} | arrays).items() if v is not None}
    np.savez(path, **new)


def test_modes_saved_by_numpy_are_read(folder):
    resave(folder)
    assert_same(replace(read_vehicle(folder), file=""), one_of_everything())


SHAPES = flexible_body().shapes


@pytest.mark.parametrize(
    ("arrays", "words"),
    [
        ({"nodes": None}, "nodes: missing; there are omega_n_squared, n_residuals"),
        (
            {"shapes": np.where(np.arange(11) == 8, np.nan, SHAPES)},
            "shapes: found 30 values that are not",
        ),
        ({"shapes": SHAPES[:, :2]}, "shapes: found shape (5, 2, 11), expected 5 x 6 x 11"),
        (
            {"shapes": SHAPES + 0j},
            "shapes: found complex64 in 3 dimensions, expected real numbers in 3",
        ),
        ({"nodes": np.array([[None, {}]])}, "nodes: Object arrays cannot be loaded when allow_pickle"),
        ({"n_residuals": np.array(6)}, "n_residuals: found 6 with 11 modes, expected 0 to 5"),
        ({"n_residuals": np.array([2])}, "n_residuals: found int64 in 1 dimensions, expected whole"),
        ({"omega_n_squared": np.ones(11)}, "omega_n_squared: expected six zeros, then positive values"),
        ({"omega_n_squared": np.zeros(11)}, "omega_n_squared: expected six zeros, then positive"),
        ({"attachment_names": np.array(["a"])}, "expected one row for each attachment"),
        ({"attachment_names": np.array(["a", "a"])}, "attachment 'a' is there twice"),
        ({"attachment_positions": np.zeros((2, 2))}, "position: found shape (2,), expected 3"),
    ],
)
def test_wrong_array_is_explained(folder, arrays, words):
    resave(folder, **arrays)
    assert f"{folder}/vehicle.toml: flexible_body[0].modes: {folder}/bodies/cab.npz: " in complaint(
        folder
    )
    assert words in complaint(folder)


@pytest.mark.parametrize("name", ["bodies/cab.npz", "meshes/cab.glb"])
def test_file_cut_anywhere_is_refused(folder, name):
    whole = (folder / name).read_bytes()
    for length in (*range(0, len(whole), max(len(whole) // 50, 1)), len(whole) - 1):
        (folder / name).write_bytes(whole[:length])
        assert f"{folder / name}: " in complaint(folder)


def test_road_cut_within_a_line_is_refused_or_pointed_out(folder):
    path = folder / "roads/road_1.csv"
    whole = path.read_bytes()
    for length in range(0, len(whole), max(len(whole) // 50, 1)):
        path.write_bytes(whole[:length])
        if whole[:length].endswith(b"\n"):
            continue
        said = said_of(folder)
        assert f"{path}: " in said or "the last line does not end; the file may be cut" in said


@pytest.mark.parametrize(
    "name", ["bodies/cab.npz", "meshes/cab.glb", "roads/road_1.csv", "vehicle.toml"]
)
def test_damaged_file_never_raises_anything_else(folder, name):
    rng = np.random.default_rng(3)
    whole = (folder / name).read_bytes()
    for place in rng.integers(0, len(whole), 100):
        damaged = bytearray(whole)
        damaged[place] ^= int(rng.integers(1, 256))
        (folder / name).write_bytes(damaged)
        with contextlib.suppress(VehicleError):
            read_vehicle(folder)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("frequency_hz,", "hz,", "line 1: unknown column 'hz': there are frequency_hz, left"),
        (
            "left,right,",
            "left,",
            "left,cross_real,cross_imag', without right; expected",
        ),
        ("left,right,", "left,left,", "line 1: column left is there twice"),
        ("\n", "\n1,2,3\n", "line 2: found 3 cells, expected 5"),
        ("\n", "\n0.1,a,b,c,d\n", "line 2, column left: found 'a', expected a number"),
        ("\n", "\n0.1,1e-9,1e-9,nan,0\n", "line 2, column cross_real: found 'nan', expected a finite"),
        (
            "\n",
            "\n0.1,1e-9,1e-9,2e-9,0\n",
            "line 2, columns cross_real and cross_imag: found a",
        ),
        ("\n", "\n0.1,-1e-9,1e-9,0,0\n", "line 2, column left: found -1e-9, expected zero or more"),
        ("\n", "\n7,1e-9,1e-9,0,0\n", "line 3, column frequency_hz: found 0.3333333333333333 after 7"),
        ("left,", "left (mm²),", "column left: found the unit 'mm²', expected one of m²/Hz, mm²/Hz,"),
        ("left,", "left (kg²/Hz),", "column left: found the unit 'kg²/Hz', expected one of m²/Hz"),
    ],
)
def test_wrong_road_is_explained(folder, old, new, words):
    path = folder / "roads/road_1.csv"
    path.write_text(path.read_text().replace(old, new, 1))
    assert f"road[0].file: {path}: " in complaint(folder)
    assert words in complaint(folder)


def test_vehicle_is_replaced_as_a_whole(folder, tmp_path):
    vehicle = one_of_everything()
    smaller = replace(vehicle, bodies=(replace(flexible_body(), mesh=()), vehicle.bodies[1]))
    write_vehicle(smaller, folder)
    assert_same(replace(read_vehicle(folder), file=""), smaller)
    assert "meshes/cab.glb" not in content(folder)
    assert [p.name for p in tmp_path.iterdir()] == ["truck"]


@pytest.mark.parametrize("stranger", ["notes.txt", "vehicle.toml/notes.txt"])
def test_folder_of_something_else_is_not_overwritten(tmp_path, stranger):
    path = tmp_path / stranger
    path.parent.mkdir(exist_ok=True)
    path.write_text("mine")
    with pytest.raises(VehicleError, match="not overwritten"):
        write_vehicle(one_of_everything(), tmp_path)
    assert path.read_text() == "mine"


def test_vehicle_with_something_else_beside_it_is_not_overwritten(folder):
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(VehicleError, match="not overwritten"):
        write_vehicle(one_of_everything(), folder)


def test_vehicle_that_cannot_be_moved_leaves_the_old_one(folder, monkeypatch):
    before, rename = content(folder), Path.rename

    def refuse_new(path: Path, target: Path) -> Path:
        if path.name == "new":
            raise OSError("device or resource busy")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuse_new)
    with pytest.raises(VehicleError, match="resource busy"):
        write_vehicle(one_of_everything(), folder)
    assert content(folder) == before


def test_file_is_not_overwritten_by_a_vehicle(tmp_path):
    (tmp_path / "a").write_text("mine")
    with pytest.raises(VehicleError, match="not overwritten"):
        write_vehicle(one_of_everything(), tmp_path / "a")


def test_failed_writing_leaves_the_old_vehicle(folder, tmp_path, monkeypatch):
    before = content(folder)

    def full(*_):
        raise OSError("no space left on device")

    monkeypatch.setattr("modeviz.files.folder.write_road", full)
    with pytest.raises(VehicleError, match=r"cannot be written.*no space left"):
        write_vehicle(one_of_everything(), folder)
    assert content(folder) == before
    assert [p.name for p in tmp_path.iterdir()] == ["truck"]


def test_names_that_make_the_same_file_name_get_different_files(tmp_path):
    vehicle = one_of_everything()
    roads = tuple(replace(vehicle.roads[0], name=name) for name in ("a b", "A-b", "é", "ü", "a_b"))
    write_vehicle(replace(vehicle, roads=roads), tmp_path / "x")
    assert len(list((tmp_path / "x/roads").iterdir())) == 5
    assert [r.name for r in read_vehicle(tmp_path / "x").roads] == ["a b", "A-b", "é", "ü", "a_b"]


def test_a_group_may_be_called_loss_factor(tmp_path):
    vehicle = one_of_everything()
    group = replace(vehicle.mount_groups[0], name="loss_factor")
    sets = {"optimised": {"loss_factor": vehicle.rate_sets["optimised"]["C1"]}}
    write_vehicle(replace(vehicle, mount_groups=(group,), rate_sets=sets), tmp_path / "a")
    data = tomllib.loads((tmp_path / "a" / "vehicle.toml").read_text())
    rates = {"vertical": 1000 / 3, "lateral": 131.0, "fore_aft": 0.0, "loss_factor": 0.1}
    assert data["rates"]["optimised"]["loss_factor"] == rates
    assert read_vehicle(tmp_path / "a").rate_sets == sets


def test_a_tyre_between_the_tracks_is_noted_unless_it_says_its_track(folder):
    path = folder / "vehicle.toml"
    assert not any("neither side" in note for note in read_vehicle(folder).notes)
    path.write_text(path.read_text().replace('track = "left"\n', ""))
    (note,) = read_vehicle(folder).notes
    assert note.startswith("tyre 'tyre left' stands on neither side, so it follows the mean of both")
