"""Bodies and modes as GLB, VTU and NumPy arrays: places, motions and colours are the vehicle's."""

import io
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from joined_networks import joined_networks
from mounted_cabin import mounted_cabin
from turned_vehicles import turned_folder
from vtk_files import cells, read_vtu, time_steps

from modeviz.dynamics.assembly import assemble
from modeviz.errors import ModevizError
from modeviz.export.axes import FileAxes
from modeviz.files import read_vehicle
from modeviz.study.study import Study
from modeviz.vehicle.bodies import Material, MeshPart

SINGLE = 2e-7
"""Relative: of numbers in single precision."""

BOX, AT = trimesh.creation.box((1.0, 2.0, 3.0)), np.array([1.0, 0.25, 2.0])


@pytest.fixture(scope="module")
def vehicle(tmp_path_factory):
    return joined_networks(tmp_path_factory.mktemp("networks"))


@pytest.fixture(scope="module")
def study(vehicle):
    return Study(vehicle)


def boxed():
    """The cabin with a box for a cab, 1 m long, 2 m wide and 3 m high, and nothing for a chassis."""
    vehicle = mounted_cabin()
    paint = Material((200, 30, 60), opacity=0.5)
    box = MeshPart("box", BOX.vertices + AT, BOX.faces, paint)
    return replace(vehicle, bodies=(replace(vehicle.bodies[0], mesh=(box,)), *vehicle.bodies[1:]))


def test_glb_stands_upright_with_its_front_towards_z_and_keeps_colours(tmp_path):
    path = Study(boxed()).export(tmp_path / "bodies.glb").path
    scene = trimesh.load(path)
    x_rearward, y_right, z_up = scene.bounds.T[[2, 0, 1]]
    assert sorted(-x_rearward) == pytest.approx([0.5, 1.5])
    assert sorted(-y_right) == pytest.approx([-0.75, 1.25])
    assert z_up.tolist() == pytest.approx([0.5, 3.5])
    (material,) = (mesh.visual.material for mesh in scene.geometry.values())
    assert material.baseColorFactor[3] == pytest.approx(128, abs=1)
    assert material.alphaMode == "BLEND"
    assert list(scene.graph.nodes_geometry) == ["cab: box"]


def test_a_body_without_a_mesh_is_no_glb(tmp_path):
    with pytest.raises(ModevizError, match="no mesh to write: chassis without one"):
        Study(boxed()).export(tmp_path / "chassis.glb")
    assert not list(tmp_path.iterdir())


def test_a_grid_has_the_triangles_of_meshes_and_lines_for_what_has_none(tmp_path):
    groups = read_vtu(Study(boxed()).export(tmp_path / "bodies.vtu").path.read_bytes())
    places = groups["Points"]["Points"]
    assert cells(groups, 5).shape == (12, 3)
    np.testing.assert_allclose(places[:8], BOX.vertices + AT, rtol=1e-15)
    star = cells(groups, 3)  # from the chassis's centre of gravity to what holds on to it
    assert set(star[:, 0].tolist()) == {8}
    ends = {tuple(point) for mount in boxed().mounts for point in mount.points.tolist()}
    ends |= {tuple(tyre.points[0].tolist()) for tyre in boxed().tyres}
    assert {tuple(place) for place in places[star[:, 1]].tolist()} == ends
    np.testing.assert_array_equal(np.unique(groups["CellData"]["body"]), [0, 1])


@pytest.mark.parametrize("words", [None, ("forward", "left", "up"), ("up", "forward", "left")])
def test_points_of_a_grid_move_as_rigid_bodies_do(words, tmp_path):
    """u + θ × r of each mode, in the axes of the vehicle's file."""
    vehicle, turn = boxed(), np.eye(3)
    if words:
        folder = turned_folder(tmp_path / "turned", vehicle, words)
        vehicle = read_vehicle(folder)
        turn = FileAxes(vehicle.axes).turn
    study = Study(vehicle)
    groups = read_vtu(study.export(tmp_path / "modes.vtu").path.read_bytes())
    system, shapes = assemble(vehicle), study.modes().shapes
    places, owners = groups["Points"]["Points"], ["cab"] * 8 + ["chassis"] * 100
    assert len(groups["PointData"]) == shapes.shape[1]
    for (name, vectors), shape, f in zip(
        groups["PointData"].items(), shapes.T, study.modes().frequency_hz, strict=True
    ):
        assert f"{f:.4g} Hz" in name
        rows = [
            system.motion(owner, turn @ place)[:3] for owner, place in zip(owners, places, strict=False)
        ]
        expected = np.array(rows) @ shape @ turn
        size = np.abs(expected).max()
        np.testing.assert_allclose(vectors, expected, rtol=0, atol=4 * SINGLE * size)
    np.testing.assert_allclose(groups["FieldData"]["frequency, Hz"], study.modes().frequency_hz)


