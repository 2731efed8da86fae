"""What sessions of a vehicle have in common, and when they do what nobody waits for."""

import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from visitors import wait_until

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions, drive, solve
from modeviz.compute.precedence import Precedence
from modeviz.vehicle.alterations import Alterations
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.session import answer_loop, beginnings, inquiry, once
from modeviz.viewer.session.answer_loop import AnswerLoop
from modeviz.viewer.session.beginnings import Beginnings
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.inquiry import GIVEN_UP, Inquiry
from modeviz.viewer.session.inspector import Inspector
from modeviz.viewer.session.notifications import Failed
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.worker import StuckError

SOON = 20
FLAT = Conditions("flat", 20.0)


@pytest.fixture
def bench():
    cabin = mounted_cabin()
    return Bench(cabin, cabin.rates, FLAT)


@pytest.fixture
def opened(bench):
    """Opens a session of the cabin; gives it and what it tells."""
    sessions, patient = [], Precedence(1000.0)

    def opened(precedence=patient):
        told = []
        state, shared = bench.opening().state, bench.shared(precedence)
        sessions.append(Session(bench.vehicle, state, told.append, shared=shared))
        sessions[-1].start()
        return sessions[-1], told

    yield opened
    for session in sessions:
        session.close()


@pytest.fixture
def counted(monkeypatch):
    """How often something is solved, checked and made ready near rates."""
    counts = {"solve_on": 0, "check_exactly": 0, "near": 0}

    def count(owner, name):
        whole = getattr(owner, name)

        def counted(*arguments):
            counts[name] += 1
            return whole(*arguments)

        monkeypatch.setattr(owner, name, counted)

    count(beginnings, "solve_on")
    count(inquiry, "check_exactly")
    count(Prepared, "near")
    return counts


def test_what_sessions_begin_with_is_found_out_once_for_all(opened, counted):
    first, _ = opened()
    assert first.wait_checked(SOON)
    done = dict(counted)
    assert done["check_exactly"] == done["near"] == 1
    second, told = opened()
    assert second.wait_checked(SOON)
    assert counted == done
    assert second.answer.now is first.answer.now
    assert told[0].solved.findings.is_complete
    assert len(told) == 1


def test_a_session_that_goes_its_own_way_is_answered_and_checked_by_itself(opened, counted):
    (first, _), (second, _) = opened(), opened()
    assert first.wait_checked(SOON)
    assert second.wait_checked(SOON)
    before = counted["check_exactly"]
    second.do(SetRate("A", "lateral", 1e5))
    assert second.wait_checked(SOON)
    assert counted["check_exactly"] == before + 1
    assert second.answer.findings.is_complete
    assert second.answer.findings.check.error < 1e-8
    expected = solve(prepare(mounted_cabin()), second.state.design.rates, FLAT)
    np.testing.assert_allclose(second.answer.now.rms, expected.rms, rtol=1e-9)
    assert first.answer.now.rates["A"].lateral != 1e5


def test_other_conditions_rates_and_vehicles_have_nothing_in_common():
    cabin = mounted_cabin()
    prepared, common = prepare(cabin), Beginnings(FLAT, [cabin.rates])
    known = common.drive(prepared, Alterations(), FLAT)
    assert common.drive(prepared, Alterations(), FLAT) is known
    assert common.solve(known, cabin.rates) is common.solve(known, cabin.rates)
    rough = Conditions("rough", 20.0)
    assert common.drive(prepared, Alterations(), rough).conditions == rough
    own = drive(prepare(cabin), FLAT)
    assert common.solve(own, cabin.rates).prepared is own.prepared
    softer = {**cabin.rates, "A": replace(cabin.rates["A"], vertical=1e5)}
    assert common.solve(known, softer) is not common.solve(known, softer)
    assert common.near(own.prepared, cabin.rates) is not common.near(own.prepared, cabin.rates)


