"""A long computation beside a session."""

import threading

import pytest

from modeviz.errors import ModevizError, SolveError
from modeviz.viewer.tasks.background_task import BackgroundTask

SOON = 20


class Works:
    """Computations that end when they are told to, whether somebody wants them or not."""

    def __init__(self):
        self._told = threading.Condition()
        self.may_end = {name: threading.Event() for name in ("first", "second")}
        self.beside = BackgroundTask("work", self._work, self._tell, print)

    def _tell(self):
        with self._told:
            self._told.notify_all()

    def _work(self, name, token, tell):
        assert self.may_end[name].wait(SOON)
        return name.upper()

    def wait(self, reached):
        with self._told:
            assert self._told.wait_for(reached, SOON)


@pytest.fixture
def works():
    return Works()


def started(beside, asked):
    """Starts a computation; gives its thread."""
    before = set(threading.enumerate())
    beside.start(asked)
    (thread,) = (t for t in set(threading.enumerate()) - before if t.name == "work")
    return thread


def test_what_was_found_is_there_at_the_end(works):
    works.beside.start("first")
    assert works.beside.job.is_running
    works.may_end["first"].set()
    works.wait(lambda: not works.beside.job.is_running)
    job = works.beside.job
    assert (job.phase, job.done, job.found) == ("ended", 1.0, "FIRST")


def test_only_one_runs_at_a_time(works):
    works.beside.start("first")
    with pytest.raises(ModevizError, match="a work is running: cancel it first"):
        works.beside.start("second")
    works.may_end["first"].set()


def test_what_was_cancelled_stays_so_whatever_it_still_finds(works):
    thread = started(works.beside, "first")
    works.beside.cancel()
    works.may_end["first"].set()
    thread.join(SOON)
    assert (works.beside.job.phase, works.beside.job.found) == ("cancelled", None)


def test_what_was_cancelled_tells_nothing_of_the_next(works):
    thread = started(works.beside, "first")
    works.beside.cancel()
    works.beside.start("second")
    works.may_end["first"].set()
    thread.join(SOON)
    job = works.beside.job
    assert (job.asked, job.phase, job.found) == ("second", "running", None)
    works.may_end["second"].set()
    works.wait(lambda: works.beside.job.found == "SECOND")


@pytest.mark.parametrize(
    ("error", "said"), [(SolveError("too stiff"), "too stiff"), (RuntimeError("a bug"), "our mistake")]
)
def test_a_failure_is_told(error, said):
    def fails(asked, token, tell):
        raise error

    failed, reported = threading.Event(), []
    beside = BackgroundTask("work", fails, lambda: beside.job.failure and failed.set(), reported.append)
    beside.start(None)
    assert failed.wait(SOON)
    assert beside.job.phase == "failed"
    assert said in beside.job.failure
    assert reported == [error] * isinstance(error, RuntimeError)
