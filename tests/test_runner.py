import threading

import pytest

from modeviz.tuning.control import CancelledError, Control
from modeviz.tuning.runner import HERE, N_THREADS


def times(shared, item):
    return shared * item


def test_results_come_in_the_order_of_their_items():
    assert list(HERE.map(times, 3, range(50), Control())) == [3 * n for n in range(50)]


def test_nothing_has_no_results():
    assert list(HERE.map(times, 3, [], Control())) == []


def counted(taken):
    """Items, with a list of those that were taken."""
    for n in range(1000):
        taken.append(n)
        yield n


def test_it_is_only_a_few_tasks_ahead_of_who_takes_the_results():
    taken = []
    results = HERE.map(times, 1, counted(taken), Control())
    assert next(results) == 0
    assert len(taken) <= N_THREADS + 1
    results.close()


def test_what_a_task_raises_is_raised():
    def fails(shared, item):
        raise ValueError(f"item {item}")

    with pytest.raises(ValueError, match="item 0"):
        list(HERE.map(fails, None, range(5), Control()))


def test_cancelled_it_ends_and_leaves_no_thread():
    before = set(threading.enumerate())
    control = Control()
    taken = []
    results = HERE.map(times, 1, counted(taken), control)
    next(results)
    control.cancel()
    with pytest.raises(CancelledError):
        list(results)
    assert len(taken) <= N_THREADS + 2
    assert set(threading.enumerate()) <= before
