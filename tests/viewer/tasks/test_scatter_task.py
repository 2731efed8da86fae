"""Mounts that scatter, in a session."""

import threading

import numpy as np
import pytest
from cabin_session import SOON, Watcher, open_session
from session_commands import Alter, AlterPlan
from visitors import wait_until

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError, SolveError
from modeviz.scatter import driving
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.state import ResponseCurve
from modeviz.viewer.tasks import scatter_task as module
from modeviz.viewer.tasks.scatter_task import ScatterTask, outcome

CURVE = ResponseCurve(0, "lateral")


@pytest.fixture
def session():
    with open_session() as (session, heard):
        session.answers = heard.answers
        yield session


@pytest.fixture
def scatterer(session):
    watcher = Watcher()

    def finish():
        watcher.wait(lambda: not scatterer.job.is_running)
        return scatterer.job

    scatterer = ScatterTask(session, watcher.tell, print)
    scatterer.finish = finish
    yield scatterer
    scatterer.cancel()


@pytest.fixture
def gate(monkeypatch):
    """Holds every scatter before its first vehicle until it is set."""
    may_go, scatter = threading.Event(), driving.scatter

    def held(*arguments, **keywords):
        may_go.wait(SOON)
        return scatter(*arguments, **keywords)

    monkeypatch.setattr(driving, "scatter", held)
    return may_go


def test_nine_of_ten_vehicles_stay_within_the_band(session, scatterer, monkeypatch):
    kept = []
    monkeypatch.setattr(module, "outcome", lambda told: kept.append(told) or outcome(told))
    scatterer.start(400)
    scatterer.finish()
    found = kept[0].scatter
    low, high = scatterer.band(session.state, CURVE)
    psd = found.psd[:, :, 0, 1]
    within = ((low <= psd) & (psd <= high)).mean(axis=0)
    np.testing.assert_allclose(within, 0.9, atol=0.01)


def test_the_page_is_drawn_again_when_the_band_is_there(session, scatterer):
    assert session.wait_checked(SOON)
    n_before = len(session.answers)
    scatterer.start(400)
    scatterer.finish()
    wait_until(lambda: len(session.answers) > n_before, SOON)
    assert session.wait(SOON)
    assert session.answers[-1].is_detailed


def test_a_band_is_of_its_rates_road_and_speed_only(session, scatterer):
    assert scatterer.band(session.state, CURVE) is None
    scatterer.start(400)
    scatterer.finish()
    session.do(SetRate("A", "vertical", 3e5))
    assert scatterer.band(session.state, CURVE) is None
    session.undo()
    assert scatterer.band(session.state, CURVE) is not None
    session.do(Alter(load="front left radial force"))
    assert scatterer.band(session.state, CURVE) is None
    session.do(Alter(load="", conditions=Conditions("rough", 20.0)))
    assert scatterer.band(session.state, CURVE) is None


def test_cancel_is_over_at_once_and_the_next_one_is_its_own(session, scatterer, gate):
    scatterer.start(400)
    scatterer.cancel()
    assert scatterer.job.phase == "cancelled"
    scatterer.start(300)
    gate.set()
    assert scatterer.finish().found.record["samples"] == 300


def test_a_second_one_is_refused_while_one_runs(scatterer, gate):
    scatterer.start(400)
    with pytest.raises(ModevizError, match="cancel it first"):
        scatterer.start(400)
    gate.set()
    scatterer.finish()


def test_a_failure_is_told(scatterer, monkeypatch):
    def fails(*arguments, **keywords):
        raise SolveError("an undamped resonance")

    monkeypatch.setattr(driving, "scatter", fails)
    scatterer.start(400)
    assert scatterer.finish().failure == "an undamped resonance"


@pytest.mark.parametrize(("goal", "looked_at"), [("peak", "peak"), ("change", "accelerations")])
def test_where_the_goal_does_not_scatter_the_accelerations_do(session, scatterer, goal, looked_at):
    session.do(AlterPlan(goal=goal))
    scatterer.start(300)
    look = scatterer.finish()
    assert look.asked.problem.goal == looked_at
    assert look.found.record["quantities"]["goal"]["nominal"] == pytest.approx(1.0, rel=1e-9)
