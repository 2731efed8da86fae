"""[[absorber]] of a vehicle folder."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from small_systems import joined_beams

from modeviz.dynamics.assembly import assemble
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.survey import survey
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_parts import absorbers_of
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.mount_rates import MountRates

ROOF = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)
ROLL = Absorber(
    "roll",
    "chassis",
    (1.0, 0.5, 0.4),
    9.0,
    7.0,
    0.0,
    0.2,
    ("lateral", "fore-aft"),
    frequency_range=(5.0, 9.0),
)  # fmt: skip
TABLE = """
[[absorber]]
name = "roof"
body = "cab"
at = [1.0, 0.2, 1.4]
mass = 6
frequency = 12
damping_ratio = 0.1
"""


@pytest.fixture
def folder(tmp_path):
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    return tmp_path / "cabin"


def add(folder, table):
    file = folder / "vehicle.toml"
    file.write_text(file.read_text("utf-8") + table, "utf-8")


def test_a_table_gives_the_parts_that_python_gives(folder):
    add(folder, TABLE)
    read, made = read_vehicle(folder), with_absorbers(mounted_cabin(), [ROOF])
    for name in ("mass", "stiffness", "damping", "structural_damping"):
        np.testing.assert_allclose(
            getattr(assemble(read), name), getattr(assemble(made), name), rtol=1e-12, atol=1e-12
        )
    assert [body.role for body in read.bodies] == ["cabin", "unsprung", "absorber"]


def test_a_vehicle_is_written_with_tables_of_its_absorbers_as_they_are_tuned(tmp_path):
    made = with_absorbers(mounted_cabin(), [ROOF, ROLL])
    tuned = made.rates["roof"].scaled({"vertical": 1.5, "damping_vertical": 3.0})
    made = made.with_rates({"roof": tuned})
    write_vehicle(made, tmp_path / "v")
    tables = tomllib.loads((tmp_path / "v" / "vehicle.toml").read_text("utf-8"))
    assert [table["name"] for table in tables["absorber"]] == ["roof", "roll"]
    assert tables["absorber"][0]["frequency"] == pytest.approx(12.0 * np.sqrt(1.5))
    assert tables["absorber"][0]["frequency_range"] == pytest.approx([6.0, 24.0])
    ratio = 0.1 / np.sqrt(1.5)  # of what is critical at that frequency
    assert tables["absorber"][0]["damping_ratio"] == pytest.approx(3 * ratio)
    assert tables["absorber"][0]["damping_range"] == pytest.approx([ratio / 4, 4 * ratio])
    assert "directions" not in tables["absorber"][0]
    assert tables["absorber"][1]["directions"] == ["lateral", "fore-aft"]
    assert [table["name"] for table in tables["rigid_body"]] == ["cab", "chassis"]
    read = read_vehicle(tmp_path / "v")
    for name in ("mass", "stiffness", "damping", "structural_damping"):
        np.testing.assert_allclose(
            getattr(assemble(read), name), getattr(assemble(made), name), rtol=1e-12, atol=1e-12
        )
    for one, other in zip(read.mount_groups, made.mount_groups, strict=True):
        assert one.fields == other.fields
        for bound, its in zip(one.bounds, other.bounds, strict=True):
            assert bound.damping() == pytest.approx(its.damping(), rel=1e-12)


@pytest.mark.parametrize("angles", [(0.3, 0.0, 0.0), (0.2, -0.4, 1.1), (1e-9, 0.0, np.pi / 2)])
def test_one_that_is_turned_is_written_as_one_table_and_read_back(tmp_path, angles):
    turned = replace(ROOF, angles=angles)
    made = with_absorbers(mounted_cabin(), [turned])
    (found,) = absorbers_of(made)
    assert found.angles == pytest.approx(angles, abs=1e-12)
    write_vehicle(made, tmp_path / "v")
    tables = tomllib.loads((tmp_path / "v" / "vehicle.toml").read_text("utf-8"))
    assert [table["name"] for table in tables["absorber"]] == ["roof"]
    assert "spring" not in tables
    read = read_vehicle(tmp_path / "v")
    assert absorbers_of(read)[0].angles == pytest.approx(angles, abs=1e-12)
    for name in ("mass", "stiffness", "damping"):
        expected = getattr(assemble(made), name)
        largest = np.abs(expected).max()
        np.testing.assert_allclose(
            getattr(assemble(read), name), expected, rtol=0, atol=1e-12 * largest
        )


def test_a_table_says_how_it_is_turned_as_a_mount_does(folder):
    file = folder / "vehicle.toml"
    file.write_text(file.read_text("utf-8").replace("[units]\n", '[units]\nangle = "deg"\n'), "utf-8")
    add(folder, TABLE + 'angles = [10, 20, 0]\nangle_order = "xyz fixed"\n')
    (found,) = absorbers_of(read_vehicle(folder))
    assert np.degrees(found.angles) == pytest.approx([10, 20, 0])


def test_what_one_table_does_not_say_is_written_as_parts(tmp_path):
    made = with_absorbers(mounted_cabin(), [replace(ROOF, directions=("vertical", "lateral"))])
    uneven = made.with_rates({"roof": MountRates(3e4, 4e4, 0.0)})
    assert absorbers_of(made)
    assert not absorbers_of(uneven)
    write_vehicle(uneven, tmp_path / "v")
    read = read_vehicle(tmp_path / "v")
    assert read.rates["roof"] == uneven.rates["roof"]
    assert read.body("roof mass").role == "absorber"
    np.testing.assert_allclose(assemble(read).stiffness, assemble(uneven).stiffness, rtol=1e-12)


def test_sets_of_rates_and_problems_know_its_group(folder):
    set_of_it = "[rates.softer.roof]\nvertical = 9000\nlateral = 0\nfore_aft = 0\n"
    add(folder, TABLE + set_of_it)
    read = read_vehicle(folder)
    assert read.rate_sets["softer"]["roof"].vertical == 9e6
    damping = read.rates["roof"].damping_vertical
    assert damping > 0
    assert read.rate_sets["softer"]["roof"].damping_vertical == damping


@pytest.mark.parametrize(
    ("old", "new", "key", "words"),
    [
        ("mass = 6", "mass = -6", "absorber[0].mass", "found -6, expected a number above zero"),
        ('body = "cab"', 'body = "cap"', "absorber[0]", "unknown body 'cap': did you mean 'cab'?"),
        ("mass = 6\n", "", "absorber[0].mass", "missing"),
        (
            "frequency = 12",
            "frequency = 0",
            "absorber[0].frequency",
            "found 0, expected a number above zero",
        ),
        ("mass = 6", 'mass = 6\ndirections = ["up"]', "absorber[0]", "unknown direction 'up'"),
        ("mass = 6", "mass = 6\nfrequency_range = [9, 3]", "absorber[0]", "found 9 to 3 Hz"),
        ("mass = 6", "mass = 6\ndamping_range = [0.2, 0.1]", "absorber[0]", "found 0.2 to 0.1"),
        ('name = "roof"', 'name = "A"', "absorber[0]", "there twice"),
        (
            'body = "cab"',
            'body = "ground"',
            "absorber[0]",
            "found 'ground', expected a body, which moves",
        ),
        ('body = "cab"', 'body = "roof mass"', "absorber[0]", "there are cab, chassis"),
    ],
)
def test_what_is_wrong_with_a_table_is_said_at_its_key(folder, old, new, key, words):
    assert old in TABLE
    add(folder, TABLE.replace(old, new))
    with pytest.raises(VehicleError) as caught:
        read_vehicle(folder)
    assert words in str(caught.value)
    (problem,) = survey(folder).problems
    assert problem.key.startswith(key)
    assert words in problem.words


def test_a_part_of_a_taken_name_is_said_of_the_absorber_wherever_the_other_stands(tmp_path):
    cabin = mounted_cabin()
    other = RigidBody("roof mass", "other", "rack", 5.0, np.array([1.0, 0.0, 1.5]), np.eye(3))
    ends = np.tile([1.0, 0.0, 1.0], (2, 1))
    joint = Spring("roof guide", "springs", ("cab", "chassis"), ends, np.full(3, 1e5))
    with_body = replace(cabin, bodies=(*cabin.bodies, other))
    with_joint = replace(cabin, connections=(*cabin.connections, joint))
    for i, vehicle in enumerate((with_body, with_joint)):
        write_vehicle(vehicle, tmp_path / f"{i}")
        add(tmp_path / f"{i}", TABLE)
        (problem,) = survey(tmp_path / f"{i}").problems
        assert problem.key.startswith("absorber[0]")
        assert "absorber 'roof': one of its parts is called 'roof " in problem.words
        with pytest.raises(VehicleError, match="absorber 'roof': one of its parts"):
            with_absorbers(vehicle, [ROOF])


def test_on_a_flexible_body_it_sits_on_the_shapes_of_its_place(tmp_path):
    """Between two nodes of a beam, 6 cm from one: as python puts it there, and as it is written."""
    _, beams = joined_beams()
    write_vehicle(beams, tmp_path / "beams")
    table = TABLE.replace('"cab"', '"rear"').replace("[1.0, 0.2, 1.4]", "[3.06, 0.0, 0.0]")
    add(tmp_path / "beams", table)
    sits = replace(ROOF, body="rear", position=(3.06, 0.0, 0.0))
    made, read = with_absorbers(beams, [sits]), read_vehicle(tmp_path / "beams")
    write_vehicle(made, tmp_path / "made")
    expected = assemble(made).stiffness
    for vehicle in (read, read_vehicle(tmp_path / "made")):
        np.testing.assert_allclose(assemble(vehicle).stiffness, expected, rtol=1e-6, atol=1e-3)
    arm = replace(sits, position=(3.0, 0.0, 0.0))
    assert not np.allclose(assemble(with_absorbers(beams, [arm])).stiffness, expected, rtol=1e-3)
