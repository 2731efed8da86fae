"""Modes as universal files are what pyuff and other readers find there, and come back."""

from dataclasses import replace

import numpy as np
import pytest
import pyuff
import trimesh
from joined_networks import GROUNDED, RATES, joined_networks
from mounted_cabin import mounted_cabin
from two_networks import ATTACHED, joined_frequencies, place

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.files import read_vehicle, write_vehicle
from modeviz.formats.universal import read_universal
from modeviz.study.study import Study
from modeviz.vehicle.bodies import Material, MeshPart

DIGITS = 5.1e-6
"""Relative: half of the sixth digit of a number."""

ABOVE_ALL = 1e4
"""Hz."""

BOX = trimesh.creation.box((1.0, 2.0, 3.0))

ENDINGS = {".unv": 2414, ".uff": 55}


@pytest.fixture(scope="module")
def vehicle(tmp_path_factory):
    return joined_networks(tmp_path_factory.mktemp("networks"))


@pytest.fixture(scope="module")
def study(vehicle):
    return Study(vehicle)


def sets(path, kind):
    return [one for one in pyuff.UFF(str(path)).read_sets() if one["type"] == kind]


def parameters(mode):
    """Frequency, modal mass and damping ratio of either data set."""
    if mode["type"] == 55:
        return mode["freq"], mode["modal_m"], mode["modal_damp_vis"]
    return tuple(mode[f"record12_field{field}"] for field in (2, 4, 5))


def motions(mode):
    """(n_nodes, 6), as pyuff reads either data set."""
    if mode["type"] == 55:
        return np.column_stack([mode[f"r{i}"] for i in range(1, 7)])
    return np.array([*mode["data_at_node"]])


def whole_matrices():
    """The natural frequencies of the vehicle by its whole matrices, Hz."""
    springs = np.diag(RATES.local()) / 1000
    joints = [(node, springs) for node in ATTACHED]
    return joined_frequencies(joints, [(node, GROUNDED / 1000) for node in ATTACHED])


@pytest.mark.parametrize("ending", ENDINGS)
def test_modes_of_a_vehicle_are_those_of_its_whole_matrices(study, tmp_path, ending):
    path = study.export(tmp_path / f"modes{ending}", below_hz=ABOVE_ALL).path
    found = np.array([parameters(mode) for mode in sets(path, ENDINGS[ending])])
    np.testing.assert_allclose(found[:, 0], whole_matrices(), rtol=DIGITS)
    np.testing.assert_array_equal(found[:, 1], 1.0)
    expected = study.modes(ABOVE_ALL).damping_ratio
    np.testing.assert_allclose(found[:, 2], expected, rtol=DIGITS)


@pytest.mark.parametrize("ending", ENDINGS)
def test_points_move_as_the_vehicle_does(study, tmp_path, ending):
    """Each by the rows that give the motion of a place, and the nodes of a network are attachments."""
    path = study.export(tmp_path / f"modes{ending}").path
    (nodes,) = sets(path, 2411)
    places = np.column_stack([nodes[axis] for axis in "xyz"])
    shapes = study.modes().shapes
    system = assemble(study.vehicle)
    expected = [place(node) / 1000 for _ in range(2) for node in ATTACHED]
    rows = [row for start in (0, 12) for row in range(start, start + len(ATTACHED))]
    np.testing.assert_allclose(places[rows], expected, rtol=1e-15)
    for mode, shape in zip(sets(path, ENDINGS[ending]), shapes.T, strict=True):
        assert list(mode["node_nums"]) == list(range(1, 25))
        for row in rows:
            moved = system.motion("upper" if row < 12 else "lower", places[row]) @ shape
            np.testing.assert_allclose(motions(mode)[row], moved, rtol=DIGITS, atol=1e-13)


def test_surfaces_and_units_are_what_pyuff_reads(study, tmp_path):
    path = study.export(tmp_path / "modes.unv").path
    (units,) = sets(path, 164)
    assert (units["units_code"], units["length"], units["force"]) == (1, 1.0, 1.0)
    (elements,) = sets(path, 2412)
    (kind,) = [value for key, value in elements.items() if key not in ("type",)]
    triangles = np.array([element["nodes_nums"] for element in kind])
    assert triangles.shape == (24, 3)  # twelve on the six faces of each box
    (nodes,) = sets(path, 2411)
    a, b, c = np.column_stack([nodes[axis] for axis in "xyz"])[triangles.T - 1]
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert areas.sum() == pytest.approx(2 * 2 * (1.0 * 0.7 + 0.7 * 0.4 + 0.4 * 1.0))


def test_complex_modes_have_the_eigenvalues_of_the_damped_vehicle(study, tmp_path):
    path = study.export(tmp_path / "complex-modes.uff", below_hz=ABOVE_ALL).path
    system = assemble(study.vehicle)
    n = system.n_dofs
    state = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-system.stiffness, -system.damping]]
    )  # the mass is one
    np.testing.assert_array_equal(system.mass, np.eye(n))
    expected = np.linalg.eigvals(state)
    for mode in sets(path, 55):
        assert mode["analysis_type"] == 3
        assert np.abs(expected - mode["eig"]).min() < 2 * DIGITS * abs(mode["eig"])
        assert mode["modal_b"] == pytest.approx(-mode["eig"] * mode["modal_a"], rel=5 * DIGITS)


