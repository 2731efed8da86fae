"""A search in a session: its thread, what the session makes of it, and how it ends."""

import threading
import time

import numpy as np
import pytest
from cabin_session import SOON, Watcher, open_session
from held_search import hold_searches
from logs import log_to
from session_commands import Alter, AlterPlan

from modeviz.errors import ModevizError, SolveError
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.run import Progress
from modeviz.optimise.verification import verify
from modeviz.scatter import searching
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.page.wire.notices import Notices
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.tasks import background_task
from modeviz.viewer.tasks import search_task as module
from modeviz.viewer.tasks.search_task import SearchTask


@pytest.fixture
def session():
    """One whose searches have few starts, unless a test wants others."""
    with open_session() as (session, _):
        plan(session, n_starts=2)
        yield session


@pytest.fixture
def said():
    return []


@pytest.fixture
def optimiser(session, said):
    watcher, notices = Watcher(), Notices(log_to(said))
    optimiser = SearchTask(session, watcher.tell, notices.mistake)
    optimiser.wait = watcher.wait
    yield optimiser
    optimiser.close()


@pytest.fixture
def gate(monkeypatch):
    """Holds every search after its first design until it is set."""
    return hold_searches(monkeypatch)


def plan(session, **fields):
    session.do(AlterPlan(**fields))


def run(optimiser):
    optimiser.start()
    optimiser.wait(lambda: not optimiser.job.is_running)
    return optimiser.job


def goal(session):
    state = session.state
    problem = planned(session.vehicle, state.design.plan)
    return prepare_goal(session.vehicle, problem, state.design.rates, state.conditions.speed)


def test_it_ends_with_the_session_at_the_best_design(session, optimiser):
    plan(session, n_starts=3)
    before, of = session.state.design.rates, goal(session)
    look = run(optimiser)
    assert look.stage == "ended"
    assert look.found.converged
    assert session.state.design.rates == look.found.rates != before
    assert of.value(session.state.design.rates) == pytest.approx(look.found.value, rel=1e-9)
    assert look.original == pytest.approx(of.value({}), rel=1e-12) == 1.0
    soft = session.vehicle.rate_sets["soft"]
    assert look.reference == pytest.approx(of.value(soft), rel=1e-12)
    values = [value for _, value in look.history]
    assert values == sorted(values, reverse=True)
    assert values[-1] == look.found.value < 1


def percentile(session, rates, seed):
    """The 95th percentile of the goal of vehicles built of parts drawn with a seed of their own."""
    objective = goal(session)
    parts = scattered_parts(objective.prepared, rates, Tolerance())
    return np.percentile(goals(objective, parts, parts.samples(2000, seed)), 95)


def test_a_robust_search_is_better_for_parts_that_were_not_in_it(session, optimiser):
    plan(session, n_starts=2)
    as_drawn = run(optimiser).found
    optimiser.go_back()
    plan(session, is_robust=True)
    look = run(optimiser)
    assert look.is_robust
    assert look.found.converged
    assert look.found.value == pytest.approx(percentile(session, look.found.rates, 7), rel=0.02)
    assert look.original == pytest.approx(percentile(session, {}, 7), rel=0.02)
    assert look.history[-1][1] == look.found.value > as_drawn.value
    assert percentile(session, look.found.rates, 7) < percentile(session, as_drawn.rates, 7)
    assert session.state.design.rates == look.found.rates


def test_a_robust_search_of_what_does_not_scatter_is_refused(session, optimiser):
    plan(session, goal="change", is_robust=True)
    look = run(optimiser)
    assert look.stage == "failed"
    assert "does not scatter" in look.failure


def test_a_robust_search_that_is_cancelled_before_it_is_robust_keeps_the_best(session, optimiser, gate):
    plan(session, n_starts=2, is_robust=True)
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.progress)
    optimiser.cancel()
    optimiser.wait(lambda: optimiser.job.stage == "ended")
    assert not optimiser.job.is_robust
    assert session.state.design.rates == optimiser.job.found.rates


def test_the_search_is_one_step_to_undo_and_redo(session, optimiser):
    plan(session, n_starts=2)
    before = session.state
    look = run(optimiser)
    session.undo()
    assert session.state == before
    session.redo()
    assert session.state.design.rates == look.found.rates


