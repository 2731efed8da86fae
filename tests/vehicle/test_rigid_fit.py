"""Whatever is known of a body's rigid modes tells its rigid motions: some places, turns or none."""

from dataclasses import replace

import numpy as np
import pytest
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.components import component_modes
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.motions import center_of_gravity, rigid_coordinates
from modeviz.dynamics.naming import name_modes, prepare_names
from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

RNG = np.random.default_rng(3)
PLACES = RNG.uniform(-1, 1, (7, 3))
LUMPS = RNG.uniform(1, 4, 7)
CENTER = LUMPS @ PLACES / LUMPS.sum()


def lumps(turned: bool = True, n_attachments: int = 7, n_nodes: int = 7) -> FlexibleBody:
    """Point masses that move as one rigid body, in mass-normalised modes that mix all motions."""
    motions = rigid_motions(PLACES)
    mass = np.einsum("i,iak,ial->kl", LUMPS, motions[:, :3], motions[:, :3])
    shapes = (
        motions @ np.linalg.inv(np.linalg.cholesky(mass)).T @ np.linalg.qr(RNG.normal(size=(6, 6)))[0]
    )
    if not turned:
        shapes[:, 3:] = 0
    attachments = [Attachment(f"a{i}", PLACES[i], shapes[i]) for i in range(n_attachments)]
    nodes, node_shapes = PLACES[:n_nodes], shapes[:n_nodes]
    known = tuple(attachments)
    return FlexibleBody("body", "cabin", "body", np.zeros(6), 0, 0.0, known, nodes, node_shapes)


@pytest.mark.parametrize(
    ("known", "digits"),
    [
        ({}, 1e-12),
        ({"turned": False}, 1e-12),
        ({"n_attachments": 1, "n_nodes": 0}, 1e-12),
        ({"turned": False, "n_attachments": 2}, 1e-6),  # the nodes' single precision
        ({"n_attachments": 0}, 1e-6),
    ],
)
def test_mass_and_centre_follow_from_what_is_known(known, digits):
    body = lumps(**known)
    system = assemble(Vehicle("v", (body,), ()))
    assert body.mass == pytest.approx(LUMPS.sum(), rel=digits)
    np.testing.assert_allclose(center_of_gravity(system, (body,)), CENTER, atol=10 * digits)
    X = rigid_coordinates(system, (body,), CENTER)
    arms = PLACES - CENTER
    inertia = sum(m * (a @ a * np.eye(3) - np.outer(a, a)) for m, a in zip(LUMPS, arms, strict=True))
    np.testing.assert_allclose((X.T @ X)[3:, 3:], inertia, atol=100 * digits)


@pytest.mark.parametrize("known", [{"turned": False}, {"n_attachments": 0}])
def test_bodies_of_which_little_is_known_have_named_modes(known):
    system = assemble(Vehicle("v", (lumps(**known),), ()))
    modes = solve_modes(system)
    assert len(name_modes(prepare_names(system), modes)) == 6


def test_a_body_of_which_no_place_is_known_is_refused():
    with pytest.raises(VehicleError, match="body 'body': its rigid modes move neither attachments nor"):
        lumps(n_attachments=0, n_nodes=0)


def rod() -> FlexibleBody:
    """A beam without inertia about itself: five rigid modes, two of them turning, and bending."""
    body = Beam(6).body("rod", n_modes=12)
    spins = np.abs(body.shapes[:, 3]).max(axis=(0,)) > 1e-3
    kept = np.flatnonzero(~spins)
    rigid = np.abs(body.shapes[:, 3, :6]).max(axis=0)
    T = np.linalg.svd(body.shapes[0, 3:4, :6].astype(float))[2][1:].T  # rigid modes that do not spin
    assert rigid.max() > 0

    def without_spin(shapes):
        return np.concatenate([shapes[..., :6] @ T, shapes[..., kept[kept >= 6]]], axis=-1)

    return replace(
        body,
        omega_n_squared=np.r_[np.zeros(5), body.omega_n_squared[kept[kept >= 6]]],
        attachments=tuple(replace(a, shapes=without_spin(a.shapes)) for a in body.attachments),
        shapes=without_spin(body.shapes),
    )


def test_a_rod_is_a_body_with_five_rigid_modes():
    body = rod()
    assert body.n_rigid == 5
    assert body.mass == pytest.approx(40.0, rel=1e-6)
    system = assemble(Vehicle("v", (body,), ()))
    modes = solve_modes(system)
    assert (modes.frequency_hz[:5] < 0.01).all()
    assert modes.frequency_hz[5] > 1
    names = [n.name for n in name_modes(prepare_names(system), modes)]
    assert len(set(names)) == len(names)


def test_a_rod_alone_does_every_rigid_motion_but_its_spin():
    system = assemble(Vehicle("v", (rod(),), ()))
    alone = component_modes(system, "rod")
    assert alone.names[:6] == ("fore-aft", "lateral", "bounce", "pitch", "yaw", "mode 6")
    np.testing.assert_allclose(
        alone.shapes.T @ system.mass @ alone.shapes, np.eye(alone.shapes.shape[1]), atol=1e-9
    )
    assert not alone.frequency_hz[:5].any()
    assert alone.frequency_hz[5] > 1
