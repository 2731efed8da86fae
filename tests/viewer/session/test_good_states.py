"""A session whose parts fail or hang: it goes on with the last state that was answered in whole."""

import threading

import pytest
from mounted_cabin import mounted_cabin
from rounding import CABIN, assert_near

from modeviz.analysis.results import Conditions
from modeviz.viewer.session import beginnings, inquiry
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.inquiry import GIVEN_UP
from modeviz.viewer.session.inspector import Inspector
from modeviz.viewer.session.notifications import Answered, Failed
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.worker import MOST_LEFT, StuckError

SOON = 20
SOFT, STIFF, BAD = 1e5, 2e5, 3.3e5
PATIENCE = 0.3


class Heard:
    """Keeps what a session tells; `fault` is called with every answer."""

    def __init__(self):
        self.answers, self.failures, self.fault = [], [], lambda solved: None

    def __call__(self, notification):
        match notification:
            case Answered(solved):
                self.fault(solved)
                self.answers.append(solved)
            case Failed():
                self.failures.append(notification)


def rate_of(state):
    return state.design.rates["A"].lateral


@pytest.fixture
def open_session():
    opened = []

    def open_session(patience=SOON):
        vehicle, heard = mounted_cabin(), Heard()
        state = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
        session = Session(vehicle, state, heard, patience)
        session.start()
        assert session.wait(SOON)
        opened.append(session)
        return session, heard

    yield open_session
    for session in opened:
        session.close()


def set_rate(session, rate):
    session.do(SetRate("A", "lateral", rate))
    return session.wait(SOON)


@pytest.fixture
def solver(monkeypatch):
    """The solver, which does what `solver.fault` does with the rate first."""

    class Solver:
        fault = staticmethod(lambda rate: None)

    solve = beginnings.solve_on

    def faulty(excitation, rates):
        Solver.fault(rates["A"].lateral)
        return solve(excitation, rates)

    monkeypatch.setattr(beginnings, "solve_on", faulty)
    return Solver


def fail_at_bad(rate):
    if rate == BAD:
        raise IndexError("a bug")


def check_goes_on(session, heard, original):
    """Undo leads to the first state, not to what failed, and the next change is solved."""
    session.undo()
    assert session.wait(SOON)
    assert session.state.design == original.design
    assert not session.can_undo
    assert set_rate(session, STIFF)
    assert rate_of(heard.answers[-1].state) == STIFF
    assert session.can_undo


def test_a_solve_that_fails_leads_back_to_the_last_state_that_was_solved(open_session, solver):
    session, heard = open_session()
    original = session.state
    set_rate(session, SOFT)
    good = heard.answers[-1]
    solver.fault = fail_at_bad
    assert set_rate(session, BAD)
    assert [type(failed.error) for failed in heard.failures] == [IndexError]
    assert heard.failures[0].is_back
    assert rate_of(session.state) == SOFT
    assert session.answer.state.design == session.state.design
    assert heard.answers[-1] is not good
    assert_near(heard.answers[-1].now.psd, good.now.psd, CABIN)
    check_goes_on(session, heard, original)


def test_who_waits_for_an_answer_that_fails_is_told_and_not_given_another(open_session, solver):
    session, _ = open_session()
    set_rate(session, SOFT)
    solver.fault = fail_at_bad
    session.do(SetRate("A", "lateral", BAD))
    with pytest.raises(IndexError, match="a bug"):
        session.wait_for_answer(SOON)
    session.do(SetRate("A", "lateral", STIFF))
    assert rate_of(session.wait_for_answer(SOON).state) == STIFF


def test_a_drag_through_a_rate_that_fails_ends_where_it_ends(open_session, solver):
    session, heard = open_session()
    original = session.state
    solver.fault = fail_at_bad
    for rate in (SOFT, BAD, STIFF):
        session.do(SetRate("A", "lateral", rate))
        assert session._loop._worker.wait(SOON)
    assert session.wait(SOON)
    assert rate_of(session.state) == rate_of(heard.answers[-1].state) == STIFF
    check_goes_on(session, heard, original)


def test_an_answer_that_cannot_be_drawn_leads_back(open_session):
    session, heard = open_session()
    original = session.state
    set_rate(session, SOFT)
    heard.fault = lambda solved: fail_at_bad(rate_of(solved.state))
    assert set_rate(session, BAD)
    assert rate_of(session.state) == rate_of(session.answer.state) == SOFT
    check_goes_on(session, heard, original)


def test_what_can_never_be_drawn_is_told_and_not_tried_for_ever(open_session):
    session, heard = open_session()
    set_rate(session, SOFT)

    def fail(_):
        raise IndexError("a bug")

    heard.fault = fail
    set_rate(session, BAD)
    assert len(heard.failures) == 2  # the new one, and going back
    heard.fault = lambda solved: None
    assert set_rate(session, STIFF)
    assert rate_of(heard.answers[-1].state) == STIFF