def test_what_is_accepted_is_pinned_kept_and_undone_with_the_search(session, optimiser):
    plan(session, n_starts=1)
    before = session.state
    found = run(optimiser).found.rates
    optimiser.accept()
    assert session.state.design.variants["Optimised 1"].rates == session.state.design.rates == found
    session.undo()
    assert session.state == before


def test_a_second_result_gets_a_name_of_its_own(session, optimiser):
    plan(session, n_starts=1)
    for normalised in (True, False):
        plan(session, is_normalised=normalised)
        run(optimiser)
        optimiser.accept()
    assert list(session.state.design.variants) == ["Optimised 1", "Optimised 2"]


def test_to_go_back_brings_the_rates_before_and_can_be_undone(session, optimiser):
    session.do(SetRate("A", "lateral", 2e5))
    plan(session, n_starts=1)
    before = session.state.design.rates
    found = run(optimiser).found.rates
    optimiser.go_back()
    assert session.state.design.rates == before
    session.undo()
    assert session.state.design.rates == found


def test_cancel_answers_at_once_and_keeps_the_best(session, optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    optimiser.cancel()
    n_designs = len(optimiser.job.history)
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert len(optimiser.job.history) <= n_designs + 2  # what was in hand
    look = optimiser.job
    assert look.found.reason == "cancelled"
    assert look.found.value == look.history[-1][1]
    assert session.state.design.rates == look.found.rates


@pytest.fixture
def full_model(monkeypatch):
    """Holds every exact check until it is set."""
    may_solve = threading.Event()

    def held(*arguments):
        may_solve.wait(SOON)
        return verify(*arguments)

    monkeypatch.setattr("modeviz.optimise.run.verify", held)
    monkeypatch.setattr(
        background_task, "TELL_EVERY", np.inf
    )  # the session follows no better design before
    yield may_solve
    may_solve.set()


def test_it_says_when_the_full_model_is_solved_with_the_session_at_the_best(
    session, optimiser, full_model
):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.stage == "checking")
    assert optimiser.job.is_running
    assert optimiser.job.history[-1][1] == optimiser.job.progress.value
    best = optimiser.job.progress.rates
    assert session.state.design.rates == best
    full_model.set()
    optimiser.wait(lambda: optimiser.job.stage == "ended")
    assert session.state.design.rates == best


def test_cancel_brings_the_session_to_the_best_before_the_full_model_is_solved(
    session, optimiser, full_model
):
    plan(session, n_starts=50)
    optimiser.start()
    deadline = time.monotonic() + SOON
    while len(optimiser.job.history) < 3 and time.monotonic() < deadline:
        time.sleep(0.01)  # nothing is told
    assert session.state.design.rates == optimiser.job.asked.before
    optimiser.cancel()
    assert optimiser.job.stage == "checking"
    assert session.state.design.rates != optimiser.job.asked.before


def test_cancel_between_a_search_and_its_robust_one_keeps_the_best(session, optimiser, monkeypatch):
    robustly = searching.robust_search

    def cancelled(*arguments):
        search = robustly(*arguments)
        value = search.goal.value

        def ended(rates):
            optimiser.cancel()
            return value(rates)

        object.__setattr__(search.goal, "value", ended)
        return search

    monkeypatch.setattr(searching, "robust_search", cancelled)
    plan(session, n_starts=2, is_robust=True)
    look = run(optimiser)
    assert look.stage == "ended"
    assert not look.is_robust
    assert session.state.design.rates == look.found.rates


def test_cancel_while_it_prepares_is_over_at_once_and_changes_nothing(session, optimiser, monkeypatch):
    may_prepare, before = threading.Event(), session.state
    prepare = module.prepare_search

    def slow(*args):
        may_prepare.wait(SOON)
        return prepare(*args)

    monkeypatch.setattr(module, "prepare_search", slow)
    optimiser.start()
    optimiser.cancel()
    assert not optimiser.job.is_running
    may_prepare.set()
    optimiser.close()
    assert optimiser.job.stage == "cancelled"
    assert session.state == before


