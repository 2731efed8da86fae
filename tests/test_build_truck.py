"""The built-in pickup: its meshes against the study they come from, its folder, its look."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from builtin_truck import builtin_truck
from pickup import roads
from pickup.dressing.meshes import display_meshes
from pickup.half_mesh import MIRROR
from pickup.lattice import Lattice
from pickup.mounts import OPTIMISED, ORIGINAL
from pickup.parameters import Parameters
from pickup.problem import paper_problem
from pickup.roads import RoadShapes
from pickup.sections import box_member, steel_sheet
from pickup.stiffness import StaticStiffness, static_stiffness
from pickup.vehicle import components, pickup

from modeviz.fem.free import center_of_gravity, free_modes
from modeviz.fem.matrices import assemble
from modeviz.files import builtin_vehicle, write_vehicle
from modeviz.files.meshes import read_mesh
from modeviz.files.records.problems import ProblemRecord
from modeviz.units import factor
from modeviz.vehicle.bodies import FlexibleBody, RigidBody

COUNTS = {
    "front end": (869, 832, 154),
    "cab": (1576, 1509, 324),
    "box": (930, 892, 182),
    "frame": (160, 0, 160),
}
"""Nodes, shells and beams of the right half, from the feasibility study."""


MASSES = {"front end": 115.3, "cab": 305.9, "box": 216.5, "frame": 329.1}
CENTERS = {
    "front end": (-0.451, 0.883),
    "cab": (1.209, 0.932),
    "box": (3.141, 0.859),
    "frame": (1.471, 0.522),
}
"""x and z of the centre of gravity, m."""

ELASTIC_HZ = {
    "front end": (40.4, 71.0, 97.7, 104.4, 110.3, 120.8, 124.4, 130.1),
    "cab": (34.1, 54.0, 56.4, 60.2, 62.7, 69.5, 73.3, 80.5),
    "box": (15.6, 32.1, 35.2, 38.4, 45.3, 51.0, 59.3, 71.3),
    "frame": (8.7, 18.2, 23.7, 47.8, 51.6, 59.0, 72.8, 89.7),
}

STUDY = replace(
    Parameters(),
    front_end_stiffness_factor=1.81567,
    front_end_mass_factor=0.750035,
    cab_stiffness_factor=0.526353,
    cab_mass_factor=1.01877,
    box_stiffness_factor=0.400073,
    box_mass_factor=1.45753,
    rail_vertical_bending_factor=0.699231,
    rail_lateral_bending_factor=1.99419,
    rail_torsion_factor=0.521502,
    crossmember_bending_factor=4.30027,
    crossmember_torsion_factor=0.300085,
)
"""The study's factors, for which it gives masses, frequencies and stiffnesses."""


@cache
def parts():
    return {part.name: part for part in components(STUDY)}


@cache
def matrices(name):
    part = parts()[name]
    return assemble(part.structure.mesh).scaled(part.stiffness_factor, part.mass_factor)


@cache
def meshes():
    return display_meshes({name: part.structure for name, part in parts().items()}, Parameters())


@pytest.mark.parametrize("name", COUNTS)
def test_half_a_component_has_the_studys_nodes_and_elements(name):
    structure = parts()[name].structure
    shells, beams = len(structure.mesh.quads) // 2, len(structure.mesh.beams) // 2
    assert (len(structure.mirror), shells, beams) == COUNTS[name]


@pytest.mark.parametrize("name", COUNTS)
def test_the_left_half_mirrors_the_right(name):
    structure = parts()[name].structure
    nodes, right = structure.mesh.nodes, len(structure.mirror)
    np.testing.assert_array_equal(nodes[structure.mirror], nodes[:right] * MIRROR)
    half = len(structure.mesh.beams) // 2
    np.testing.assert_array_equal(
        structure.mirror[structure.mesh.beams[:half]], structure.mesh.beams[half:]
    )


