from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from small_meshes import bar, plate, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.free import (
    center_of_gravity,
    free_modes,
    residual_response,
    residual_vectors,
    rigid_modes,
    static_response,
)
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.rigid import rigid_motions


@pytest.fixture(scope="module")
def body():
    return assemble(twisted_plate())


@pytest.fixture(scope="module")
def modes(body):
    return free_modes(body, 16)


@pytest.fixture(scope="module")
def loads(body):
    """Forces and couples at four nodes, none of them balanced; two are the same."""
    f = np.zeros((body.n_dofs, 6))
    f[[2, 6 * 48 + 2, 6 * 24, 6 * 30 + 3, 6 * 6 + 1, 2], np.arange(6)] = 1.0
    return f


def test_free_body_has_six_zero_modes(modes):
    assert (modes.omega_n_squared[:6] == 0).all()
    assert (modes.omega_n_squared[6:] > (2 * np.pi) ** 2).all()


def test_modes_are_orthonormal_in_mass_and_orthogonal_in_stiffness(body, modes):
    phi = modes.shapes
    np.testing.assert_allclose(phi.T @ (body.mass @ phi), np.eye(16), atol=1e-10)
    k = phi.T @ (body.stiffness @ phi)
    np.testing.assert_allclose(k, np.diag(modes.omega_n_squared), atol=1e-8 * k.max())


def test_modes_agree_with_a_dense_solution(body, modes):
    # Stiffness per mass, ω⁻² as the eigenvalue, because some rotations have no inertia.
    K = (body.stiffness + 100.0 * body.mass).toarray()
    inverse = scipy.linalg.eigh(body.mass.toarray(), K, eigvals_only=True)
    dense = 1 / inverse[::-1][:16] - 100.0
    np.testing.assert_allclose(modes.omega_n_squared[6:], dense[6:], rtol=1e-8)


def test_rigid_modes_are_rigid_motions_about_the_center_of_gravity(body):
    R = rigid_modes(body)
    about_center = rigid_motions(body.nodes - center_of_gravity(body)).reshape(-1, 6)
    weight = (about_center.T @ (body.mass @ about_center))[0, 0]
    combination = np.linalg.lstsq(about_center, R)[0]
    np.testing.assert_allclose(about_center @ combination, R, atol=1e-12)
    np.testing.assert_allclose(combination[:3, :3] * np.sqrt(weight), np.eye(3), atol=1e-6)
    np.testing.assert_allclose(combination, combination.T, atol=1e-12)


@pytest.mark.bitwise
def test_same_mesh_gives_the_same_modes(modes):
    again = free_modes(assemble(twisted_plate()), 16)
    np.testing.assert_array_equal(again.shapes, modes.shapes)


def test_largest_entry_of_an_elastic_shape_is_positive(modes):
    phi = modes.shapes[:, 6:]
    assert (phi.max(axis=0) >= 0.99 * -phi.min(axis=0)).all()


@pytest.mark.parametrize("n_modes", [5, 18])
def test_number_of_modes_must_suit_the_body(n_modes):
    with pytest.raises(SolveError, match=f"found {n_modes}, expected 6 .* to 17"):
        free_modes(assemble(bar(n=2)), n_modes)


def test_rigid_modes_alone_can_be_asked_for():
    assert free_modes(assemble(plate(2)), 6).shapes.shape == (54, 6)


def test_body_in_two_pieces_is_refused():
    one, n = bar(n=4), 5
    two = FiniteElementMesh(
        np.vstack([one.nodes, one.nodes + np.array([0.0, 1.0, 0.0])]),
        beams=np.vstack([one.beams, one.beams + n]),
        beam_sections=2 * one.beam_sections,
        beam_up=np.vstack([one.beam_up, one.beam_up]),
    )
    with pytest.raises(SolveError, match="loose"):
        free_modes(assemble(two), 10)


def test_static_response_balances_the_loads_by_inertia(body, loads):
    u = static_response(body, loads)
    R = rigid_motions(body.nodes).reshape(-1, 6)
    acceleration = np.linalg.solve(R.T @ (body.mass @ R), R.T @ loads)
    inertia = body.mass @ (R @ acceleration)
    force = body.stiffness @ u
    np.testing.assert_allclose(force, loads - inertia, atol=1e-8)
    np.testing.assert_allclose(R.T @ (body.mass @ u) / abs(u).max(), 0, atol=1e-10)


