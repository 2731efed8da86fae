import numpy as np
import pytest
from cabin_problem import cabin_search
from rounding import CABIN, SEARCHED, SEARCHED_X

from modeviz.compute.cancel import CancelToken
from modeviz.compute.runner import HERE
from modeviz.optimise.run import optimise, optimise_on
from modeviz.optimise.starts import start_points


@pytest.fixture(scope="module")
def search():
    return cabin_search()


@pytest.fixture(scope="module")
def starts(search):
    return start_points(search, {}, 4)


def test_side_by_side_finds_what_one_after_the_other_does(search, starts):
    found, expected = optimise_on(HERE, search, starts), optimise(search, starts)
    np.testing.assert_allclose(found.x, expected.x, atol=SEARCHED_X)
    assert found.value == pytest.approx(expected.value, rel=SEARCHED)
    assert len(found.descents) == len(expected.descents)


def test_every_end_of_a_search_is_told(search, starts):
    told = []
    found = optimise_on(HERE, search, starts, tell=told.append)
    assert [p.start for p in told if not p.is_checking] == [1, 2, 3, 4]
    assert told[-1].value == found.value
    assert told[-1].evaluations == found.evaluations


def test_cancelled_it_keeps_the_best_so_far(search, starts):
    token = CancelToken()
    found = optimise_on(HERE, search, starts, token=token, tell=lambda _: token.cancel())
    assert found.reason == "cancelled"
    assert not found.converged
    assert found.value == pytest.approx(optimise(search, starts[:1]).value, rel=SEARCHED)


def test_cancelled_before_anything_was_found_it_gives_the_better_of_the_first_starts(search, starts):
    token = CancelToken()
    token.cancel()
    found = optimise_on(HERE, search, starts, token=token)
    assert found.reason == "cancelled"
    assert found.x.tolist() == starts[1].tolist()
    assert found.value == pytest.approx(search.value(starts[1]), rel=CABIN)
    assert found.value < 0.99 * search.value(starts[0])


def test_a_budget_is_shared_evenly(search):
    starts = search.space.samples(4, seed=0)
    found = optimise_on(HERE, search, starts, budget=12)
    assert [d.evaluations for d in found.descents] == [3, 3, 3, 3]
    assert found.reason == "out of budget"
