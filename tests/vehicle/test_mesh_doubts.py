"""A mesh that does not go with its body is pointed out with the factor that would fit; none else is."""

import re
from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from folders import one_of_everything
from small_vehicles import tyre, wheel

from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.bodies import FlexibleBody, Material, MeshPart, RigidBody
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.mesh_doubts import mesh_doubts
from modeviz.vehicle.vehicle import Vehicle

SIDES = np.array([2.0, 1.4, 1.0])
CENTER = np.array([1.5, 0.0, 1.0])
CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]])


def block(vertices) -> RigidBody:
    """A solid block of 400 kg with that mesh."""
    inertia = np.diag([400 / 12 * (np.sum(SIDES**2) - side**2) for side in SIDES])
    part = MeshPart("skin", vertices, FACES, Material((9, 9, 9)))
    return RigidBody("cab", "cabin", "cab", 400.0, CENTER, inertia, (part,))


def said(body, *connections) -> str:
    others = tuple(wheel(name) for name in ("frame",))
    return " | ".join(mesh_doubts(Vehicle("v", (body, *others), connections)))


def mounts() -> tuple[Spring, ...]:
    places = CENTER + SIDES * CORNERS[[0, 2, 4, 6]]
    rates = np.full(3, 1e5)
    return tuple(
        Spring(f"s{i}", "s", ("cab", "frame"), np.array([p, p]), rates) for i, p in enumerate(places)
    )


PLACED = CENTER + SIDES * CORNERS


def test_a_mesh_that_fits_is_left_alone():
    assert said(block(PLACED), *mounts()) == ""
    assert said(block(PLACED)) == ""


@pytest.mark.parametrize("factor", [1000, 100, 39.37, 25.4])
@pytest.mark.parametrize("joints", [mounts(), ()], ids=["mounted", "free"])
def test_the_factor_that_fits_is_named(factor, joints):
    larger, smaller = said(block(PLACED * factor), *joints), said(block(PLACED / factor), *joints)
    for text, direction in ((larger, "smaller"), (smaller, "larger")):
        assert text.startswith("body 'cab': mesh: is ")
        assert re.search(rf"would fit .*\b{factor:g} \([a-z ]+\).* times {direction}", text)


def test_the_likeliest_factor_comes_first():
    for factor in (1000, 25.4):
        assert f"would fit {factor:g} (" in said(block(PLACED * factor), *mounts())


def test_a_mesh_about_another_origin_is_pointed_out():
    away = said(block(PLACED - [6.0, 0, 0]), *mounts())
    assert "m away from what is connected to it, its middle at (-4.5, 0, 1) m" in away
    assert "m away from its mass and inertia" in said(block(PLACED + np.array([0, 9.0, 0])))


def test_vertices_that_no_face_names_do_not_count():
    body = block(np.vstack([PLACED, [9e3, 0, 0]]))
    assert said(body, *mounts()) == ""


def test_a_flexible_body_is_held_against_its_nodes():
    cab = one_of_everything().body("cab")
    assert isinstance(cab, FlexibleBody)
    mesh = tuple(replace(part, vertices=1000 * part.vertices) for part in cab.mesh)
    vehicle = replace(
        one_of_everything(), bodies=(replace(cab, mesh=mesh), one_of_everything().bodies[1])
    )
    (text,) = mesh_doubts(vehicle)
    assert "by its nodes" in text
    assert "would fit 1000 (millimetres for metres) times smaller" in text


def test_no_body_of_the_truck_is_doubted():
    assert list(mesh_doubts(builtin_truck())) == []


def test_a_wheel_whose_tyre_reaches_down_to_the_ground_is_not_doubted():
    axle = wheel("axle")
    hub = MeshPart("hub", axle.center_of_gravity + 0.2 * CORNERS, FACES, Material((9, 9, 9)))
    vehicle = Vehicle("v", (replace(axle, mesh=(hub,), inertia=0.1 * np.eye(3)),), (tyre(axle),))
    assert list(mesh_doubts(vehicle)) == []


def test_a_folder_that_is_read_has_the_note(tmp_path):
    write_vehicle(Vehicle("v", (block(PLACED * 1000), wheel("frame")), mounts()), tmp_path / "v")
    assert any("would fit 1000 (" in note for note in read_vehicle(tmp_path / "v").notes)