def test_a_state_that_never_was_answered_is_undone(open_session, solver):
    """As a record can have one that was broken off while it failed."""
    vehicle, heard = mounted_cabin(), Heard()
    session = Session(vehicle, first_state(vehicle, vehicle.rates, Conditions("flat", 20.0)), heard)
    solver.fault = fail_at_bad
    session.do(SetRate("A", "lateral", BAD))
    session.start()
    assert session.wait(SOON)
    assert rate_of(session.state) == rate_of(heard.answers[-1].state) == vehicle.rates["A"].lateral
    session.close()


def test_a_check_that_fails_is_told_once_and_leaves_the_answer(open_session, monkeypatch):
    def fail(near, now):
        raise IndexError("a bug")

    monkeypatch.setattr(inquiry, "sensitivity", fail)
    session, heard = open_session()
    set_rate(session, SOFT)
    assert session.wait_checked(SOON)
    assert session.answer.findings.problem == GIVEN_UP
    assert rate_of(session.state) == SOFT
    n_failures = len(heard.failures)
    session.draw_again()
    assert session.wait_checked(SOON)
    assert len(heard.failures) == n_failures


class Hang:
    """Hangs at a rate until it is let go."""

    def __init__(self):
        self.may_end, self.n_ended = threading.Event(), 0

    def __call__(self, rate):
        if rate == BAD:
            self.may_end.wait(SOON)
            self.n_ended += 1


def wait_for(reached):
    deadline = threading.Event()
    for _ in range(int(SOON / 0.02)):
        if reached():
            return
        deadline.wait(0.02)
    raise AssertionError("it did not come to that")


def test_a_solve_that_hangs_is_left_behind_and_what_it_brings_later_is_dropped(open_session, solver):
    session, heard = open_session(PATIENCE)
    original = session.state
    set_rate(session, SOFT)
    solver.fault = hang = Hang()
    assert set_rate(session, BAD)
    (failed,) = heard.failures
    assert isinstance(failed.error, StuckError)
    assert failed.is_back
    assert rate_of(session.state) == SOFT
    places = []
    where = failed.error.__traceback__
    while where is not None:
        places.append(where.tb_frame.f_code.co_name)
        where = where.tb_next
    assert "__call__" in places  # where it hangs
    check_goes_on(session, heard, original)
    n_answers = len(heard.answers)
    hang.may_end.set()
    wait_for(lambda: hang.n_ended)
    wait_for(lambda: not session._loop._worker._left[0].is_alive())
    assert len(heard.answers) == n_answers
    assert rate_of(session.answer.state) == STIFF


def test_only_so_many_solves_are_left_behind_and_it_goes_on_once_one_ends(open_session, solver):
    session, heard = open_session(PATIENCE)
    solver.fault = hang = Hang()
    for _ in range(MOST_LEFT):
        assert set_rate(session, BAD)
    session.do(SetRate("A", "lateral", BAD))
    assert not session.wait(3 * PATIENCE)
    assert len(heard.failures) == MOST_LEFT + 1
    assert not heard.failures[-1].is_back
    hang.may_end.set()
    assert session.wait(SOON)
    assert rate_of(session.answer.state) == BAD  # it was waited for, and is solved after all


def test_a_check_that_hangs_is_given_up_and_the_next_is_made(open_session, monkeypatch):
    may_end, find_out = threading.Event(), Inspector._find_out

    def hang(self, solved, inquiry):
        if rate_of(solved.state) == BAD:
            may_end.wait(SOON)
        find_out(self, solved, inquiry)

    monkeypatch.setattr(Inspector, "_find_out", hang)
    session, heard = open_session()
    loop = session._loop
    loop._inspector.close()
    loop._inspector = Inspector(
        Shared(loop.answers._preparations),
        loop._rebase,
        loop._is_current,
        loop.ask,
        loop._tell_failure,
        1.5,
    )
    assert set_rate(session, BAD)
    assert session.wait_checked(SOON)
    assert session.answer.findings.problem == GIVEN_UP
    assert rate_of(session.state) == BAD
    set_rate(session, STIFF)
    assert session.wait_checked(SOON)
    assert session.answer.findings.is_complete
    assert not session.answer.findings.problem
    may_end.set()
    assert [type(failed.error) for failed in heard.failures] == [StuckError]


def test_a_session_closes_while_a_solve_hangs(open_session, solver, monkeypatch):
    monkeypatch.setattr("modeviz.viewer.session.worker.CLOSING_S", 0.1)
    session, _ = open_session()
    solver.fault = hang = Hang()
    session.do(SetRate("A", "lateral", BAD))
    session.close()
    hang.may_end.set()
