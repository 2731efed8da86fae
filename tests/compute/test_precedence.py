"""Answers before background work, and of that one step at a time."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack

import pytest

from modeviz.compute.precedence import Precedence

SOON, LONG = 20, 1000.0


@pytest.fixture
def threads():
    with ThreadPoolExecutor(8) as threads:
        yield threads


def waits(precedence, n=1):
    """Waits until so many steps are in the queue."""
    end = time.monotonic() + SOON
    while len(precedence._queue) < n:
        assert time.monotonic() < end
        time.sleep(0.001)


def take(precedence, done, name, is_wanted=lambda: True):
    with precedence.step(is_wanted) as is_mine:
        done.append((name, is_mine))


def test_a_step_waits_for_every_answer_that_is_being_made(threads):
    precedence, done, looks = Precedence(LONG), [], threading.Semaphore(0)

    def is_wanted():
        looks.release()
        return True

    with precedence.answer():
        with precedence.answer():
            step = threads.submit(take, precedence, done, "step", is_wanted)
            waits(precedence)
        done.append("one answer")
        while looks.acquire(blocking=False):
            pass
        assert all(looks.acquire(timeout=SOON) for _ in "ab")  # it looks in vain before the second
        done.append("other answer")
    step.result(SOON)
    assert done == ["one answer", "other answer", ("step", True)]


def test_steps_go_one_at_a_time_in_the_order_in_which_they_ask(threads):
    precedence, done = Precedence(LONG), []
    with precedence.step():
        steps = []
        for i in range(5):
            steps.append(threads.submit(take, precedence, done, i))
            waits(precedence, i + 2)
        done.append("first")
    for step in steps:
        step.result(SOON)
    assert done == ["first", *((i, True) for i in range(5))]


def test_answers_hold_a_step_up_no_longer_than_that(threads):
    """Also where at all times there is one that does not take long."""
    precedence, done = Precedence(0.3), []
    end = time.monotonic() + SOON
    with ExitStack() as first:
        first.enter_context(precedence.answer())
        open_one = first.pop_all()
        step = threads.submit(take, precedence, done, "step")
        while not step.done() and time.monotonic() < end:
            with ExitStack() as next_one:
                next_one.enter_context(precedence.answer())
                open_one.close()
                open_one = next_one.pop_all()
            time.sleep(0.001)
        is_done_meanwhile = step.done()
        open_one.close()
    step.result(SOON)
    assert is_done_meanwhile
    assert done == [("step", True)]


def test_what_hangs_holds_nobody_up(threads):
    precedence, done, may_end = Precedence(0.05), [], threading.Event()

    def hang(how):
        with how():
            may_end.wait(SOON)

    hanging = [threads.submit(hang, how) for how in (precedence.answer, precedence.step)]
    waits(precedence)
    for name in "ab":
        threads.submit(take, precedence, done, name).result(SOON)
    may_end.set()
    for each in hanging:
        each.result(SOON)
    take(precedence, done, "c")
    assert done == [("a", True), ("b", True), ("c", True)]
    assert not precedence._queue


def test_a_step_that_is_wanted_no_more_leaves_the_queue(threads):
    precedence, done, gone = Precedence(LONG), [], threading.Event()
    with precedence.answer():
        step = threads.submit(take, precedence, done, "step", lambda: not gone.is_set())
        waits(precedence)
        gone.set()
        step.result(SOON)
    assert done == [("step", False)]
    assert not precedence._queue


def test_a_step_that_fails_lets_the_next_go():
    precedence, done = Precedence(LONG), []
    with pytest.raises(ValueError, match="by mistake"), precedence.step():
        raise ValueError("by mistake")
    take(precedence, done, "next")
    assert done == [("next", True)]


def test_a_step_that_fails_as_it_waits_leaves_the_queue():
    precedence, done = Precedence(LONG), []

    def fail():
        raise ValueError("by mistake")

    with pytest.raises(ValueError, match="by mistake"):
        take(precedence, done, "step", fail)
    assert not precedence._queue
    assert not done


def test_answers_are_contended_while_there_are_two_that_do_not_hang():
    precedence, slow = Precedence(LONG), Precedence(0.01)
    with precedence.answer(), slow.answer():
        assert not precedence.is_contended
        with precedence.answer():
            assert precedence.is_contended
        assert not precedence.is_contended
        time.sleep(0.02)
        with slow.answer():
            assert not slow.is_contended
