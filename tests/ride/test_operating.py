import numpy as np
import pytest

from modeviz.errors import SolveError
from modeviz.ride.operating import operating_shape

RNG = np.random.default_rng(5)
H = RNG.standard_normal((4, 2)) + 1j * RNG.standard_normal((4, 2))
REFERENCE = np.array([0.0, 2.0, 0.0, -1.0])
S = np.array([[2.0, 0.9 - 0.6j], [0.9 + 0.6j, 1.0]])
"""Partly coherent: |0.9 - 0.6j|² = 1.17 of 2."""


def test_it_is_real_and_the_root_of_the_psd_at_the_reference():
    at_reference = REFERENCE @ operating_shape(H, S, REFERENCE)
    psd = REFERENCE @ (H @ S @ H.conj().T) @ REFERENCE
    assert at_reference == pytest.approx(np.sqrt(psd.real), rel=1e-12)


def test_one_input_gives_its_response_whatever_the_reference():
    amplitude = 3.0
    one = H[:, :1] * amplitude
    shape = operating_shape(H[:, :1], np.array([[amplitude**2]]), REFERENCE)
    np.testing.assert_allclose(np.abs(shape), np.abs(one[:, 0]), rtol=1e-12)
    np.testing.assert_allclose(shape[1:] / shape[0], one[1:, 0] / one[0, 0], rtol=1e-12)


def test_coherent_inputs_move_every_coordinate_by_the_root_of_its_psd():
    both = np.array([1.0, 0.5 - 2.0j])
    coherent = np.outer(both, both.conj())
    psd = np.diagonal(H @ coherent @ H.conj().T).real
    shape = operating_shape(H, coherent, REFERENCE)
    np.testing.assert_allclose(np.abs(shape), np.sqrt(psd), rtol=1e-12)


def test_what_is_not_coherent_with_the_reference_is_left_out():
    apart = np.array([[1.0 + 1.0j, 0], [0, 2.0j]])  # each coordinate has an input of its own
    shape = operating_shape(apart, np.diag([4.0, 9.0]), np.array([1.0, 0.0]))
    assert shape == pytest.approx(np.array([np.sqrt(2) * 2.0, 0.0]), rel=1e-12)


def test_it_is_the_average_over_random_motions_with_the_reference_as_clock():
    n = 200_000
    white = (RNG.standard_normal((2, n)) + 1j * RNG.standard_normal((2, n))) / np.sqrt(2)
    x = H @ np.linalg.cholesky(S) @ white
    r = REFERENCE @ x
    average = (x * r.conj()).mean(axis=1) / np.sqrt((np.abs(r) ** 2).mean())
    size = np.sqrt((np.abs(x) ** 2).mean(axis=1))
    shape = operating_shape(H, S, REFERENCE)
    # An average of n products scatters by at most √(G_xx G_rr / n) in each part.
    np.testing.assert_allclose(np.abs(shape - average) / size, 0, atol=4 / np.sqrt(n))


@pytest.mark.parametrize("input_psd", [np.zeros((2, 2)), np.full((2, 2), 1e-310)])
def test_without_power_there_is_no_shape(input_psd):
    with pytest.raises(SolveError, match="the reference does not move"):
        operating_shape(H, input_psd, REFERENCE)


def test_a_reference_that_moves_by_rounding_alone_is_an_error():
    still, reference = np.array([[0.1], [0.2], [0.3]]), np.array([1.0, 1.0, -1.0])
    assert reference @ still != 0
    with pytest.raises(SolveError, match="choose another point or direction"):
        operating_shape(still, np.ones((1, 1)), reference)