@pytest.mark.parametrize("name", COUNTS)
def test_a_component_weighs_and_balances_as_in_the_study(name):
    mass = matrices(name).mass
    x = np.zeros(matrices(name).n_dofs)
    x[::6] = 1.0
    assert x @ mass @ x == pytest.approx(MASSES[name], abs=0.05)
    center = center_of_gravity(matrices(name))
    np.testing.assert_allclose(center[[0, 2]], CENTERS[name], atol=0.0005)
    assert center[1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("name", COUNTS)
def test_a_component_rings_as_in_the_study(name):
    """The study's half meshes, solved for symmetric and antisymmetric motion, have the same modes."""
    found = np.sqrt(free_modes(matrices(name), 14).omega_n_squared[6:]) / (2 * np.pi)
    np.testing.assert_allclose(found, ELASTIC_HZ[name], atol=0.051)


def test_the_bare_frame_is_as_stiff_as_in_the_study():
    frame = static_stiffness(STUDY)["frame"]
    per_degree = frame.torsion / factor("N m/deg", "rotational_stiffness")
    assert per_degree == pytest.approx(936, abs=0.5)
    assert frame.beaming == pytest.approx(2860e3, abs=5e3)


def test_static_stiffness_is_told_in_an_engineers_units():
    assert str(StaticStiffness(936 * 180 / np.pi, 2.86e6)) == "torsion 936 N m/deg, beaming 2860 N/mm"


def test_lattice_interpolates_between_its_corners():
    corners = np.stack(np.meshgrid([0.0, 1.0, 4.0], [0.0, 2.0], [0.0, 1.0], indexing="ij"), axis=-1)
    lattice = Lattice(corners, ([2, 3], [1], [2]))
    lattice.panel((0, 2), 1, (0, 1), steel_sheet(0.001, 1.0))
    found = np.array(lattice.nodes)
    assert sorted(set(found[:, 0])) == [0.0, 0.5, 1.0, 2.0, 3.0, 4.0]
    assert set(found[:, 1]) == {2.0}
    assert sorted(set(found[:, 2])) == [0.0, 0.5, 1.0]


def test_lattice_joins_members_to_panels():
    corners = np.stack(np.meshgrid([0.0, 1.0], [0.0, 2.0], [0.0, 1.0], indexing="ij"), axis=-1)
    lattice = Lattice(corners, ([4], [1], [2]))
    lattice.panel((0, 1), 1, (0, 1), steel_sheet(0.001, 1.0))
    before = len(lattice.nodes)
    lattice.member((0, 1, 0), (1, 1, 0), box_member(0.05, 0.05, 0.001))
    assert len(lattice.nodes) == before


def test_a_mount_hangs_on_its_bracket_and_not_on_the_sheet_beside_it():
    structure = parts()["cab"].structure
    mount = np.array([1.04, 0.70, 0.51])
    nearest = np.linalg.norm(structure.mesh.nodes - mount, axis=1).argmin()
    assert structure.node_near(mount) == structure.brackets[0] != nearest
    assert structure.node_near(mount * MIRROR) == structure.mirror[structure.brackets[0]]


def test_mount_rates_are_those_of_table_4():
    n_per_cm = factor("N/cm", "stiffness")
    cab_front = ORIGINAL["C1"], OPTIMISED["C1"]
    assert [rate / n_per_cm for rates in cab_front for rate in rates.as_tuple()] == pytest.approx(
        [10940, 6700, 4200, 21000, 16600, 5360]
    )
    assert set(builtin_truck().rate_sets) == {"original", "optimised"}
    assert builtin_truck().rates == ORIGINAL
    for group in builtin_truck().mount_groups:
        softest, stiffest = group.bounds
        assert stiffest.lateral / softest.lateral == pytest.approx(12)


def test_the_paper_optimises_for_its_rough_road_and_every_wheel_load():
    problem = builtin_truck().problem("paper")
    built = paper_problem(builtin_truck().random_load("road 1"), builtin_truck().wheel_loads)
    assert ProblemRecord.of(problem) == ProblemRecord.of(built)
    on_road, on_wheels = problem.performance
    assert on_road.roads == ("road 1",)
    np.testing.assert_allclose(on_road.frequency_hz, np.arange(18, 43) / 3, rtol=1e-15)
    assert on_wheels.wheel_loads == tuple(load.name for load in builtin_truck().wheel_loads)
    assert on_wheels.frequency_hz.tolist() == [11.0, 13.25, 15.75]
    assert {g.group: g.fixed_ratios for g in problem.groups} == {
        "F": False, "C1": False, "C2": False, "E": True, "T": True,
    }  # fmt: skip


def test_every_wheel_has_three_loads_that_are_alike_left_and_right():
    loads = {load.name: load for load in builtin_truck().wheel_loads}
    assert len(loads) == 12
    for name, load in loads.items():
        assert load.amplitude == loads[name.replace("left", "right")].amplitude
        assert name == f"{load.tyre} {load.kind}"


def test_the_relay_rod_is_held_better_on_the_left():
    stiffness = {c.name: c.stiffness[1] for c in builtin_truck().connections}
    left, right = stiffness["relay rod left"], stiffness["relay rod right"]
    p = Parameters()
    assert (left + right) / 2 == pytest.approx(p.relay_rod_rate)
    assert left / right == pytest.approx((1 + p.relay_rod_asymmetry) / (1 - p.relay_rod_asymmetry))


def test_only_loads_and_steering_tell_left_from_right():
    sides = {
        c.name.replace("left", "right"): c for c in builtin_truck().connections if "left" in c.name
    }
    for connection in builtin_truck().connections:
        if "right" in connection.name and connection.group != "steering":
            np.testing.assert_array_equal(connection.stiffness, sides[connection.name].stiffness)
            np.testing.assert_allclose(connection.points * MIRROR, sides[connection.name].points)


def test_rigid_bodies_are_well_within_what_inertias_can_be():
    for body in builtin_truck().bodies:
        if isinstance(body, RigidBody):
            *others, largest = np.linalg.eigvalsh(body.inertia)
            assert largest < 0.98 * sum(others), body.name


def test_roads_can_be():
    """No more power in common than tracks have."""
    f = np.arange(0.1, 40, 0.05)
    for S in (roads.road_1(f, RoadShapes()), roads.road_2(f, RoadShapes())):
        assert np.linalg.eigvalsh(S).min(axis=1).min() > 0


def test_road_2_has_lines_at_the_multiples_of_the_slab_frequency():
    for multiple in (1, 2, 3):
        left = roads.road_2(np.array([0.0, 0.7]) + multiple * 20 / 3, RoadShapes())[:, 0, 0]
        assert abs(left[0]) > 3 * abs(left[1])


def test_the_folder_holds_what_the_builder_makes_of_the_frame():
    built = builtin_truck().body("frame")
    assert isinstance(built, FlexibleBody)
    frame = matrices_now("frame")
    expected = np.sqrt(free_modes(frame, 30).omega_n_squared) / (2 * np.pi)
    np.testing.assert_allclose(built.natural_frequency_hz[:30], expected, rtol=1e-6)


def matrices_now(name):
    part = next(part for part in components(Parameters()) if part.name == name)
    return assemble(part.structure.mesh).scaled(part.stiffness_factor, part.mass_factor)


def test_the_folder_is_what_the_builder_writes_with_its_bodies(tmp_path):
    """Nobody has edited it by hand; only the finite elements are not solved again."""
    built = pickup(Parameters(), solve=lambda name, *_: builtin_truck().body(name))
    write_vehicle(built, tmp_path / "truck")
    written, committed = (
        {p.relative_to(f): p for p in f.rglob("*") if p.is_file()}
        for f in (tmp_path / "truck", builtin_vehicle())
    )
    assert set(written) == set(committed)
    alike = {".npz": assert_same_bytes, ".glb": assert_same_look}
    for name, path in written.items():
        alike.get(name.suffix, assert_same_text)(path, committed[name])


def assert_same_bytes(found, expected):
    """Of what was only copied."""
    assert found.read_bytes() == expected.read_bytes(), expected.name


def assert_same_text(found, expected):
    """Numbers to twelve digits, which other processors round alike; the rest to the letter."""
    number = re.compile(r"-?\d+\.\d+(?:e[-+]?\d+)?")
    texts = [path.read_text("utf-8") for path in (found, expected)]
    assert number.sub("0", texts[0]) == number.sub("0", texts[1])
    values = [np.array(number.findall(text), float) for text in texts]
    np.testing.assert_allclose(values[0], values[1], rtol=1e-12, atol=1e-15, err_msg=expected.name)


def assert_same_look(found, expected):
    """Vertices to the rounding of their file, which holds them in single precision."""
    for ours, theirs in zip(read_mesh(found), read_mesh(expected), strict=True):
        assert (ours.name, vars(ours.material)) == (theirs.name, vars(theirs.material))
        np.testing.assert_array_equal(ours.faces, theirs.faces)
        size = np.abs(theirs.vertices).max()
        np.testing.assert_allclose(
            ours.vertices, theirs.vertices, rtol=0, atol=np.finfo(np.float32).eps * size
        )


@pytest.mark.slow
@pytest.mark.bitwise
def test_the_truck_is_built_the_same_to_the_byte_every_time(tmp_path):
    for folder in ("first", "second"):
        write_vehicle(pickup(Parameters()), tmp_path / folder)
    first, second = (
        {p.relative_to(tmp_path / f): p.read_bytes() for p in (tmp_path / f).rglob("*") if p.is_file()}
        for f in ("first", "second")
    )
    assert first == second


def test_every_body_is_drawn_with_a_bearable_number_of_vertices():
    assert set(meshes()) == {body.name for body in builtin_truck().bodies}
    assert 2000 < sum(len(part.vertices) for mesh in meshes().values() for part in mesh) < 20000


@pytest.mark.parametrize("name", ["front end", "cab", "box"])
def test_panels_are_drawn_on_the_nodes(name):
    """So that what bends in the model bends alike on the screen."""
    structure = parts()[name].structure
    paint = next(part for part in meshes()[name] if "paint" in part.name)
    drawn = {tuple(v) for part in meshes()[name] for v in part.vertices}
    on_shells = structure.mesh.nodes[np.unique(structure.mesh.quads)]
    assert {tuple(node) for node in on_shells} <= drawn
    assert len(paint.vertices) < 2.2 * len(on_shells)


def test_no_drawn_triangle_is_without_area():
    for mesh in meshes().values():
        for part in mesh:
            a, b, c = part.vertices[part.faces].swapaxes(0, 1)
            assert (np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-9).all(), part.name


def test_the_look_is_the_same_left_and_right():
    for link in ("knuckle", "lower arm", "upper arm"):
        for left, right in zip(meshes()[f"{link} left"], meshes()[f"{link} right"], strict=True):
            np.testing.assert_array_equal(left.vertices, right.vertices * MIRROR)