@pytest.mark.parametrize("ending", ENDINGS)
def test_complex_modes_and_frequency_responses_are_of_one_structure(study, tmp_path, ending):
    """H = Σ ψ_o ψ_i / a (jω - λ) and its conjugate, of what the files have: all modes, one force.

    The last digits of λ and jω change a mode's part by |λ|/|jω - λ| of themselves.
    """
    modes = read_universal([study.export(tmp_path / f"complex-modes{ending}", below_hz=ABOVE_ALL).path])
    (tmp_path / "one").mkdir()
    as_55 = sets(study.export(tmp_path / "one/complex-modes.uff", below_hz=ABOVE_ALL).path, 55)
    root, a = (np.array([mode[key] for mode in as_55]) for key in ("eig", "modal_a"))
    pushed = ATTACHED.index(14), 1
    felt = 12 + ATTACHED.index(23)
    functions = sets(study.export(tmp_path / "frf.uff").path, 58)
    assert [(f["rsp_node"], f["rsp_dir"], f["ref_dir"]) for f in functions] == [
        (1, 1, 2), (1, 2, 2), (1, 3, 2)
    ]  # fmt: skip
    psi = modes.modes.shapes
    for function in functions:
        s = 2j * np.pi * function["x"][:, None]
        both = psi[felt, function["rsp_dir"] - 1] * psi[pushed]
        parts = both / a / (s - root) + np.conj(both / a) / (s - np.conj(root))
        expected = (s**2)[:, 0] * parts.sum(axis=1)
        near = 2 * DIGITS * np.abs(root / (s - root))
        error = (np.abs(s**2 * both / a / (s - root)) * (6 * DIGITS + near)).sum(axis=1)
        assert (np.abs(function["data"] - expected) < error).all()
        assert np.median(error / np.abs(expected)) < 2e-3


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_component_written_and_imported_again_is_the_same_body(vehicle, study, tmp_path, ending):
    """Its attachments are its first nodes; frequencies agree to the digits that the format has."""
    path = study.export(tmp_path / f"upper{ending}").path
    attach = [word for i, name in enumerate(ATTACHED) for word in ("--attach", f"{name}={i + 1}")]
    arguments = ["--output", str(tmp_path / "again"), "--name", "upper", *attach]
    assert main(["import", str(path), *arguments]) == 0
    before, after = vehicle.body("upper"), read_vehicle(tmp_path / "again").body("upper")
    np.testing.assert_allclose(after.natural_frequency_hz, before.natural_frequency_hz, rtol=DIGITS)
    assert after.damping_ratios == pytest.approx(before.damping_ratios, rel=DIGITS)
    assert after.mass == pytest.approx(before.mass, rel=20 * DIGITS)
    assert [part.faces.shape for part in after.mesh] == [(12, 3)]
    swapped = replace(vehicle, bodies=(after, *vehicle.bodies[1:]))
    found, expected = (solve_modes(assemble(each)).frequency_hz for each in (swapped, vehicle))
    np.testing.assert_allclose(found, expected, rtol=20 * DIGITS)


@pytest.mark.bitwise
def test_a_vehicle_written_and_read_again_has_the_same_frequencies_to_the_last_digit(vehicle, tmp_path):
    write_vehicle(vehicle, tmp_path / "again")
    again = read_vehicle(tmp_path / "again")
    first, second = (solve_modes(assemble(each)).frequency_hz for each in (vehicle, again))
    np.testing.assert_array_equal(first, second)


def test_a_rigid_body_is_drawn_by_its_mesh_or_as_lines_from_its_centre_of_gravity(tmp_path):
    paint = Material((90, 90, 90))
    box = MeshPart("box", BOX.vertices + np.array([1.0, 0.2, 2.0]), BOX.faces, paint)
    cabin = mounted_cabin()
    boxed = replace(cabin, bodies=(replace(cabin.bodies[0], mesh=(box,)), *cabin.bodies[1:]))
    path = Study(boxed).export(tmp_path / "modes.unv").path
    (nodes,) = sets(path, 2411)
    places = np.column_stack([nodes[axis] for axis in "xyz"])
    (elements,) = sets(path, 2412)
    (kind,) = [value for key, value in elements.items() if key != "type"]
    corners = places[np.array([element["nodes_nums"] for element in kind]).T - 1]
    assert np.linalg.norm(
        np.cross(corners[1] - corners[0], corners[2] - corners[0]), axis=1
    ).sum() / 2 == (pytest.approx(BOX.area))
    (line,) = sets(path, 82)
    joined = np.append(line["nodes"].astype(int), 0).reshape(-1, 3)  # a zero lifts the pen
    assert (joined[:, 2] == 0).all()
    assert (places[joined[:, 0] - 1] == cabin.bodies[1].center_of_gravity).all()
    ends = [*(m.points[1] for m in cabin.mounts), *(t.points[0] for t in cabin.tyres)]
    np.testing.assert_array_equal(np.unique(places[joined[:, 1] - 1], axis=0), np.unique(ends, axis=0))
