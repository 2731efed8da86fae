"""The paper's own truncation, on two beams bolted together where the full answer is known."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from oracles import Beam, direct_system

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.truncation import modes_only
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import Bolt
from modeviz.vehicle.vehicle import Vehicle

N_KEPT = 12


def bolted_beams(n_modes=None):
    beams = {"thin": Beam(10, 2.0, mass_per_length=5.0), "thick": Beam(10, 2.0, mass_per_length=500.0)}
    ends = 0, 5, 10
    loads = [(node, d) for node in ends for d in range(3)] if n_modes else ()
    bodies = tuple(b.body(name, n_modes=n_modes, loads=loads) for name, b in beams.items())
    bolts = tuple(
        Bolt(f"bolt {i}", "bolts", ("thin", "thick"), np.tile(beams["thin"].nodes[i], (2, 1)),
             stiffness=np.full(3, 1e7))
        for i in ends
    )  # fmt: skip
    return beams, Vehicle("bolted", bodies, bolts)


def elastic_frequencies(vehicle, n=3):
    f = solve_modes(assemble(vehicle)).frequency_hz
    return f[f > 1.0][:n]


@pytest.fixture(scope="module")
def full():
    beams, vehicle = bolted_beams()
    mass, stiffness = direct_system(beams, vehicle)
    f = np.sqrt(np.maximum(scipy.linalg.eigh(stiffness, mass, eigvals_only=True), 0)) / (2 * np.pi)
    return f[f > 1.0][:3]


def test_residual_vectors_leave_the_error_that_what_they_leave_out_makes(full):
    """ω² is too high by rᵀ (K - ω²M)⁻¹ r over all that the components do not have.

    By more where that softens the residual vectors, too, which are tenths off: by less than twice as
    much. Rounding of the full model is a tenth of it.
    """
    beams, vehicle = bolted_beams(N_KEPT)
    mass, stiffness = direct_system(beams, vehicle)
    moved = scipy.linalg.block_diag(
        *(np.vstack([a.shapes for a in vehicle.body(name).attachments]) for name in beams)
    )
    left_out = scipy.linalg.null_space(moved.T @ mass)
    modes = solve_modes(assemble(vehicle), below_hz=30.0)
    elastic = modes.frequency_hz > 1.0
    found, expected = modes.frequency_hz[elastic], np.zeros(3)
    for i, shape in enumerate((moved @ modes.shapes[:, elastic]).T):
        omega_squared = (2 * np.pi * found[i]) ** 2
        Z = left_out.T @ (stiffness - omega_squared * mass)
        expected[i] = Z @ shape @ np.linalg.solve(Z @ left_out, Z @ shape) / omega_squared / 2
    with_residuals = found / full - 1
    assert (with_residuals > 0.9 * expected).all()
    assert (with_residuals < 2 * expected).all()
    modes_alone = np.abs(elastic_frequencies(modes_only(vehicle)) / full - 1).max()
    assert with_residuals.max() < 1e-4 * modes_alone


def test_modes_alone_are_the_papers_equation_set_up_by_hand():
    beams, vehicle = bolted_beams(N_KEPT)
    squares, shapes = zip(
        *(scipy.linalg.eigh(beam.stiffness, beam.mass) for beam in beams.values()), strict=True
    )
    coordinates = [6 * node + d for node in (0, 5, 10) for d in range(3)]
    thin, thick = (phi[coordinates] for phi in shapes)
    softened = 1 / (1 / 1e7 + (thin[:, N_KEPT:] ** 2 / squares[0][N_KEPT:]).sum(axis=1))
    R = np.hstack([thin[:, :N_KEPT], -thick[:, :N_KEPT]])
    K = np.diag(np.concatenate([s[:N_KEPT] * (s[:N_KEPT] > 1.0) for s in squares]))
    omega = np.sqrt(np.maximum(np.linalg.eigvalsh(K + (R.T * softened) @ R), 0.0))
    expected = omega[omega > 2 * np.pi][:3] / (2 * np.pi)
    np.testing.assert_allclose(elastic_frequencies(modes_only(vehicle)), expected, rtol=1e-7)


def test_a_bolt_with_separate_ends_is_softened_by_the_compliance_where_it_acts():
    """A force there turns the end as well: each residual vector moves the place by u + θ × r."""
    _, vehicle = bolted_beams(N_KEPT)
    bolt = vehicle.connections[1]
    assert isinstance(bolt, Bolt)
    ends = bolt.points + np.outer([0, 1], [0, 0, 0.05])
    apart = replace(bolt, points=ends, elastic_center=0.4)
    body = vehicle.body("thin")
    assert isinstance(body, FlexibleBody)
    at = body.nearest_attachment(bolt.points[0])
    residuals = at.shapes[:, -body.n_residuals :]
    moved = residuals[:3] + np.cross(residuals[3:].T, [0, 0, 0.02]).T
    compliance = (moved**2 / body.omega_n_squared[-body.n_residuals :]).sum(axis=1)
    (found,) = modes_only(replace(vehicle, connections=(apart,))).connections
    np.testing.assert_allclose(1 / found.stiffness, 1 / bolt.stiffness + compliance, rtol=1e-9)


def test_bolts_are_softened_by_the_first_bodys_residual_compliance():
    _, vehicle = bolted_beams(N_KEPT)
    beam = Beam(10, 2.0, mass_per_length=5.0)
    omega_squared, phi = scipy.linalg.eigh(beam.stiffness, beam.mass)
    left_out = phi[2, N_KEPT:] ** 2 / omega_squared[N_KEPT:]  # vertically, at the first node
    softened = modes_only(vehicle).connections[0].stiffness[2]
    assert softened == pytest.approx(1 / (1 / 1e7 + left_out.sum()), rel=1e-6)
    assert vehicle.connections[0].stiffness[2] == 1e7


def test_no_residual_vector_is_left():
    _, vehicle = bolted_beams(N_KEPT)
    assert [b.n_modes for b in modes_only(vehicle).bodies] == [N_KEPT, N_KEPT]
