import threading
import time
from contextvars import copy_context

import pytest
from visitors import wait_until

from modeviz.viewer.page.wire.turns import MOST_OF_ONE, N_THREADS, Turns, page_heard


@pytest.fixture
def errors():
    return []


@pytest.fixture
def turns(errors):
    turns = Turns(lambda _, error: errors.append(error))
    yield turns
    turns.shutdown()


def submit(turns, page, call, *arguments):
    """Has something called for a page, as viser does while it handles a message of it."""

    def handled():
        page_heard.set(page)
        return turns.submit(call, *arguments)

    return copy_context().run(handled)


def test_a_call_is_called_with_its_arguments_and_its_result_is_there(turns):
    assert submit(turns, "a", max, 1, 3).result(5) == 3
    assert turns.submit(max, 1, 2).result(5) == 2  # of nobody


def test_pages_with_much_to_do_leave_threads_to_others(turns):
    """As many pages as there are threads, each with calls that do not end."""
    go_on, begun = threading.Event(), threading.Event()
    for page in range(N_THREADS // MOST_OF_ONE - 1):
        for _ in range(2 * N_THREADS):
            submit(turns, page, go_on.wait, 10)
    submit(turns, "another", begun.set)
    assert begun.wait(5)
    go_on.set()


def test_pages_take_turns_in_the_order_in_which_they_came():
    order, go_on = [], threading.Event()
    turns = Turns(lambda page, error: None)
    for i in range(N_THREADS):
        submit(turns, f"holds {i}", go_on.wait, 10)
    for _ in range(100):
        submit(turns, "floods", order.append, "floods")
    submit(turns, "moves", order.append, "moves")
    go_on.set()
    wait_until(lambda: len(order) == 101)
    turns.shutdown()
    assert order.index("moves") <= 2 * MOST_OF_ONE


def test_calls_of_a_page_that_wait_are_counted(turns):
    go_on = threading.Event()
    calls = [submit(turns, "a", go_on.wait, 10) for _ in range(MOST_OF_ONE + 3)]
    assert (turns.n_waiting("a"), turns.n_waiting("b")) == (3, 0)
    go_on.set()
    for call in calls:
        assert call.result(5)
    assert turns.n_waiting("a") == 0


def test_a_call_that_fails_is_reported_and_the_next_is_called(turns, errors):
    assert submit(turns, "a", lambda: 1 / 0).result(5) is None
    assert submit(turns, "a", lambda: 1).result(5) == 1
    assert [type(error) for error in errors] == [ZeroDivisionError]


def test_nothing_is_lost_of_many_pages_at_once(turns):
    done = []

    def say(page):
        for i in range(200):
            submit(turns, page, done.append, (page, i))
            if i % 50 == 0:
                time.sleep(0.001)

    pages = [threading.Thread(target=say, args=(page,)) for page in range(25)]
    for page in pages:
        page.start()
    for page in pages:
        page.join()
    wait_until(lambda: len(done) == 25 * 200)
    assert len(set(done)) == 25 * 200
