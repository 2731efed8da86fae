"""A search from start to end, as the page, the command line and a study call it."""

import pytest
from cabin_problem import cabin_search

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import SolveError
from modeviz.scatter.searching import SearchOptions, find_best
from modeviz.scatter.tolerance import Tolerance


class Follower:
    """Keeps what a search tells, and wants no robust one if it is told so."""

    def __init__(self, wants_robust=True):
        self.begun, self.told, self._wants_robust = [], [], wants_robust

    def begin(self, search, is_robust):
        self.begun.append((search, is_robust, len(self.told)))
        if is_robust and not self._wants_robust:
            raise CancelledError


def found_by(follower, search, token=None, **options):
    options = SearchOptions(starts=2, **options)
    return find_best(search, {}, options, token or CancelToken(), follower.told.append, follower.begin)


@pytest.fixture(scope="module")
def search():
    return cabin_search()


@pytest.mark.parametrize("everywhere", [False, True])
def test_it_is_told_before_the_first_design_and_how_the_goal_fell_until_the_end(search, everywhere):
    follower = Follower()
    last, optimum = found_by(follower, search, everywhere=everywhere, budget=60)
    assert follower.begun == [(search, False, 0)]
    assert last is search
    assert follower.told[-1].history == optimum.history
    evaluations, values = zip(*optimum.history, strict=True)
    assert list(evaluations) == sorted(set(evaluations))
    assert list(values) == sorted(values, reverse=True)
    assert values[-1] == optimum.value


def test_a_robust_search_begins_after_that_as_drawn_with_a_history_of_its_own(search):
    follower = Follower()
    last, optimum = found_by(follower, search, tolerance=Tolerance())
    (_, first, _), (robustly, second, n_before) = follower.begun
    assert (first, second) == (False, True)
    assert last is robustly is not search
    as_drawn, robust = follower.told[:n_before], follower.told[n_before:]
    assert as_drawn[-1].is_checking
    assert robust[0].history == ((1, robust[0].value),)
    assert robust[0].rates == as_drawn[-1].rates
    assert optimum.history[-1][1] == optimum.value


def test_where_no_robust_search_is_wanted_any_more_the_best_as_drawn_is_kept(search):
    follower = Follower(wants_robust=False)
    last, optimum = found_by(follower, search, tolerance=Tolerance())
    assert last is search
    assert optimum.value == pytest.approx(search.value(optimum.x), rel=1e-12)


def test_what_does_not_scatter_is_refused_before_anything_begins():
    follower = Follower()
    with pytest.raises(SolveError, match="does not scatter"):
        found_by(follower, cabin_search(goal="change"), tolerance=Tolerance())
    assert not follower.begun
