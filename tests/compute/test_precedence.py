"""Answers before background work, and of that one step at a time."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from modeviz.compute.precedence import LOOKS_EVERY, Precedence

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
    precedence, done = Precedence(LONG), []
    with precedence.answer():
        with precedence.answer():
            step = threads.submit(take, precedence, done, "step")
            waits(precedence)
        done.append("one answer")
        time.sleep(2 * LOOKS_EVERY)  # it looks meanwhile
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


def test_answers_hold_a_step_up_no_longer_than_that():
    precedence, done = Precedence(0.05), []
    stop = threading.Event()

    def answer_on():
        while not stop.is_set():
            with precedence.answer():
                time.sleep(0.001)

    busy = [threading.Thread(target=answer_on) for _ in range(3)]
    for thread in busy:
        thread.start()
    take(precedence, done, "step")
    stop.set()
    for thread in busy:
        thread.join()
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