def test_complex_modes_of_a_grid_have_real_and_imaginary_parts(study, tmp_path):
    groups = read_vtu(study.export(tmp_path / "complex-modes.vtu").path.read_bytes())
    names = list(groups["PointData"])
    assert [name.rpartition(", ")[2] for name in names[:2]] == ["real", "imaginary"]
    assert names[0].rpartition(", ")[0] == names[1].rpartition(", ")[0]
    arrays = np.load(io.BytesIO(study.export(tmp_path / "complex-modes.npz").path.read_bytes()))
    places = groups["Points"]["Points"]
    owners = np.repeat(["upper", "lower"], len(places) // 2)
    at = [row_of(arrays, owner, place) for place, owner in zip(places, owners, strict=True)]
    for i, psi in enumerate(np.moveaxis(arrays["shapes"][at, :3], -1, 0)):
        vectors = groups["PointData"][names[2 * i]] + 1j * groups["PointData"][names[2 * i + 1]]
        np.testing.assert_allclose(vectors, psi, rtol=0, atol=4 * SINGLE * np.abs(psi).max())


def test_a_motion_is_a_cycle_of_the_mode_asked_for_and_drawn_as_large_as_on_the_screen(tmp_path):
    study = Study(boxed())
    mode = study.modes()["cab yaw"]
    content = study.export(tmp_path / "motion.vtu", mode="cab yaw").path.read_bytes()
    moving, (name, vectors) = time_steps(content), *read_vtu(content)["PointData"].items()
    assert name == f"mode {mode.number:03d}, {mode.frequency_hz:.4g} Hz, cab yaw"
    rest = moving.mean(axis=0)
    scale = (moving[0] - rest)[0] @ vectors[0] / (vectors[0] @ vectors[0])
    for step, places in enumerate(moving):
        expected = rest + scale * np.cos(2 * np.pi * step / len(moving)) * vectors
        np.testing.assert_allclose(places, expected, atol=10 * SINGLE)
    length = np.ptp(rest, axis=0).max()
    assert 0.01 < np.linalg.norm(moving[0] - rest, axis=1).max() / length < 0.06


def test_a_motion_of_a_mode_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(ModevizError, match="unknown mode 'cab jaw': did you mean 'cab yaw'"):
        Study(boxed()).export(tmp_path / "motion.vtu", mode="cab jaw")
    assert not list(tmp_path.iterdir())


def test_names_that_xml_does_not_have_are_written_without_what_it_lacks(tmp_path):
    named = replace(boxed(), name="odd -- \x01 & <name>\n")
    read_vtu(Study(named).export(tmp_path / "bodies.vtu").path.read_bytes())


def row_of(arrays, body, place):
    """The last node of a body in a place, to single precision."""
    apart = np.linalg.norm(arrays["nodes"] - place, axis=1)
    return np.flatnonzero((apart < 1e-6) & (arrays["node_bodies"] == body))[-1]


def test_arrays_say_which_body_and_attachment_each_node_is_of_and_how_it_moves(study, tmp_path):
    arrays = np.load(study.export(tmp_path / "modes.npz").path)
    modes, system = study.modes(), assemble(study.vehicle)
    np.testing.assert_array_equal(arrays["frequency_hz"], modes.frequency_hz)
    np.testing.assert_array_equal(arrays["mode_names"], modes.names)
    named = arrays["node_names"] != ""
    for name, body, place, shapes in zip(
        *(arrays[key][named] for key in ("node_names", "node_bodies", "nodes", "shapes")), strict=True
    ):
        np.testing.assert_array_equal(study.vehicle.body(body).attachment(name).position, place)
        np.testing.assert_allclose(
            shapes, system.motion(body, place) @ modes.shapes, rtol=1e-6, atol=1e-12
        )
    assert "1/sqrt(kg)" in str(arrays["units"])
    assert str(arrays["axes"]) == study.vehicle.axes


@pytest.mark.parametrize("words", [("rearward", "right", "up"), ("forward", "left", "up")])
def test_the_arrays_of_a_body_are_those_of_a_vehicle_folder(vehicle, words, tmp_path):
    """Put in place of the file that is there, they are the same body in the axes of that folder."""
    folder = turned_folder(tmp_path / "turned", vehicle, words)
    before = read_vehicle(folder).body("upper")
    written = Study(folder).export(tmp_path / "upper.npz").path
    (folder / "bodies/upper.npz").write_bytes(written.read_bytes())
    after = read_vehicle(folder).body("upper")
    np.testing.assert_array_equal(after.omega_n_squared, before.omega_n_squared)
    np.testing.assert_allclose(after.shapes, before.shapes, rtol=SINGLE)
    for one, other in zip(after.attachments, before.attachments, strict=True):
        np.testing.assert_allclose(one.position, other.position, rtol=1e-15)
        np.testing.assert_allclose(one.shapes, other.shapes, rtol=1e-15)
