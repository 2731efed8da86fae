"""Absorbers added in a session: answers are as of a vehicle made so; removed, nothing is left."""

from dataclasses import replace

import numpy as np
import pytest
from cabin_session import SOON, open_session
from mounted_cabin import mounted_cabin

from modeviz.analysis.mode_tracking import follow
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.errors import VehicleError
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.viewer.session.commands.absorbers import AddAbsorber, RemoveAbsorber, WeighAbsorber
from modeviz.viewer.session.commands.decisions import (
    LinkRates,
    Load,
    Pin,
    PlaceMounts,
    ResetGroups,
    ResetRate,
    SetRate,
    Swap,
    ToggleLock,
)
from modeviz.viewer.session.commands.looks import (
    ChangeMotion,
    ChooseCurve,
    CompareWith,
    ShowComparedGhost,
    ShowMode,
)
from modeviz.viewer.session.design import ORIGINAL
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


def test_removed_nothing_is_left_of_it_but_in_the_sets_that_were_pinned_with_it(session):
    before = session.state.design
    session.do(Pin("before"))
    pinned = session.state.design
    session.do(AddAbsorber(ROOF))
    session.do(Pin("with it"))
    with_it = session.state.design
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
    left = {**session.state.design.variants}
    del left["with it"]
    assert left == pinned.variants
    for name in ("rates", "locked", "linked", "plan", "alterations"):
        assert getattr(session.state.design, name) == getattr(before, name)
    session.do(Load("with it"))
    assert session.state.design == with_it


def test_sets_that_were_there_before_it_are_compared_without_it(session):
    session.do(Pin("before"))
    session.do(AddAbsorber(ROOF))
    session.do(SetRate("A", "vertical", 5e5))
    session.do(Pin("with it"))
    fresh = solve(prepare(mounted_cabin()), {}, FLAT)
    for name in (ORIGINAL, "before"):
        session.do(CompareWith(name))
        base = session.wait_for_answer(SOON).base
        assert base.rates == mounted_cabin().rates
        assert [body.name for body in base.prepared.vehicle.bodies] == ["cab", "chassis"]
        np.testing.assert_allclose(base.psd, fresh.psd, rtol=1e-9, atol=0)
    session.do(CompareWith("with it"))
    session.do(RemoveAbsorber("roof"))
    solved = session.wait_for_answer(SOON)
    assert "roof" in solved.base.rates
    assert "roof" not in solved.now.rates


def test_swapping_takes_the_absorber_away_and_brings_it_back(session):
    session.do(AddAbsorber(ROOF))
    session.do(SetRate("roof", "vertical", 3e4))
    added = session.state.design
    session.do(Swap())
    assert session.state.design.rates == mounted_cabin().rates
    assert session.state.design.alterations == Alterations()
    swapped = session.wait_for_answer(SOON)
    assert "roof" in swapped.base.rates
    session.do(Swap())
    assert session.state.design.rates == added.rates
    assert session.state.design.alterations == added.alterations
    assert session.state.against == ORIGINAL


def test_modes_are_paired_by_the_bodies_that_both_have_and_its_own_is_new(session):
    session.do(AddAbsorber(ROOF))
    solved = session.wait_for_answer(SOON)
    base, now, track = solved.base, solved.now, solved.followed.track
    shared = slice(0, 12)  # two rigid bodies, before the absorber's six coordinates
    mass = base.prepared.system.mass
    shares = (base.modes.shapes.T @ mass @ now.modes.shapes[shared]) ** 2
    np.testing.assert_allclose(track.shares, shares, atol=1e-9)
    pairs = {pair.after: pair.before for pair in solved.followed.pairs if pair.after is not None}
    own = now.mode_index("roof bounce")
    assert own is not None
    assert pairs[own] is None
    others = [mode for mode in pairs if mode != own and now.modes.frequency_hz[mode] > 0.5]
    assert all(pairs[mode] is not None for mode in others)
    back = follow(now, base)
    np.testing.assert_allclose(back.shares, track.shares.T, atol=1e-9)


def test_a_mode_whose_name_is_gone_with_it_is_followed_by_its_shape_and_found_again(session):
    session.do(ShowMode("front bounce", session.state.design.rates))
    session.wait_for_answer(SOON)
    tuned = Absorber("roof", "cab", (1.2, 0.6, 1.4), 6.0, 4.0454, 0.0477)
    session.do(AddAbsorber(tuned))
    solved = session.wait_for_answer(SOON)
    assert solved.now.mode_index("front bounce") is None
    was = solved.base.mode_index("front bounce")
    assert solved.followed.mode == solved.followed.track.shares[was].argmax()
    session.do(RemoveAbsorber("roof"))
    assert session.wait_for_answer(SOON).followed.name.name == "front bounce"


def test_the_shape_compared_with_rests_where_it_has_no_body(session):
    session.do(AddAbsorber(ROOF))
    session.do(ShowComparedGhost(True))
    for command in (
        ChangeMotion(kind="mode"),
        ChangeMotion(kind="operating shape"),
        ChangeMotion(kind="sag"),
    ):
        session.do(command)
        moving = session.wait_for_answer(SOON).movement
        assert moving.problem == ""
        assert moving.other is not None
        assert len(moving.other) == len(moving.shape) == 18
        assert not moving.other[12:].any()
        assert moving.other[:12].any()


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


def test_rates_of_what_the_set_compared_with_is_without_stay_as_they_are(session):
    session.do(AddAbsorber(ROOF))
    session.do(SetRate("roof", "vertical", 3e4))
    session.do(SetRate("A", "vertical", 5e5))
    session.do(ResetRate("roof", "vertical"))
    session.do(ResetGroups(tuple(session.state.design.rates)))
    assert session.state.design.rates["roof"].vertical == 3e4
    assert session.state.design.rates["A"] == mounted_cabin().rates["A"]


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