def test_the_steps_of_an_inquiry_are_done_once_whoever_takes_them(monkeypatch):
    steps = []

    def counted(results):
        for check in check_exactly(results):
            steps.append(check.n_lines)
            yield check

    monkeypatch.setattr(inquiry, "check_exactly", counted)
    shared = Inquiry(solve(prepare(mounted_cabin()), {}, FLAT))

    def advance():
        while not shared.findings.is_complete:
            shared.advance()

    threads = [threading.Thread(target=advance) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(SOON)
    assert not shared.findings.problem
    assert steps == sorted(set(steps))
    assert steps[-1] == len(shared.findings.now.frequency_hz)


def test_what_nobody_waits_for_comes_after_the_answers_of_all_sessions(opened):
    session, told = opened()
    assert session.wait_checked(SOON)
    n_told, precedence = len(told), session._loop._precedence
    with precedence.answer():
        session.do(SetRate("A", "lateral", 290e3))
        wait_until(lambda: precedence._queue and len(told) > n_told + 1)
        quick, read = (each.solved for each in told[n_told:])
        assert quick.now.rates["A"].lateral == 290e3
        assert not quick.is_detailed
        assert read.now is quick.now
        assert read.is_detailed  # for tables somebody waits
        assert read.findings.sensitivity is None
    assert session.wait_checked(SOON)
    assert session.answer.now is quick.now
    assert session.answer.is_detailed
    assert session.answer.findings.is_complete


def test_a_session_that_is_asked_for_more_gives_its_turn_up(opened):
    session, _ = opened()
    assert session.wait_checked(SOON)
    precedence = session._loop._precedence
    with precedence.answer():
        session.do(SetRate("A", "lateral", 1e5))
        wait_until(lambda: precedence._queue)
        waiting = precedence._queue[0]
        session.do(SetRate("A", "lateral", 2e5))
        wait_until(lambda: waiting not in precedence._queue)
    assert session.wait_checked(SOON)
    assert session.answer.now.rates["A"].lateral == 2e5
    assert session.answer.findings.is_complete


@pytest.fixture
def threads():
    with ThreadPoolExecutor(4) as threads:
        yield threads


@pytest.fixture
def hang(monkeypatch, threads):
    """Has the first call of something hang; gives what says that it does."""
    may_end = threading.Event()

    def hang(owner, name):
        whole, has_begun = getattr(owner, name), threading.Event()

        def hanging(*arguments):
            if not has_begun.is_set():
                has_begun.set()
                may_end.wait(2 * SOON)
            return whole(*arguments)

        monkeypatch.setattr(owner, name, hanging)
        return has_begun

    monkeypatch.setattr(once, "WAITS", 0.05)
    yield hang
    may_end.set()


@pytest.mark.parametrize("name", ["drive", "solve_on"])
def test_a_session_that_hangs_as_it_begins_holds_up_no_other(opened, hang, threads, name):
    has_begun, precedence = hang(beginnings, name), Precedence(0.05)
    threads.submit(opened, precedence)
    assert has_begun.wait(SOON)
    other, _ = threads.submit(opened, precedence).result(SOON)
    assert other.wait_checked(SOON)
    assert other.answer.findings.is_complete
    assert not other.answer.findings.problem


def test_an_answer_does_not_wait_for_what_makes_others_cheap(hang, threads, monkeypatch):
    cabin = mounted_cabin()
    prepared, common = prepare(cabin), Beginnings(FLAT, [cabin.rates])
    known = common.drive(prepared, Alterations(), FLAT)
    has_begun = hang(Prepared, "near")
    monkeypatch.setattr(once, "WAITS", 1000.0)
    threads.submit(common.near, prepared, cabin.rates)
    assert has_begun.wait(SOON)
    assert threads.submit(common.solve, known, cabin.rates).result(SOON).prepared is prepared


def check_only_the_first_is_spoilt(opened, error):
    precedence = Precedence(0.05)
    first, told = opened(precedence)
    assert first.wait_checked(SOON)
    failures = [each.error for each in told if isinstance(each, Failed)]
    assert [type(each) for each in failures] == [error]
    assert first.answer.findings.problem == GIVEN_UP
    second, told = opened(precedence)
    assert second.wait_checked(SOON)
    assert second.answer.now is first.answer.now
    assert second.answer.findings.is_complete
    assert not second.answer.findings.problem
    assert not [each for each in told if isinstance(each, Failed)]


def test_what_fails_in_one_session_is_found_out_by_the_others(opened, monkeypatch):
    failed, rebase = [], AnswerLoop._rebase

    def fail_once(loop, state):
        if not failed:
            failed.append(loop)
            raise IndexError("a bug")
        rebase(loop, state)

    monkeypatch.setattr(AnswerLoop, "_rebase", fail_once)
    check_only_the_first_is_spoilt(opened, IndexError)


def test_a_session_that_cannot_tell_of_its_mistake_shows_it(opened, monkeypatch):
    def fail(*_):
        raise IndexError("a bug")

    said = []
    monkeypatch.setattr(threading, "excepthook", lambda what: said.append(str(what.exc_value)))
    monkeypatch.setattr(AnswerLoop, "_rebase", fail)
    monkeypatch.setattr(AnswerLoop, "_tell_failure", fail)
    session, _ = opened()
    assert session.wait_checked(SOON)
    assert session.answer.findings.problem == GIVEN_UP
    assert said == ["a bug"]


def test_what_hangs_in_one_session_is_found_out_by_the_others(opened, hang, monkeypatch):
    hang(Prepared, "near")
    monkeypatch.setattr(answer_loop, "Inspector", partial(Inspector, patience=1.5))
    check_only_the_first_is_spoilt(opened, StuckError)
