"""The front of a trade-off, in a session."""

import threading
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from cabin_session import SOON, Watcher, open_session
from session_commands import AlterPlan

from modeviz.errors import ModevizError, VehicleError
from modeviz.viewer.tasks import front_task as module
from modeviz.viewer.tasks.front_task import FrontTask

OFFER = "lateral against vertical"


@pytest.fixture
def session():
    with open_session() as (session, _):
        yield session


@pytest.fixture(autouse=True)
def short(monkeypatch):
    """Fronts of a few designs, each searched from few."""
    monkeypatch.setattr(module, "find_front", partial(module.find_front, n_designs=4))
    monkeypatch.setattr(module, "N_STARTS", 1)


@pytest.fixture
def trader(session):
    watcher = Watcher()
    trader = FrontTask(session, watcher.tell, print)
    trader.wait = watcher.wait
    yield trader
    trader.cancel()


def test_on_the_front_neither_goal_falls_unless_the_other_rises(trader):
    assert trader.offers() == (OFFER,)
    trader.start(OFFER)
    trader.wait(lambda: not trader.job.is_running)
    assert trader.job.phase == "ended"
    lateral, vertical = np.transpose([design.values for design in trader.job.found])
    assert len(lateral) > 1
    assert (np.diff(lateral) > 0).all()
    assert (np.diff(vertical) < 0).all()
    assert all(design.verification.difference < 1e-9 for design in trader.job.found)


def test_a_design_is_loaded_and_undone(session, trader):
    before = session.state
    trader.start(OFFER)
    trader.wait(lambda: not trader.job.is_running)
    trader.load(trader.job.found[1])
    assert session.state.design.rates == trader.job.found[1].rates
    session.undo()
    assert session.state == before


def test_cancel_keeps_the_designs_found_by_then(trader, monkeypatch):
    find, may_go = module.find_front, threading.Event()

    def held(*arguments, tell, **keywords):
        def hold(progress):
            tell(progress)
            may_go.wait(SOON)

        return find(*arguments, tell=hold, **keywords)

    monkeypatch.setattr(module, "find_front", held)
    trader.start(OFFER)
    trader.wait(lambda: trader.job.found)
    found = trader.job.found
    trader.cancel()
    assert trader.job.phase == "cancelled"
    may_go.set()
    assert trader.job.found is found


def test_of_a_plan_that_cannot_be_it_is_said_why(session, trader):
    session.do(AlterPlan(free=frozenset()))
    for asked in (trader.offers, partial(trader.start, OFFER)):
        with pytest.raises(VehicleError, match="no group of mounts may change"):
            asked()


def test_what_the_plan_no_longer_offers_is_refused(session, trader):
    lateral = frozenset({"lateral"})
    loads = tuple(replace(load, directions=lateral) for load in session.state.design.plan.loads)
    session.do(AlterPlan(loads=loads))
    assert trader.offers() == ()
    with pytest.raises(ModevizError, match="trade-off"):
        trader.start(OFFER)
    assert trader.job is None


def test_a_goal_without_sides_is_told(session, trader):
    session.do(AlterPlan(goal="rating"))
    trader.start(OFFER)
    trader.wait(lambda: not trader.job.is_running)
    assert "has no points and directions to trade" in trader.job.failure
