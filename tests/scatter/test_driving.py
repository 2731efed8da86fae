"""Scatter from start to end, as the page, the command line and a study call it."""

from functools import partial

import pytest
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin
from scattered_cabin import FLAT, prepared_cabin

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.scatter.driving import ScatterOptions, drive_many
from modeviz.scatter.monte_carlo import CHUNK
from modeviz.scatter.tolerance import Tolerance


@pytest.fixture
def cancelled():
    token = CancelToken()
    token.cancel()
    vehicle = mounted_cabin()
    options = ScatterOptions(10_000, Tolerance())
    return partial(
        drive_many,
        vehicle,
        prepared_cabin,
        vehicle.rates,
        FLAT,
        PROBLEM,
        options,
        token,
        lambda done: None,
    )


def test_cancelled_a_few_vehicles_are_driven_nevertheless(cancelled):
    assert len(cancelled().scatter.goal) == CHUNK
    assert len(cancelled(at_least=3).scatter.goal) == 3


def test_cancelled_by_who_wants_nothing_of_it_nothing_is_driven(cancelled):
    with pytest.raises(CancelledError):
        cancelled(at_least=0)
