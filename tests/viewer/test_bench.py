"""What the sessions of a vehicle share."""

import threading
from concurrent.futures import ThreadPoolExecutor, wait

import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.results import Conditions
from modeviz.viewer.serving import bench as rules
from modeviz.viewer.serving.bench import Bench

SOON = 20


class StoppedError(Exception):
    """A session wants its vehicle otherwise by now."""


@pytest.fixture
def bench():
    cabin = mounted_cabin()
    return Bench(cabin, cabin.rates, Conditions("flat", 20.0))


def test_a_session_that_wants_no_more_does_not_end_the_preparation_of_another(bench, monkeypatch):
    has_begun, both_wait, told = threading.Event(), threading.Event(), []

    def prepare(vehicle, progress):
        has_begun.set()
        assert both_wait.wait(SOON)
        progress(0.5)
        progress(1.0)
        return vehicle

    def stopped(fraction):
        raise StoppedError

    class Waiting(list):
        def append(self, each):
            super().append(each)
            if len(self) == 2:
                both_wait.set()

    monkeypatch.setattr(rules, "prepare", prepare)
    bench._told = Waiting()
    with ThreadPoolExecutor() as sessions:
        first = sessions.submit(bench.prepared, told.append)
        assert has_begun.wait(SOON)
        second = sessions.submit(bench.prepared, stopped)
        assert first.result(SOON) is second.result(SOON) is bench.vehicle
    assert told == [0.5, 1.0]
    assert bench._told == []


def test_a_session_ends_its_own_preparation(bench, monkeypatch):
    def stopped(fraction):
        raise StoppedError

    monkeypatch.setattr(rules, "prepare", lambda vehicle, progress: progress(0.5))
    with pytest.raises(StoppedError):
        bench.prepared(stopped)
    assert not bench.is_prepared


def test_a_review_that_begins_while_another_ends_can_be_looked_at(bench):
    with ThreadPoolExecutor() as sessions:
        sharing = []

        class Slow(dict):
            def items(self):
                found = tuple(super().items())
                sharing.append(sessions.submit(bench.share, "shown", "Ada"))
                wait(sharing, 0.2)
                return found

        bench._reviews = Slow()
        bench.end_reviews("ended")
        key = sharing[0].result(SOON)
    assert bench.reviewed(key) == "shown"
