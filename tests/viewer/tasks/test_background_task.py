"""A long computation beside a session."""

import threading

import pytest

from modeviz.errors import ModevizError, SolveError
from modeviz.viewer.session.worker import StuckError
from modeviz.viewer.tasks.background_task import MOST_LEFT, BackgroundTask, Job

SOON = 20


class Works:
    """Computations that end when they are told to, whether somebody wants them or not."""

    def __init__(self):
        self._told = threading.Condition()
        self.may_end = {name: threading.Event() for name in ("first", "second")}
        self.task = BackgroundTask("work", self._work, self._tell, print)

    def _tell(self):
        with self._told:
            self._told.notify_all()

    def _work(self, job, token, tell):
        assert self.may_end[job.asked].wait(SOON)
        return job.asked.upper()

    def wait(self, reached):
        with self._told:
            assert self._told.wait_for(reached, SOON)


@pytest.fixture
def works():
    return Works()


def started(task, asked):
    """Starts a computation; gives its thread."""
    before = set(threading.enumerate())
    task.start(Job(asked))
    (thread,) = (t for t in set(threading.enumerate()) - before if t.name == "work")
    return thread


def test_what_was_found_is_there_at_the_end(works):
    works.task.start(Job("first"))
    assert works.task.job.is_running
    works.may_end["first"].set()
    works.wait(lambda: not works.task.job.is_running)
    job = works.task.job
    assert (job.phase, job.done, job.found) == ("ended", 1.0, "FIRST")


def test_only_one_runs_at_a_time(works):
    works.task.start(Job("first"))
    with pytest.raises(ModevizError, match="a work is running: cancel it first"):
        works.task.start(Job("second"))
    works.may_end["first"].set()


def test_what_was_cancelled_stays_so_whatever_it_still_finds(works):
    thread = started(works.task, "first")
    works.task.cancel()
    works.may_end["first"].set()
    thread.join(SOON)
    assert (works.task.job.phase, works.task.job.found) == ("cancelled", None)


def test_what_was_cancelled_tells_nothing_of_the_next(works):
    thread = started(works.task, "first")
    works.task.cancel()
    works.task.start(Job("second"))
    works.may_end["first"].set()
    thread.join(SOON)
    job = works.task.job
    assert (job.asked, job.phase, job.found) == ("second", "running", None)
    works.may_end["second"].set()
    works.wait(lambda: works.task.job.found == "SECOND")


@pytest.mark.parametrize(
    ("error", "said"), [(SolveError("too stiff"), "too stiff"), (RuntimeError("a bug"), "our mistake")]
)
def test_a_failure_is_told(error, said):
    def fails(job, token, tell):
        raise error

    failed, reported = threading.Event(), []
    task = BackgroundTask("work", fails, lambda: task.job.failure and failed.set(), reported.append)
    task.start(Job(None))
    assert failed.wait(SOON)
    assert task.job.phase == "failed"
    assert said in task.job.failure
    assert reported == [error] * isinstance(error, RuntimeError)


def test_what_is_held_waits_at_its_next_check_and_is_cancelled_too():
    held, seen = threading.Event(), []

    def work(job, token, tell):
        assert held.wait(SOON)
        token.check()
        seen.append("went on")

    task = BackgroundTask("work", work, print, print)
    thread = started(task, None)
    task.pause()
    assert (task.job.phase, task.job.is_running) == ("paused", True)
    held.set()
    thread.join(0.1)
    assert not seen
    task.close()
    assert not thread.is_alive()
    assert (task.job.phase, seen) == ("cancelled", [])


def test_what_is_awaited_ends_after_it_was_cancelled_with_what_it_found():
    class Awaited(Job):
        is_awaited = True

    may_end = threading.Event()
    task = BackgroundTask("work", lambda *_: may_end.wait(SOON) and "best", lambda: None, print)
    task.start(Awaited(None))
    task.cancel()
    assert task.job.phase == "ending"
    may_end.set()
    task.close()
    assert (task.job.phase, task.job.found) == ("ended", "best")


def test_the_first_word_on_how_far_it_is_does_not_wait_for_what_was_told_at_once():
    may_begin, done = threading.Event(), []

    def work(job, token, tell):
        assert may_begin.wait(SOON)
        tell(at_once=True, done=0.1)
        for part in (0.2, 0.3):
            tell(done=part)

    task = BackgroundTask("work", work, lambda: done.append(task.job.done), print)
    thread = started(task, None)
    may_begin.set()
    thread.join(SOON)
    assert done == [0.0, 0.1, 0.2, 1.0]


def test_what_never_asks_its_token_is_given_up_after_a_while_and_says_where_it_hangs():
    may_end, reported = threading.Event(), []

    def work(job, token, tell):
        may_end.wait(SOON)
        return "late"

    def report(error):
        reported.append(error)
        return "abc123"

    ended = threading.Event()
    task = BackgroundTask("work", work, lambda: task.job.is_running or ended.set(), report, 0.3)
    thread = started(task, "it")
    assert ended.wait(SOON)
    may_end.set()
    thread.join(SOON)
    assert (task.job.phase, task.job.found) == ("failed", None)
    assert "abc123" in task.job.failure
    assert [type(error) for error in reported] == [StuckError]


def test_what_asks_its_token_or_is_held_does_not_hang():
    may_end = threading.Event()

    def work(job, token, tell):
        while not may_end.wait(0.02):
            token.check()
        return "best"

    task = BackgroundTask("work", work, lambda: None, print, 0.3)
    thread = started(task, "it")
    thread.join(0.8)
    task.pause()
    thread.join(0.8)
    assert task.job.phase == "paused"
    task.resume()
    may_end.set()
    thread.join(SOON)
    assert (task.job.phase, task.job.found) == ("ended", "best")


def test_only_so_many_that_were_cancelled_run_on():
    may_end = threading.Event()
    task = BackgroundTask("work", lambda *_: may_end.wait(SOON), lambda: None, print)
    for _ in range(MOST_LEFT):
        thread = started(task, "it")
        task.cancel()
    with pytest.raises(ModevizError, match="have not ended: wait for them"):
        task.start(Job("it"))
    may_end.set()
    thread.join(SOON)


def test_everybody_is_told_of_a_job_before_it_does_anything():
    told, is_told = [], threading.Event()

    def work(job, token, tell):
        told.append("works")
        return job.asked

    task = BackgroundTask("work", work, lambda: None, print)
    task.watch(lambda job: (told.append(job.phase), job.phase == "ended" and is_told.set()))
    task.watch(lambda _: is_told.wait(0.2))
    task.start(Job("first"))
    assert is_told.wait(SOON)
    assert told == ["running", "works", "ended"]
