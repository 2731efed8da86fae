"""Motions read out of shapes, against rigid-body mechanics."""

import numpy as np
import pytest
from cars import car, rigid
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.motions import (
    bending_rows,
    center_of_gravity,
    end_rows,
    flexibility_share,
    rigid_coordinates,
    rigid_rows,
    share_rows,
)
from modeviz.vehicle.vehicle import Vehicle


def test_shares_of_a_rigid_bodys_six_motions_sum_to_one():
    body = rigid("a", "cabin", 7, (1, 2, 3), (1, 2, 3))
    system = assemble(Vehicle("one", (body,), ()))
    shapes = np.random.default_rng(1).normal(size=(6, 4))
    shapes /= np.sqrt(np.einsum("ij,ij->j", shapes, system.mass @ shapes))
    assert ((rigid_rows(system, [body]) @ shapes) ** 2).sum(axis=0) == pytest.approx(np.ones(4))


def test_flexible_and_rigid_bodies_move_as_one():
    beam = Beam(6)
    rail, block = beam.body("rail"), rigid("block", "cabin", 30, (0.5, 1.0, 0.4), (1, 1, 1))
    system = assemble(Vehicle("two", (rail, block), ()))
    center = center_of_gravity(system, (rail, block))
    # The beam weighs 40 kg about x = 1 m.
    np.testing.assert_allclose(center, [(40 * 1.0 + 30 * 0.5) / 70, 30 / 70, 12 / 70], atol=1e-6)
    X = rigid_coordinates(system, (rail, block), center)
    np.testing.assert_allclose(
        system.motion("rail", beam.nodes[6]) @ X[:, 5],
        [0 + center[1], 2.0 - center[0], 0, 0, 0, 1.0],
        atol=1e-6,
    )
    yaw = X[:, 5:] / np.sqrt(X[:, 5] @ system.mass @ X[:, 5])
    assert (share_rows(system, X) @ yaw)[5, 0] ** 2 == pytest.approx(1.0)


def test_a_vehicle_that_pitches_moves_its_ends_in_proportion_to_their_station():
    system = assemble(car())
    pitch = rigid_coordinates(system, system.vehicle.bodies, np.array([0.6, 0, 0.4]))[:, 4]
    # dz = -x dθ about the station x = 0.6 m.
    np.testing.assert_allclose(end_rows(system, (0.0, 2.6)) @ pitch, [0.6, -2.0], atol=1e-12)


def test_a_beam_that_bends_beams_and_does_not_twist():
    beam = Beam(20, length=4.0)
    body = beam.body("rail")
    system = assemble(Vehicle("frame", (body,), ()))
    torsion, beaming = bending_rows(system, body)
    np.testing.assert_allclose(np.r_[torsion[:6], beaming[:6]], 0, atol=1e-7)  # rigid
    z = body.shapes[:, 2].astype(float)
    # Within 6 % of the length of the stations at 2, 50 and 98 % of it are two, three and two nodes.
    expected = (z[:2].mean(axis=0) + z[-2:].mean(axis=0)) / 2 - z[9:12].mean(axis=0)
    assert np.abs(beaming).max() > 0.1
    assert np.abs(torsion).max() < 1e-6
    np.testing.assert_allclose(np.abs(beaming), np.abs(expected), atol=1e-6)


def test_flexibility_is_amplitude_squared_over_omega_squared_and_none_for_free_modes():
    amplitudes = np.array([[5.0, 2.0, 4.0], [0.0, 0.0, 0.0]])
    share = flexibility_share(amplitudes, np.array([0.0, 10.0, 80.0]))
    np.testing.assert_allclose(share, [[0.0, 1.0, 0.5], [0.0, 0.0, 0.0]])
