"""Absorbers added in a session: answers are as of a vehicle made so; removed, nothing is left."""

from dataclasses import replace

import numpy as np
import pytest
from cabin_session import SOON, open_session
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.errors import VehicleError
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.viewer.session.commands.absorbers import AddAbsorber, RemoveAbsorber, WeighAbsorber
from modeviz.viewer.session.commands.decisions import (
    AddVariant,
    LinkRates,
    Load,
    Pin,
    PlaceMounts,
    SetRate,
    ToggleLock,
)
from modeviz.viewer.session.commands.looks import ChooseCurve, CompareWith, ShowMode
from modeviz.viewer.session.design import rate_sets
from modeviz.viewer.session.state import ForceCurve, ResponseCurve, first_state

FLAT = Conditions("flat", 20.0)
ROOF = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)


@pytest.fixture
def session():
    with open_session() as (session, _):
        yield session


def assert_as_fresh(session, vehicle):
    now = session.wait_for_answer(SOON).now
    fresh = solve(prepare(vehicle), session.state.design.rates, FLAT)
    np.testing.assert_allclose(now.modes.frequency_hz, fresh.modes.frequency_hz, rtol=1e-9)
    np.testing.assert_allclose(now.psd, fresh.psd, rtol=1e-7, atol=1e-12 * np.abs(fresh.psd).max())


def test_an_added_absorber_is_tuned_and_moved_as_a_mount_and_gives_what_a_fresh_solve_gives(session):
    session.do(AddAbsorber(ROOF))
    session.do(SetRate("roof", "vertical", 3e4))
    session.do(SetRate("roof", "damping_vertical", 250.0))
    session.do(SetRate("A", "vertical", 5e5))
    session.do(PlaceMounts("roof", "offset", (0.3, None, None)))
    moved = replace(ROOF, position=(1.3, 0.2, 1.4))
    assert_as_fresh(session, with_absorbers(mounted_cabin(), [moved]))
    assert session.wait_checked(SOON)
    assert session.answer.findings.check.error < 1e-6


def test_added_and_removed_nothing_is_left_of_it(session):
    before = session.state.design
    session.do(Pin("before"))
    pinned = session.state.design
    session.do(AddAbsorber(ROOF))
    session.do(Pin("with it"))
    session.do(ToggleLock("roof", "vertical"))
    session.do(LinkRates("roof", True))
    session.do(PlaceMounts("roof", "offset", (None, None, 0.05)))
    session.wait_for_answer(SOON)
    session.do(ShowMode("roof bounce"))
    session.do(ChooseCurve(0, ForceCurve("roof", "z")))
    session.do(RemoveAbsorber("roof"))
    after = session.state
    assert session.wait_for_answer(SOON).now.vehicle.rates == mounted_cabin().rates
    assert after.group == ""
    assert after.charts.curves[0] == ResponseCurve(0, "lateral")
    session.do(Load("with it"))
    assert session.state.design.rates == before.rates
    left = {**session.state.design.variants}
    del left["with it"]
    assert left == pinned.variants
    for name in ("rates", "locked", "linked", "plan", "alterations"):
        assert getattr(session.state.design, name) == getattr(before, name)


def test_a_search_may_change_its_rate_and_its_damping():
    problem = Problem("ride", (DesignGroup("A"),), (Performance(np.array([5.0]), ("flat",)),))
    vehicle = replace(mounted_cabin(), problems=(problem,))
    plan = first_state(vehicle, vehicle.rates, FLAT).design.with_absorber(ROOF).plan
    assert plan is not None
    *_, roof = plan.groups
    assert (roof.group, roof.free) == ("roof", {"vertical", "damping_vertical"})
    assert "roof" in plan.free


def test_adding_and_removing_are_undone_and_redone(session):
    first = session.state.design
    session.do(AddAbsorber(ROOF))
    added = session.state.design
    session.do(RemoveAbsorber("roof"))
    assert session.state.design == first
    session.undo()
    assert session.state.design == added
    session.undo()
    assert session.state.design == first
    session.redo()
    with_it = session.wait_for_answer(SOON).now.vehicle
    assert [body.name for body in with_it.bodies] == ["cab", "chassis", "roof mass"]


def test_a_set_pinned_before_has_the_absorber_as_it_was_added(session):
    session.do(AddVariant("soft", {"A": mounted_cabin().rate_sets["soft"]["A"]}))
    session.do(AddAbsorber(ROOF))
    session.do(CompareWith("soft"))
    base = session.wait_for_answer(SOON).base
    own = session.vehicle.mount_group("roof").rates
    assert base.rates["roof"] == own
    assert rate_sets(session.vehicle, session.state.design)["soft"]["roof"] == own


def test_another_mass_keeps_its_frequency_and_what_it_was_tuned_to(session):
    session.do(AddAbsorber(ROOF))
    session.do(SetRate("roof", "vertical", 3e4))
    session.do(WeighAbsorber("roof", 9.0))
    assert session.state.design.rates["roof"].vertical == pytest.approx(4.5e4)
    assert session.wait_for_answer(SOON).now.vehicle.body("roof mass").mass == 9.0
    with pytest.raises(VehicleError, match="mass: found -1"):
        session.do(WeighAbsorber("roof", -1.0))
    session.undo()
    assert session.state.design.rates["roof"].vertical == 3e4


@pytest.mark.parametrize(
    ("absorber", "words"),
    [
        (Absorber("A", "cab", (1, 0, 1), 5, 9), "there twice"),
        (Absorber("roof", "roof", (1, 0, 1), 5, 9), "unknown body 'roof'"),
    ],
)
def test_what_cannot_be_added_is_refused_and_changes_nothing(session, absorber, words):
    before = session.state
    with pytest.raises(VehicleError, match=words):
        session.do(AddAbsorber(absorber))
    assert session.state == before
