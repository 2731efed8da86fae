from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from small_meshes import bar

from modeviz.fem.free import free_modes, static_response
from modeviz.fem.matrices import assemble
from modeviz.fem.residuals import dynamic_residual_vectors, residual_response, residual_vectors

BOTH = pytest.mark.parametrize("vectors", [residual_vectors, dynamic_residual_vectors])


@BOTH
def test_residual_vectors_make_static_deflection_exact(body, modes, loads, vectors):
    residuals = vectors(body, modes, loads)
    exact = static_response(body, loads)

    def from_modes(*bases):
        return sum(b.shapes @ ((b.shapes.T @ loads) / b.omega_n_squared[:, None]) for b in bases)

    elastic = replace(modes, omega_n_squared=modes.omega_n_squared[6:], shapes=modes.shapes[:, 6:])
    assert abs(from_modes(elastic) - exact).max() > 0.01 * abs(exact).max()
    np.testing.assert_allclose(from_modes(elastic, residuals), exact, atol=1e-9 * abs(exact).max())


@BOTH
def test_residual_vectors_are_orthogonal_to_the_modes_and_each_other(body, modes, loads, vectors):
    residuals = vectors(body, modes, loads)
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


@BOTH
def test_no_loads_give_no_residual_vectors(body, modes, vectors):
    assert vectors(body, modes, np.zeros((body.n_dofs, 0))).shapes.shape == (body.n_dofs, 0)


@BOTH
def test_loads_that_the_modes_answer_in_full_give_no_residual_vectors(vectors):
    body = assemble(bar(n=3))
    modes = free_modes(body, 23)  # all but the stiffest, which stretches
    f = np.zeros((24, 2))
    f[2, 0] = f[0, 1] = 1.0
    assert vectors(body, modes, f[:, :1]).shapes.shape == (24, 0)
    assert vectors(body, modes, f).shapes.shape == (24, 1)


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


def test_of_receptances_dynamic_residual_vectors_leave_the_square_of_what_static_ones_do(body, loads):
    """The error of static ones falls with the fourth power of the frequency, and faster near modes."""
    M, K = body.mass.toarray(), body.stiffness.toarray()
    modes = free_modes(body, 16)
    top = np.sqrt(modes.omega_n_squared[-1])

    def error(vectors, omega):
        more = vectors(body, modes, loads)
        phi = loads.T @ np.hstack([modes.shapes, more.shapes])
        found = (phi / (np.r_[modes.omega_n_squared, more.omega_n_squared] - omega**2)) @ phi.T
        exact = loads.T @ np.linalg.solve(K - omega**2 * M, loads)
        return np.abs(found - exact).max() / np.abs(exact).max()

    static, dynamic = (
        [error(vectors, part * top) for part in (0.8, 0.4)]
        for vectors in (residual_vectors, dynamic_residual_vectors)
    )
    assert 2**4 < static[0] / static[1] < 2**8 < dynamic[0] / dynamic[1]
    assert dynamic[1] < 1e-5 < static[1]