def test_static_response_of_a_free_beam_agrees_with_theory():
    # A force P at mid-span is carried by the inertia P / L of the beam: each half is a cantilever of
    # l = L / 2 under the uniform load q = P / L, whose end sags q l⁴ / (8 EI).
    length, P = 20.0, 1.0
    mesh = bar(40, length)
    f = np.zeros((6 * 41, 1))
    f[6 * 20 + 2] = P
    u = static_response(assemble(mesh), f)[2::6, 0]
    EI = 2.1e11 * 2e-8
    np.testing.assert_allclose(u[20] - u[0], P / length * (length / 2) ** 4 / (8 * EI), rtol=1e-4)


def test_residual_vectors_make_static_deflection_exact(body, modes, loads):
    residuals = residual_vectors(body, modes, loads)
    exact = static_response(body, loads)

    def from_modes(*bases):
        return sum(b.shapes @ ((b.shapes.T @ loads) / b.omega_n_squared[:, None]) for b in bases)

    elastic = replace(modes, omega_n_squared=modes.omega_n_squared[6:], shapes=modes.shapes[:, 6:])
    assert abs(from_modes(elastic) - exact).max() > 0.01 * abs(exact).max()
    np.testing.assert_allclose(from_modes(elastic, residuals), exact, atol=1e-9 * abs(exact).max())


def test_residual_vectors_are_orthogonal_to_the_modes_and_each_other(body, modes, loads):
    residuals = residual_vectors(body, modes, loads)
    phi = np.hstack([modes.shapes, residuals.shapes])
    omega_n_squared = np.r_[modes.omega_n_squared, residuals.omega_n_squared]
    np.testing.assert_allclose(phi.T @ (body.mass @ phi), np.eye(phi.shape[1]), atol=1e-10)
    k = phi.T @ (body.stiffness @ phi)
    np.testing.assert_allclose(k, np.diag(omega_n_squared), atol=1e-9 * k.max())


def test_residual_vectors_that_repeat_others_are_left_out(body, modes, loads):
    assert residual_vectors(body, modes, loads).shapes.shape[1] == 5


def test_residual_vectors_lie_above_the_modes_kept(body, modes, loads):
    residuals = residual_vectors(body, modes, loads)
    assert residuals.omega_n_squared.min() > modes.omega_n_squared.max()


def test_no_loads_give_no_residual_vectors(body, modes):
    assert residual_vectors(body, modes, np.zeros((body.n_dofs, 0))).shapes.shape == (body.n_dofs, 0)


def test_loads_that_the_modes_answer_in_full_give_no_residual_vectors():
    body = assemble(bar(n=3))
    modes = free_modes(body, 23)  # all but the stiffest, which stretches
    f = np.zeros((24, 2))
    f[2, 0] = f[0, 1] = 1.0
    assert residual_vectors(body, modes, f[:, :1]).shapes.shape == (24, 0)
    assert residual_vectors(body, modes, f).shapes.shape == (24, 1)


def test_residual_compliance_is_what_the_modes_left_out_would_add():
    body = assemble(bar(n=3))
    K, M = body.stiffness.toarray(), body.mass.toarray()
    omega_n_squared, phi = scipy.linalg.eigh(K, M)
    f = np.zeros((24, 2))
    f[2, 0] = f[13, 1] = 1.0
    left_out = f.T @ phi[:, 10:]
    exact = (left_out / omega_n_squared[10:]) @ left_out.T
    found = f.T @ residual_response(body, free_modes(body, 10), f)
    np.testing.assert_allclose(found, exact, atol=1e-8 * abs(exact).max())


def test_residual_compliance_vanishes_as_modes_are_added(body, loads):
    bases = (free_modes(body, n) for n in (8, 16, 32, 64))
    traces = [np.trace(loads.T @ residual_response(body, modes, loads)) for modes in bases]
    assert (np.diff(traces) < 0).all()
    assert traces[-1] > 0
