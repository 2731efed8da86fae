"""Blocks for rigid bodies without a mesh."""

from dataclasses import replace

import numpy as np
import pytest

from modeviz.shapes.stand_in import drawn_mesh
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import RigidBody

EDGES, MASS = np.array([1.2, 0.7, 0.4]), 180.0


def block(edges=EDGES, products=0.0):
    """A homogeneous block of these edges, with products of inertia besides."""
    moments = MASS * (np.sum(edges**2) - edges**2) / 12
    inertia = np.diag(moments) + products * (1 - np.eye(3))
    return RigidBody("engine", "powertrain", "engine", MASS, np.array([1, 2, 3.0]), inertia)


@pytest.mark.parametrize("products", [0.0, 1.5])
def test_a_homogeneous_block_is_drawn_as_itself(products):
    (part,) = drawn_mesh(block(products=products))
    assert np.ptp(part.vertices, axis=0) == pytest.approx(EDGES)
    assert part.vertices.mean(axis=0) == pytest.approx([1, 2, 3])


def test_faces_look_outward_and_enclose_the_volume():
    """Σ a·(b × c)/6 over outward triangles is the volume (Gauss)."""
    (part,) = drawn_mesh(block())
    a, b, c = np.moveaxis((part.vertices - [1, 2, 3])[part.faces], 1, 0)
    assert np.sum(a * np.cross(b, c)) / 6 == pytest.approx(np.prod(EDGES))


def test_only_the_edges_of_a_block_are_drawn_as_edges():
    drawn = surface(drawn_mesh(block()))
    ends = drawn.vertices[drawn.edges] - [1, 2, 3]
    on_face = np.isclose(np.abs(ends), EDGES / 2)
    assert (on_face.all(axis=1).sum(axis=1) >= 2).all()


def test_a_rod_is_drawn_with_some_width():
    (part,) = drawn_mesh(block(edges=np.array([2.0, 1e-6, 1e-6])))
    assert np.ptp(part.vertices, axis=0) == pytest.approx([2.0, 0.04, 0.04])


def test_a_body_with_a_mesh_is_drawn_by_it():
    mesh = drawn_mesh(block())
    assert drawn_mesh(replace(block(), mesh=mesh)) is mesh
