"""A vehicle folder in other axes than ours is the same vehicle."""

from dataclasses import replace

import numpy as np
import pytest
from folders import one_of_everything
from mounted_cabin import mounted_cabin
from turned_vehicles import LEFT_HANDED, RIGHT_HANDED, text, turned, turned_folder

from modeviz.dynamics.assembly import assemble
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.schema.axes import axes_of
from modeviz.ride.roads import track_amplitudes, tyre_directions
from modeviz.ride.wheels import wheel_directions
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.vehicle import Vehicle

ISO_8855 = ("forward", "left", "up")


def vehicle_with_everything() -> Vehicle:
    """Local axes askew, mounts that resist rotation, products of inertia, a joint half rigid."""
    vehicle = one_of_everything()
    (group,) = vehicle.mount_groups
    askew = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])
    left, right = group.mounts
    mounts = (
        replace(left, rotational_stiffness=np.array([10.0, 20.0, 30.0]), damping=np.array([1.0, 2, 3])),
        replace(right, axes=askew),
    )
    slide = Spring(
        "slide",
        "springs",
        ("Engine & box", GROUND),
        np.tile([0.1, 0.2, 0.3], (2, 1)),
        rigid=("y", "rz"),
    )
    return replace(
        vehicle,
        mount_groups=(replace(group, mounts=mounts),),
        connections=(vehicle.connections[0], slide, *vehicle.connections[1:]),
    )


@pytest.mark.parametrize("words", RIGHT_HANDED, ids=text)
def test_a_vehicle_in_any_axes_is_the_same(tmp_path, words):
    vehicle = vehicle_with_everything()
    found = read_vehicle(turned_folder(tmp_path / "a", vehicle, words))
    system, expected = assemble(found), assemble(vehicle)
    for name in ("mass", "damping", "stiffness"):
        ours, theirs = getattr(system, name), getattr(expected, name)
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12 * np.abs(theirs).max())
    f = np.array([1.0, 7.0])
    forces = [tyre_directions(s).T @ track_amplitudes(s.vehicle, f, 20.0) for s in (system, expected)]
    np.testing.assert_allclose(*forces, atol=1e-12 * np.abs(forces[1]).max())
    np.testing.assert_allclose(wheel_directions(system), wheel_directions(expected), atol=1e-12)
    for a, b in zip(found.forces, vehicle.forces, strict=True):
        np.testing.assert_array_equal([a.position, a.direction], [b.position, b.direction])
    for a, b in zip(found.base_motions, vehicle.base_motions, strict=True):
        np.testing.assert_array_equal(a.direction, b.direction)


@pytest.mark.parametrize("words", RIGHT_HANDED, ids=text)
def test_arrays_and_meshes_are_turned_to_the_last_bit(tmp_path, words):
    vehicle = one_of_everything()
    found, body = (
        v.body("cab") for v in (read_vehicle(turned_folder(tmp_path / "a", vehicle, words)), vehicle)
    )
    assert isinstance(found, FlexibleBody)
    assert isinstance(body, FlexibleBody)
    np.testing.assert_array_equal(found.nodes, body.nodes)
    np.testing.assert_array_equal(found.shapes, body.shapes)
    for a, b in zip(found.attachments, body.attachments, strict=True):
        np.testing.assert_array_equal(a.position, b.position)
        np.testing.assert_array_equal(a.shapes, b.shapes)
    for a, b in zip(found.mesh, body.mesh, strict=True):
        np.testing.assert_array_equal(a.vertices, b.vertices)
        np.testing.assert_array_equal(a.faces, b.faces)


@pytest.mark.parametrize(
    "words", [ISO_8855, ("forward", "right", "down"), ("left", "rearward", "up")], ids=text
)
def test_the_seat_of_a_car_in_other_axes_feels_the_same(tmp_path, printed_json, words):
    write_vehicle(mounted_cabin(), tmp_path / "ours")
    ours = printed_json("psd", str(tmp_path / "ours"))
    theirs = printed_json("psd", str(turned_folder(tmp_path / "a", mounted_cabin(), words)))
    for a, b in zip(ours["responses"], theirs["responses"], strict=True):
        assert (a["point"], a["direction"]) == (b["point"], b["direction"])
        np.testing.assert_allclose(a["psd_g2_per_hz"], b["psd_g2_per_hz"], rtol=1e-9)


def test_axes_that_are_not_the_files_give_another_ride(tmp_path, printed_json):
    """So that the test before can fail: the same numbers, without the key."""
    write_vehicle(mounted_cabin(), tmp_path / "ours")
    write_vehicle(turned(mounted_cabin(), ISO_8855), tmp_path / "a")
    ours, theirs = (printed_json("psd", str(tmp_path / name)) for name in ("ours", "a"))
    assert ours["responses"][2]["rms_g"] != pytest.approx(theirs["responses"][2]["rms_g"], rel=1e-3)


@pytest.mark.parametrize("words", LEFT_HANDED, ids=text)
def test_left_handed_axes_are_refused(words):
    with pytest.raises(VehicleError, match="which are left-handed axes; expected right-handed ones"):
        axes_of(text(words))


@pytest.mark.parametrize(
    "said",
    ["X Forward, Y to the left, Z upwards", "z up x front y left", "x forwards; y left; z up"],
)
def test_axes_are_said_in_some_ways(said):
    np.testing.assert_array_equal(axes_of(said), np.diag([-1, -1, 1]))


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("", "found '', expected such as 'x forward, y left, z up'"),
        ("x forward, y left", "expected such as"),
        ("x forward, x left, z up", "expected such as"),
        ("x forward, y rearward, z up", "two axes along the same line"),
        ("x forward, y lefft, z up", "unknown direction 'lefft': did you mean 'left'?"),
    ],
)
def test_axes_that_are_none_are_refused(said, words):
    with pytest.raises(VehicleError) as caught:
        axes_of(said)
    assert words in str(caught.value)