def test_a_search_is_paused_before_it_began(optimiser, gate, monkeypatch):
    may_prepare, prepare = threading.Event(), module.prepare_search

    def slow(*args):
        may_prepare.wait(SOON)
        return prepare(*args)

    monkeypatch.setattr(module, "prepare_search", slow)
    optimiser.start()
    optimiser.pause()
    may_prepare.set()
    assert optimiser.job.stage == "paused"
    optimiser.resume()
    optimiser.wait(lambda: optimiser.job.history)
    optimiser.cancel()
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert optimiser.job.found.reason == "cancelled"


def test_a_paused_search_evaluates_nothing_until_it_goes_on(session, optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    optimiser.pause()
    paused = optimiser.job.progress.evaluations
    gate.set()
    optimiser._task._thread.join(0.5)
    assert optimiser.job.stage == "paused"
    assert optimiser.job.progress.evaluations == paused
    assert session.state.design.rates == optimiser.job.progress.rates
    optimiser.resume()
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert optimiser.job.found.evaluations > paused


def test_a_paused_search_is_cancelled_too(optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    optimiser.pause()
    optimiser.cancel()
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert optimiser.job.found.reason == "cancelled"


def test_a_failing_evaluation_is_told_and_leaves_the_rates_before(session, optimiser, monkeypatch):
    before, can_undo = session.state, session.can_undo
    better = {"A": MountRates(5e5, 2e5, 2e5), "B": MountRates(5e5, 2e5, 2e5)}

    def fails(search, starts, budget, token, tell):
        tell(Progress(1, better, 0.5, 1, 1))
        assert session.state.design.rates == better
        raise SolveError("no answer with A vertical 500 N/mm")

    monkeypatch.setattr(searching, "optimise", fails)
    look = run(optimiser)
    assert look.stage == "failed"
    assert look.failure == "no answer with A vertical 500 N/mm"
    assert session.state == before
    assert session.can_undo == can_undo


def test_a_mistake_of_ours_is_said_once_however_often_it_happens(optimiser, said, monkeypatch, capsys):
    def fails(search, starts, budget, token, tell):
        raise RuntimeError("a bug")

    monkeypatch.setattr(searching, "optimise", fails)
    for _ in range(3):
        assert "our mistake" in run(optimiser).failure
    (traceback,) = said
    assert "a bug" in traceback
    assert "".join(capsys.readouterr()) == ""


def test_a_plan_that_cannot_be_is_refused_and_the_next_one_is_searched(session, optimiser):
    plan(session, free=frozenset())
    with pytest.raises(ModevizError, match="no group of mounts may change"):
        optimiser.start()
    assert optimiser.job is None
    plan(session, free=frozenset({"A"}), n_starts=1)
    before = session.state.design.rates
    found = run(optimiser).found.rates
    assert found["B"] == before["B"]
    assert found["A"] != before["A"]


def test_a_second_search_is_refused_while_one_runs(optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    with pytest.raises(ModevizError, match="cancel it first"):
        optimiser.start()


def test_locked_rates_stay(session, optimiser):
    session.do(Alter(locked=frozenset({("A", "lateral")})))
    plan(session, n_starts=1)
    before = session.state.design.rates["A"]
    found = run(optimiser).found.rates["A"]
    assert found.lateral == before.lateral
    assert found.vertical != before.vertical


def test_rates_that_somebody_moves_meanwhile_are_not_taken_from_them(session, optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    session.do(SetRate("A", "vertical", 3.21e5))
    mine = session.state.design.rates
    gate.set()
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert session.state.design.rates == mine
    optimiser.accept()
    assert session.state.design.rates == optimiser.job.found.rates


def test_closing_ends_a_search(session, optimiser, gate):
    optimiser.start()
    optimiser.wait(lambda: optimiser.job.history)
    optimiser.close()
    assert not optimiser.job.is_running
    assert not any(thread.name == "search" for thread in threading.enumerate())


def test_a_mode_is_held_where_the_plan_wants_it(session, optimiser):
    yaw = session.answer.now.mode_index("cab yaw")
    now_hz = float(session.answer.now.modes.frequency_hz[yaw])
    plan(session, goal="change", mode="cab yaw", high_hz=0.8 * now_hz, n_starts=1)
    look = run(optimiser)
    assert session.wait(SOON)
    solved = session.answer
    f = solved.now.modes.frequency_hz[solved.now.mode_index("cab yaw")]
    assert 0.79 * now_hz < f <= 0.8 * now_hz
    assert look.found.verification.are_kept
