"""BLAS on one thread as long as somebody wants it, and on its own number afterwards."""

import pytest
import scipy.linalg  # its BLAS is another than NumPy's
from threadpoolctl import threadpool_info, threadpool_limits

from modeviz.compute.threads import N_THREADS, in_turn, one_thread, thread_pool


def n_threads():
    assert scipy.linalg
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def two_threads():
    with threadpool_limits(2, user_api="blas"):
        yield


def test_there_is_one_thread_within_and_what_there_was_after():
    with one_thread():
        assert n_threads() == {1}
        with one_thread():
            assert n_threads() == {1}
        assert n_threads() == {1}
    assert n_threads() == {2}


def test_who_leaves_first_takes_no_threads_for_those_who_stay():
    """As of two pages, or of two tasks in the threads of one worker."""
    first, second = one_thread(), one_thread()
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    assert n_threads() == {1}
    second.__exit__(None, None, None)
    assert n_threads() == {2}


def test_a_function_has_one_thread_each_time_also_after_an_error():
    @one_thread()
    def inverse(x):
        assert n_threads() == {1}
        return 1 / x

    with pytest.raises(ZeroDivisionError):
        inverse(0)
    assert n_threads() == {2}
    assert inverse(2) == 0.5
    assert n_threads() == {2}


def test_tasks_side_by_side_have_one_thread_each():
    with thread_pool() as pool:
        found = list(pool.map(lambda _: n_threads(), range(2 * N_THREADS)))
    assert found == [{1}] * (2 * N_THREADS)
    assert n_threads() == {2}


def test_no_more_is_done_ahead_than_somebody_takes_soon():
    begun = []

    def work(item):
        begun.append(item)
        return item

    with thread_pool() as pool:
        results = in_turn(pool, work, range(100))
        assert next(results) == 0
        assert len(begun) <= 2 * N_THREADS + 1
        assert list(results) == list(range(1, 100))
