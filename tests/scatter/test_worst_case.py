from itertools import product

import numpy as np
import pytest
from scattered_cabin import cabin_objective, prepared_cabin

from modeviz.optimise.objective import prepare_objective
from modeviz.optimise.peak import prepare_peak
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals, worst_corner


@pytest.fixture(scope="module")
def prepared():
    return prepared_cabin()


@pytest.fixture(scope="module", params=[prepare_objective, prepare_peak])
def objective(request):
    return cabin_objective(request.param)


@pytest.mark.parametrize("tolerance", [Tolerance(), Tolerance(0.6, 0.9)])
def test_the_worst_corner_is_the_worst_of_all(prepared, objective, tolerance):
    """The cabin has four mounts, so 2⁸ corners."""
    parts = scattered_parts(prepared, {}, tolerance)
    every = np.array(list(product((-1.0, 1.0), repeat=8)))
    values = goals(objective, parts, every)
    samples = parts.samples(60, 0)
    bad = samples[goals(objective, parts, samples).argmax()]
    found = worst_corner(objective, parts, bad)
    assert found.goal == pytest.approx(values.max(), rel=1e-12)
    np.testing.assert_array_equal(found.deviations, every[values.argmax()])


def test_its_goal_is_that_of_its_parts(prepared, objective):
    parts = scattered_parts(prepared, {}, Tolerance())
    found = worst_corner(objective, parts, np.ones(8))
    value, _ = objective.of_springs(parts.stiffness(found.deviations), np.zeros((12, 0)))
    assert found.goal == pytest.approx(value, rel=1e-9)
