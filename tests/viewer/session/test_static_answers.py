"""Sag beside the answers of a session: it follows rates, and is drawn as a shape that stands still."""

from dataclasses import replace

import numpy as np
import pytest
from cabin_session import Listener
from mounted_cabin import mounted_cabin
from session_commands import Alter
from small_systems import block

from modeviz.analysis.results import Conditions
from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.static_answers import StaticSolver


@pytest.fixture
def session():
    vehicle, heard = mounted_cabin(), Listener()
    session = Session(vehicle, first_state(vehicle, vehicle.rates, Conditions("flat", 20.0)), heard)
    session.start()
    assert session.wait(20)
    yield session
    session.close()
    assert not heard.failures


def expected(session, case):
    return solve_statics(prepare_statics(assemble(session.vehicle)), session.state.design.rates).case(
        case
    )


def test_sag_is_solved_with_the_rates_of_the_answer_and_of_the_set_compared_with(session):
    session.do(SetRate("A", "vertical", 1.5e5))
    assert session.wait(20)
    static = session.answer.static
    case = expected(session, "standing")
    assert static.now.case("standing").motion == pytest.approx(case.motion, rel=1e-8, abs=1e-15)
    own = solve_statics(prepare_statics(assemble(session.vehicle)), {}).case("standing")
    assert static.base.case("standing").motion == pytest.approx(own.motion, rel=1e-8, abs=1e-15)
    assert np.abs(own.motion - case.motion).max() > 1e-6


def test_sag_that_is_drawn_stands_still_and_follows_every_rate(session):
    session.do(Alter(kind="sag", load_case="braking 1 g", ghost="compared"))
    for rate in (1e5, 1.1e5, 1.2e5, 1.3e5):
        session.do(SetRate("A", "vertical", rate))
    assert session.wait(20)
    moving, case = session.answer.movement, expected(session, "braking 1 g")
    assert moving.is_still
    assert moving.heading == "Sag: braking 1 g"
    assert moving.shape == pytest.approx(case.motion, rel=1e-8, abs=1e-15)
    own = solve_statics(prepare_statics(assemble(session.vehicle)), {}).case("braking 1 g")
    assert moving.other == pytest.approx(own.motion, rel=1e-8, abs=1e-15)


def test_a_case_without_an_answer_leaves_what_moved_and_says_why(session):
    before = session.answer.movement
    session.do(Alter(kind="sag", load_case="nothing"))
    assert session.wait(20)
    assert session.answer.movement.shape is before.shape
    assert "unknown load case 'nothing'" in session.answer.movement.problem


def test_what_nothing_holds_has_a_sentence_in_place_of_an_answer():
    static = StaticSolver().solve(assemble(Vehicle("free", (block("block"),), ())), {})
    assert static.problem.startswith("load case 'standing': nothing holds 'block' along z")
    with pytest.raises(SolveError, match="nothing holds 'block'"):
        static.case("standing")


def test_the_same_rates_of_the_same_vehicle_are_solved_once(session):
    solver, system = StaticSolver(), session.prepared.system
    rates = session.vehicle.rates
    first = solver.solve(system, rates)
    assert solver.solve(system, dict(rates)) is first
    other = solver.solve(system, {**rates, "A": replace(rates["A"], vertical=1e5)})
    assert other is not first
    moved = assemble(with_placements(session.vehicle, {"A": Placement((0.1, 0, 0))}))
    assert not np.allclose(
        solver.solve(moved, rates).case("standing").motion, first.case("standing").motion
    )
