"""What is computed once for all, unless somebody is slow."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from modeviz.viewer.session import once
from modeviz.viewer.session.once import Once

SOON = 20


@pytest.fixture
def hanging():
    """A thing that somebody computes, who hangs until the event is set, and what that gives."""
    thing, has_begun, may_end = Once(), threading.Event(), threading.Event()

    def hang():
        has_begun.set()
        may_end.wait(2 * SOON)
        return "late"

    with ThreadPoolExecutor(2) as threads:
        late = threads.submit(thing.get, hang)
        assert has_begun.wait(SOON)
        yield thing, threads, may_end, late
        may_end.set()


def test_who_asks_while_it_is_computed_waits_for_it(hanging, monkeypatch):
    thing, threads, may_end, late = hanging
    monkeypatch.setattr(once, "WAITS", 1000.0)
    other = threads.submit(thing.get, lambda: "own")
    may_end.set()
    assert late.result(SOON) == other.result(SOON) == thing.known == "late"


def test_nobody_waits_for_one_who_hangs_and_only_the_first_tries(hanging, monkeypatch):
    thing, threads, may_end, late = hanging
    monkeypatch.setattr(once, "WAITS", 0.01)
    assert threads.submit(thing.get, lambda: "own").result(SOON) == "own"
    assert thing.known is None
    monkeypatch.setattr(once, "WAITS", 1000.0)
    assert threads.submit(thing.get, lambda: "another").result(SOON) == "another"
    may_end.set()
    assert late.result(SOON) == thing.get(lambda: "own") == "late"


def test_what_fails_is_not_kept():
    thing = Once()
    with pytest.raises(ZeroDivisionError):
        thing.get(lambda: 1 // 0)
    assert thing.get(lambda: "good") == thing.known == "good"
