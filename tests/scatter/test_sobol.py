import numpy as np
import pytest
from scipy.stats import qmc

from modeviz.errors import SolveError
from modeviz.scatter.sobol import spread

DEVIATIONS = 2 * qmc.LatinHypercube(3, rng=0).random(4000) - 1
X, Y, Z = DEVIATIONS.T


def test_shares_of_a_sum_are_those_of_its_variances():
    """Of d evenly spread over -1 to 1 the variance is 1/3, that of d² is 4/45."""
    found = spread(DEVIATIONS, 3 * X + 2 * Y**2)
    total = 9 / 3 + 4 * 4 / 45
    np.testing.assert_allclose(found.shares, [3 / total, 16 / 45 / total, 0], atol=2e-3)
    assert found.rest == pytest.approx(0, abs=2e-3)


def test_what_two_make_together_is_rest():
    """The variance of d d' is 1/9."""
    found = spread(DEVIATIONS, X + Y * Z)
    np.testing.assert_allclose(found.shares, [3 / 4, 0, 0], atol=0.02)
    assert found.rest == pytest.approx(1 / 4, abs=0.02)


def test_no_spread_has_no_shares():
    found = spread(DEVIATIONS, np.ones(len(X)))
    np.testing.assert_array_equal(found.shares, 0)
    assert found.rest == 0


def test_few_samples_are_an_error():
    with pytest.raises(SolveError, match=r"found 27 samples, expected 28 or more"):
        spread(DEVIATIONS[:27], X[:27])
