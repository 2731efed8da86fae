import numpy as np
import pytest
import scipy.linalg

from modeviz.dynamics.trust import EDGE, count_below, frequency_error, gap_error, missed


def random_system(rng, n_dofs=9, n_springs=4):
    A, B = rng.normal(size=(2, n_dofs, n_dofs))
    return A @ A.T, B @ B.T + np.eye(n_dofs), rng.normal(size=(n_springs, n_dofs))


@pytest.mark.parametrize("seed", range(40))
def test_modes_are_counted_as_the_eigenproblem_has_them(seed):
    rng = np.random.default_rng(seed)
    K, M, R = random_system(rng)
    change = rng.choice([-1, 0, 1], 4) * 10 ** rng.uniform(-3, 9, 4)
    before = scipy.linalg.eigvalsh(K, M)
    after = scipy.linalg.eigvalsh(K + (R.T * change) @ R, M)
    for top in (0.1, 1.0, 10.0):
        receptance = R @ np.linalg.solve(K - top * M, R.T)
        counted = count_below(np.count_nonzero(before < top), receptance, change)
        assert counted == np.count_nonzero(after < top)


def test_modes_that_were_not_found_are_missed():
    assert missed(3, np.array([1.0, 2.0]), top=5.0) == 1
    assert missed(2, np.array([1.0, 2.0, 7.0]), top=5.0) == 0


def test_a_mode_too_many_is_as_wrong():
    assert missed(1, np.array([1.0, 2.0]), top=5.0) == 1


def test_a_mode_at_the_very_top_may_count_or_not():
    at_top = np.array([1.0, 5.0 * (1 - EDGE / 2)])
    assert missed(1, at_top, top=5.0) == missed(2, at_top, top=5.0) == 0
    assert missed(4, at_top, top=5.0) == 1


def ritz_error(rng, off):
    """ω², its errors and residuals in a basis that is `off` the true vectors."""
    omega_squared = np.cumsum(rng.uniform(1, 5, 8))
    vectors = np.linalg.qr(np.eye(8) + off * rng.normal(size=(8, 8))).Q[:, :5]
    found, y = np.linalg.eigh(vectors.T @ (omega_squared[:, None] * vectors))
    x = vectors @ y
    residual = np.linalg.norm(omega_squared[:, None] * x - found * x, axis=0)
    return found, found - omega_squared[:5], residual


@pytest.mark.parametrize("seed", range(10))
def test_the_error_of_an_eigenvalue_is_of_second_order_in_its_residual(seed):
    # Above the fifth none is found, and for the others gaps to what was found stand for true ones.
    found, error, residual = ritz_error(np.random.default_rng(seed), off=1e-4)
    stated = gap_error(found, residual)[:4]
    assert (error[:4] <= 1.5 * stated).all()
    assert (stated <= residual[:4] ** 2).all()  # no gap is less than one


def test_of_close_eigenvalues_the_residual_itself_is_the_error():
    stated = gap_error(np.array([1.0, 1.0 + 1e-9, 50.0]), np.full(3, 1e-3))
    np.testing.assert_allclose(stated, [1e-3, 1e-3, 1e-6 / 49], rtol=1e-6)


def test_an_error_of_omega_squared_is_one_of_frequency():
    omega = 2 * np.pi * 10.0
    # ω² + 2ω δ is (ω + δ)², but for δ².
    found = frequency_error(np.array([omega**2, 0.0, -1e-9]), np.array([2e-3 * omega, 1e-6, 1e-6]))
    np.testing.assert_allclose(found, np.array([1e-3, 1e-3, 1e-3]) / (2 * np.pi), rtol=1e-5)
