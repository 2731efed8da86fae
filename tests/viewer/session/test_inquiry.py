"""What is found out about an answer by several sessions, of which one may hang."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.viewer.session import inquiry
from modeviz.viewer.session.inquiry import GIVEN_UP, Inquiry

SOON = 20


@pytest.fixture(scope="module")
def now():
    return solve(prepare(mounted_cabin()), {}, Conditions("flat", 20.0))


@pytest.fixture
def may_end():
    """Lets what hangs end."""
    return threading.Event()


@pytest.fixture
def hang(monkeypatch, may_end):
    """Has the first step of an inquiry hang in a thread; gives threads, and the step."""
    has_begun, sensitivity = threading.Event(), inquiry.sensitivity

    def hanging(*arguments):
        has_begun.set()
        may_end.wait(2 * SOON)
        return sensitivity(*arguments)

    monkeypatch.setattr(inquiry, "sensitivity", hanging)
    with ThreadPoolExecutor(2) as threads:

        def hang(shared):
            step = threads.submit(shared.advance)
            assert has_begun.wait(SOON)
            return threads, step

        yield hang
        may_end.set()


def test_nobody_waits_for_the_step_of_somebody_else(hang, may_end, now):
    shared = Inquiry(now)
    threads, step = hang(shared)
    threads.submit(shared.advance).result(SOON)
    assert not shared.findings.is_complete
    may_end.set()
    step.result(SOON)
    assert shared.findings.sensitivity is not None
    assert not shared.findings.problem


def test_an_inquiry_is_given_up_once_a_step_hangs_and_what_that_brings_is_dropped(hang, may_end, now):
    shared = Inquiry(now, patience=0.01)
    threads, step = hang(shared)
    threads.submit(shared.advance).result(SOON)
    assert shared.findings.problem == GIVEN_UP
    may_end.set()
    step.result(SOON)
    assert shared.findings.sensitivity is None
    shared.advance()
    assert shared.findings.check is None


def test_what_is_known_in_whole_is_not_given_up(now):
    shared = Inquiry(now)
    while not shared.findings.is_complete:
        shared.advance()
    shared.give_up(GIVEN_UP)
    assert not shared.findings.problem
