"""What a session computes at length, in its study."""

import json
import time

import pytest
from cabin_session import SOON, Watcher, open_session
from session_commands import AlterPlan

from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.viewer.session.encoding.text import text_of
from modeviz.viewer.session.recorded import recorded
from modeviz.viewer.tasks.front_task import FrontTask
from modeviz.viewer.tasks.run_recorder import RunRecorder
from modeviz.viewer.tasks.scatter_task import ScatterTask
from modeviz.viewer.tasks.search_task import SearchTask

KEY = StudyFile.session_id("a key")


def runs(study, count):
    """The runs in a study, once there are so many: it is told after who waits above."""
    end = time.monotonic() + SOON
    while len(found := study.runs(KEY)) < count and time.monotonic() < end:
        time.sleep(0.05)
    return found


@pytest.fixture
def bench(tmp_path):
    """A session of which a study keeps searches and scatter, and who waits for them."""
    with open_session() as (session, _):
        study = StudyFile.open(tmp_path / "runs.modeviz", "cabin", fingerprint_of(session.vehicle))
        study.begin(KEY)
        watcher = Watcher()
        session.do(AlterPlan(n_starts=1))
        tasks = {
            "search": SearchTask(session, watcher.tell, print),
            "front": FrontTask(session, watcher.tell, print),
            "scatter": ScatterTask(session, watcher.tell, print),
        }
        RunRecorder(study, KEY, lambda: "Ada", tasks, lambda run: None)
        yield session, study, tasks, watcher
        for task in tasks.values():
            task.cancel()
        study.close()


def test_what_a_search_and_a_scatter_found_is_kept_and_told_when_a_session_is_opened_again(bench):
    session, study, tasks, watcher = bench
    tasks["search"].start()
    watcher.wait(lambda: not tasks["search"].job.is_running)
    found = tasks["search"].job.found
    tasks["scatter"].start(4)
    watcher.wait(lambda: not tasks["scatter"].job.is_running)
    tasks["scatter"].start(5)
    tasks["scatter"].cancel()
    search, scatter, cancelled = sorted(
        runs(study, 3), key=lambda run: (run.kind != "search", run.title)
    )
    problem = session.state.design.plan.problem
    assert (
        search.title == f"{problem}, 1 start: {tasks['search'].job.original:.4g} to {found.value:.4g}"
    )
    record = json.loads(search.record)
    assert (record["phase"], record["value"]) == ("ended", found.value)
    assert record["rates"]["A"]["lateral"] == found.rates["A"].lateral
    assert search.author == "Ada"
    assert search.duration > 0
    assert scatter.title == "4 vehicles on flat"
    assert json.loads(scatter.record)["quantities"]["goal"]["p95"] > 0
    assert cancelled.title == "5 vehicles on flat, cancelled"
    study.look(KEY, text_of(session.state))
    vehicle = session.vehicle
    opening = recorded(study, KEY, session.state, vehicle, fingerprint_of(vehicle).digest)
    assert {run.title for run in opening.runs} == {search.title, scatter.title, cancelled.title}
