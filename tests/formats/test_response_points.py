"""Response points put into a vehicle folder."""

import numpy as np
import pytest
from network_files import network_unv

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.formats.response_points import add_response_point
from modeviz.vehicle.unfinished import unfinished
from modeviz.viewer.inspection.sources import finished_vehicle

RIGID = """
[[rigid_body]]
name = "engine"
mass = 150.0
center_of_gravity = [0.7, 0.1, 0.4]
inertia = [8.0, 10.0, 9.0]
"""


@pytest.fixture
def folder(tmp_path):
    """A vehicle of an imported body and a rigid one, on a mount."""
    (tmp_path / "block.unv").write_text(network_unv())
    (tmp_path / "mounts.csv").write_text(
        "name,group,body 1,body 2,node 1,kx [N/mm],ky [N/mm],kz [N/mm]\nm,M,block,ground,a,1,2,3\n"
    )
    vehicle = tmp_path / "vehicle"
    put = ["--output", str(vehicle)]
    body = ["--units", "mm-t-s", "--attach", "a=11", "--attach", "b=24"]
    assert main(["import", str(tmp_path / "block.unv"), *body, *put]) == 0
    with (vehicle / "vehicle.toml").open("a") as file:
        file.write(RIGID)
    assert main(["import", str(tmp_path / "mounts.csv"), *put]) == 0
    return vehicle


def test_without_response_points_a_vehicle_has_its_modes(folder, capsys):
    assert main(["modes", str(folder)]) == 0
    assert "modes below 40 Hz" in capsys.readouterr().out
    assert finished_vehicle(folder) is not None
    assert any("response_point" in sentence for sentence in unfinished(read_vehicle(folder)))


def test_a_point_is_at_an_attachment_by_its_name(folder):
    before = (folder / "vehicle.toml").read_text()
    vehicle = add_response_point(folder, "seat", "block", "b")
    (point,) = vehicle.response_points
    assert (point.name, point.body) == ("seat", "block")
    np.testing.assert_array_equal(point.position, vehicle.body("block").attachment("b").position)
    assert (folder / "vehicle.toml").read_text().startswith(before)
    assert read_vehicle(folder).response_points[0].name == "seat"
    assert not any("response_point" in sentence for sentence in unfinished(vehicle))


def test_a_point_on_a_rigid_body_is_at_its_centre_of_gravity_or_where_it_is_said(folder):
    add_response_point(folder, "center", "engine", "")
    vehicle = add_response_point(folder, "top", "engine", " 0.7, 0.1,0.9 ")
    places = [point.position for point in vehicle.response_points]
    np.testing.assert_allclose(places, [[0.7, 0.1, 0.4], [0.7, 0.1, 0.9]], rtol=1e-15)


def test_places_are_in_the_axes_and_the_unit_of_the_file(folder):
    path = folder / "vehicle.toml"
    text = path.read_text().replace('#axes = "x forward', 'axes = "x forward')
    path.write_text(text.replace('\nlength = "m"', '\nlength = "mm"', 1))
    body = read_vehicle(folder).body("block")
    far = body.attachment("b").position * [-1, -1, 1] * 1000
    vehicle = add_response_point(folder, "said", "block", ",".join(map(str, far.tolist())))
    named = add_response_point(folder, "named", "block", "b")
    said, other = named.response_points
    np.testing.assert_allclose(said.position, body.attachment("b").position, rtol=1e-12)
    np.testing.assert_allclose(other.position, body.attachment("b").position, rtol=1e-12)
    assert len(vehicle.response_points) == 1


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (("", "block", "a"), "response point: found no name"),
        (("seat", "roof", "a"), "unknown body 'roof': there are block, engine"),
        (("seat", "block", "c"), "response point 'seat': unknown attachment 'c': .* or say X,Y,Z"),
        (("seat", "block", "9,9,9"), "response point 'seat'"),
        (("seat", "block", "nan,0,0"), "unknown attachment"),
        (("seat", "engine", "1,2"), "found the place '1,2', expected X,Y,Z"),
        (("there", "engine", ""), "response point 'there': is there already"),
    ],
)
def test_what_is_no_point_is_refused_and_changes_nothing(folder, asked, words):
    add_response_point(folder, "there", "block", "a")
    before = (folder / "vehicle.toml").read_bytes()
    with pytest.raises(VehicleError, match=words):
        add_response_point(folder, *asked)
    assert (folder / "vehicle.toml").read_bytes() == before


def test_a_folder_without_a_vehicle_is_refused(tmp_path):
    with pytest.raises(VehicleError, match=r"has no vehicle\.toml"):
        add_response_point(tmp_path, "seat", "block", "a")
