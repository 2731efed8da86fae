import threading

import pytest

from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.runner import HERE
from modeviz.compute.threads import N_THREADS

SOON = 20


def times(shared, item):
    return shared * item


def test_results_come_in_the_order_of_their_items():
    assert list(HERE.map(times, 3, range(50), CancelToken())) == [3 * n for n in range(50)]


def test_nothing_has_no_results():
    assert list(HERE.map(times, 3, [], CancelToken())) == []


def join_all_but(before):
    """Waits for the end of all threads that were not there before."""
    for thread in set(threading.enumerate()) - before:
        thread.join(SOON)
        assert not thread.is_alive()


def counted(taken):
    """Items, with a list of those that were taken."""
    for n in range(1000):
        taken.append(n)
        yield n


def test_it_is_only_a_few_tasks_ahead_of_who_takes_the_results():
    taken = []
    results = HERE.map(times, 1, counted(taken), CancelToken())
    assert next(results) == 0
    assert len(taken) <= N_THREADS + 1
    results.close()


def test_what_a_task_raises_is_raised():
    def fails(shared, item):
        raise ValueError(f"item {item}")

    with pytest.raises(ValueError, match="item 0"):
        list(HERE.map(fails, None, range(5), CancelToken()))


def test_cancelled_it_ends_and_its_threads_soon():
    before = set(threading.enumerate())
    token = CancelToken()
    taken = []
    results = HERE.map(times, 1, counted(taken), token)
    next(results)
    token.cancel()
    with pytest.raises(CancelledError):
        list(results)
    assert len(taken) <= N_THREADS + 2
    join_all_but(before)


def test_cancelled_it_does_not_wait_for_what_is_being_computed():
    before = set(threading.enumerate())
    token, has_begun, may_end, ended = CancelToken(), threading.Event(), threading.Event(), []

    def held(_shared, item):
        has_begun.set()
        may_end.wait(SOON)
        ended.append(item)

    def cancel():
        has_begun.wait(SOON)
        token.cancel()

    threading.Thread(target=cancel).start()
    with pytest.raises(CancelledError):
        list(HERE.map(held, None, range(50), token))
    assert not ended
    may_end.set()
    join_all_but(before)
