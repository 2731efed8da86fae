import threading
from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from rounding import CABIN, assert_near
from session_commands import Alter, Listener

from modeviz.analysis.mode_tracking import follow, solve_followed
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.errors import SolveError
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.author import OWNER, Author, NotOnesOwnError
from modeviz.viewer.session.commands.decisions import (
    AddVariant,
    Forget,
    Pin,
    Rename,
    SetRate,
    Swap,
    TakenNameError,
    TakeRates,
)
from modeviz.viewer.session.commands.looks import ChangeCharts, CompareWith, Drive, Overlay, ShowMode
from modeviz.viewer.session.notifications import Answered
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state

FLAT = Conditions("flat", 20.0)


@pytest.fixture
def session():
    """A session whose answers are kept in `session.answers`, its failures in `session.failures`."""
    vehicle = mounted_cabin()
    heard = Listener()
    session = Session(vehicle, first_state(vehicle, vehicle.rates, FLAT), heard)
    session.answers, session.failures = heard.answers, heard.failures
    yield session
    session.close()
    assert not heard.failures or session.expects_failure


def test_it_opens_with_the_vehicles_own_rates_and_the_cabins_yaw(session):
    session.start()
    assert session.wait(20)
    solved = session.answers[-1]
    assert solved.now.names[solved.followed.mode].name == "cab yaw"
    assert_near(solved.now.psd, solved.base.psd, CABIN)


def test_a_name_that_no_mode_has_opens_with_the_slowest_that_is_not_free(session):
    loose = dict.fromkeys("AB", MountRates(0, 0, 0))
    session.do(Alter(mode="nothing yaw", rates=loose))
    session.start()
    assert session.wait(20)
    solved = session.answers[-1]
    f = solved.now.modes.frequency_hz
    assert solved.followed.mode == np.flatnonzero(f > 0.5)[0] == 6


def test_a_change_of_rates_is_answered_with_what_solve_gives(session):
    session.start()
    session.do(SetRate("A", "lateral", 1e5))
    session.do(TakeRates({"B": MountRates(5e5, 2e5, 3e5)}))
    assert session.wait(20)
    solved = session.answers[-1]
    vehicle = mounted_cabin()
    rates = {"A": replace(vehicle.rates["A"], lateral=1e5), "B": MountRates(5e5, 2e5, 3e5)}
    expected = solve(prepare(vehicle), rates, FLAT)
    assert (np.abs(solved.now.psd - expected.psd) < 1e-8 * expected.psd.max(axis=0)).all()
    assert solved.state.design.rates == rates


def test_moving_a_rate_selects_its_group(session):
    session.do(SetRate("B", "lateral", 1e5))
    assert session.state.group == "B"


def test_the_cabin_is_called_after_its_heaviest_body_wherever_that_is_listed():
    vehicle = mounted_cabin()
    hood = replace(vehicle.bodies[0], name="hood", label="hood", mass=50.0)
    for bodies in ((hood, *vehicle.bodies), (*vehicle.bodies, hood)):
        state = first_state(replace(vehicle, bodies=bodies), vehicle.rates, FLAT)
        assert state.motion.mode == "cab yaw"


def test_the_last_of_many_quick_changes_is_what_stays(session):
    session.start()
    for rate in np.linspace(1e5, 9e5, 60):
        session.do(SetRate("A", "vertical", rate))
    assert session.wait(30)
    assert session.answers[-1].state.design.rates["A"].vertical == 9e5
    assert len(session.answers) < 60


def test_changes_from_several_threads_are_all_kept(session):
    session.start()
    threads = [
        threading.Thread(target=session.do, args=(SetRate(g, d, 2e5),))
        for g in "AB"
        for d in ("vertical", "lateral", "fore_aft")
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert session.wait(30)
    assert session.answers[-1].state.design.rates == {g: MountRates(2e5, 2e5, 2e5) for g in "AB"}


def test_looking_at_another_mode_solves_nothing(session):
    session.start()
    assert session.wait(20)
    before = session.answers[-1]
    session.do(Alter(mode=before.now.names[8].name))
    assert session.wait(20)
    assert session.answers[-1].now is before.now
    assert session.answers[-1].followed.mode == 8


def test_a_mode_is_followed_by_its_name_and_in_phase(session):
    session.start()
    assert session.wait(20)
    for scale in np.linspace(1.0, 0.3, 12):
        before = session.answers[-1].followed
        session.do(TakeRates({g: MountRates(8e5 * scale, 3e5 * scale, 4e5 * scale) for g in "AB"}))
        assert session.wait(20)
        now = session.answers[-1].followed
        assert now.now.names[now.mode].name == "cab yaw"
        assert before.shape @ now.now.prepared.system.mass @ now.shape > 0
    first, last = session.answers[0].followed, session.answers[-1].followed
    assert last.now.modes.frequency_hz[last.mode] < first.now.modes.frequency_hz[first.mode]


def test_another_road_or_speed_is_solved_for_both_sets_of_rates(session):
    session.start()
    assert session.wait(20)
    flat = session.answers[-1]
    session.do(Alter(conditions=Conditions("rough", 20.0)))
    assert session.wait(20)
    rough = session.answers[-1]
    # Four times the power is twice the RMS.
    np.testing.assert_allclose(rough.base.rms, 2 * flat.base.rms, rtol=1e-12)
    np.testing.assert_allclose(rough.now.rms, 2 * flat.now.rms, rtol=1e-12)


def test_a_failure_is_told_and_the_session_goes_on(session):
    session.start()
    session.expects_failure = True
    session.do(Alter(conditions=Conditions("moon", 20.0)))
    assert session.wait(20)
    assert "unknown random load 'moon'" in str(session.failures[-1])
    session.do(Alter(conditions=FLAT))
    assert session.wait(20)
    assert session.answers[-1].now.conditions == FLAT


def test_while_rates_move_details_come_now_and_then_and_always_at_the_end(session):
    session.start()
    assert session.wait(20)
    for rate in np.linspace(9e5, 4e5, 30):
        session.do(SetRate("A", "vertical", rate))
        assert session._loop._worker.wait(20)
    assert session.wait(20)
    moved = session.answers[1:]
    assert not all(a.is_detailed for a in moved)
    last = moved[-1]
    assert last.is_detailed
    assert last.state.design.rates["A"].vertical == 4e5
    shares = follow(last.base, last.now).shares
    np.testing.assert_allclose(last.followed.track.shares, shares, atol=1e-12)


def test_an_answer_at_rest_is_checked_against_the_full_model(session):
    session.start()
    session.do(TakeRates({"A": MountRates(5e5, 2e5, 3e5)}))
    assert session.wait_checked(60)
    check = session.answers[-1].findings.check
    assert check.is_complete
    assert check.error < 1e-8


def test_the_track_is_that_from_the_bases_modes_whatever_came_between(session):
    session.start()
    target = {"A": MountRates(4e5, 2e5, 2e5)}
    for rates in ({"A": MountRates(8e5, 6e5, 1e5)}, {"A": MountRates(2e5, 3e5, 9e5)}, target):
        session.do(TakeRates(rates))
        assert session.wait(20)
    expected = solve_followed(prepare(mounted_cabin()), target).track
    found = session.answers[-1].followed.track
    np.testing.assert_array_equal(found.index, expected.index)
    np.testing.assert_allclose(found.mac, expected.mac, atol=1e-6)


SIDEWAYS_RIGID = dict.fromkeys("AB", MountRates(1e4, 1e7, 1e4))
"""No mode is a yaw of the cab alone."""

TWO_LATERAL = {"A": MountRates(4.49e5, 1.2e4, 4.2e4), "B": MountRates(2.21e5, 3.73e5, 2.4e4)}
"""There is a "cab lateral" and a "cab lateral 2"."""


def go(session, *ways):
    """Which mode is shown at the end."""
    for rates in ways:
        session.do(TakeRates(rates))
        assert session.wait(20)
    return session.answers[-1].followed.mode


def in_steps(start, end, count):
    """Rates on the way in equal ratios, the end included."""
    for part in np.arange(1, count + 1) / count:
        yield {
            group: MountRates(
                *(np.array(start[group].as_tuple()) ** (1 - part) * np.array(r.as_tuple()) ** part)
            )
            for group, r in end.items()
        }


@pytest.mark.parametrize("end", [SIDEWAYS_RIGID, TWO_LATERAL])
@pytest.mark.parametrize("name", ["cab yaw", "cab lateral", "cab roll"])
def test_which_mode_is_shown_depends_on_the_rates_and_not_on_the_way(session, name, end):
    session.start()
    session.do(ShowMode(name))
    own = session.vehicle.rates
    at_once = go(session, end)
    assert go(session, own, *in_steps(own, end, 7)) == at_once
    assert go(session, *in_steps(end, own, 4)) == go(session, own)
    assert session.answers[-1].followed.name.name == name
    assert go(session, {"A": MountRates(1e7, 1e4, 1e7), "B": MountRates(1e4, 1e6, 1e7)}, end) == at_once


def test_a_namesake_is_followed_by_its_shape_and_not_by_its_number(session):
    session.start()
    own = session.vehicle.rates
    go(session, TWO_LATERAL)
    session.do(ShowMode("cab lateral 2"))
    assert session.wait(20)
    solved = session.answers[-1]
    assert solved.followed.name.name == "cab lateral 2"
    chosen, start = solved.followed.mode, solved.now
    go(session, own)
    solved = session.answers[-1]
    mac = (start.momentum[:, chosen] @ solved.now.modes.shapes) ** 2
    assert solved.followed.name.name == "cab lateral"
    assert solved.followed.mode == mac.argmax()
    session.undo()
    assert session.wait(20)
    assert session.answers[-1].followed.name.name == "cab lateral 2"
    session.redo()
    assert session.wait(20)
    assert session.answers[-1].followed.mode == solved.followed.mode


@pytest.mark.parametrize("rate", [1e16, 1e22])
def test_a_mode_that_is_chosen_with_rates_without_an_answer_is_looked_for_in_the_present(session, rate):
    session.start()
    session.do(ShowMode("cab yaw", {"A": MountRates(rate, rate, rate)}))
    assert session.wait(20)
    assert session.answers[-1].followed.name.name == "cab yaw"


def test_the_classic_error_is_found_only_if_it_is_asked_for(session):
    session.start()
    session.do(TakeRates({"A": MountRates(2e5, 1e5, 1e5)}))
    assert session.wait(20)
    assert session.answers[-1].classic_error is None
    session.do(Alter(classic=True))
    assert session.wait(20)
    # The cabin's twelve base modes span every shape it has.
    assert session.answers[-1].classic_error.error < 1e-9


def test_from_nearly_rigid_mounts_the_original_comes_back_exactly(session):
    session.start()
    own = session.vehicle.rates
    session.do(TakeRates({"A": MountRates(1e12, 1e12, 1e12)}))
    assert session.wait_checked(60)
    session.do(TakeRates({"A": own["A"], "B": replace(own["B"], lateral=3.1e5)}))
    assert session.wait_checked(60)
    solved = session.answers[-1]
    expected = solve(prepare(session.vehicle), solved.state.design.rates, FLAT)
    assert (np.abs(solved.now.psd - expected.psd) < 1e-8 * expected.psd.max(axis=0)).all()
    assert solved.findings.check.error < 1e-8


def test_undo_and_redo_are_answered(session):
    session.start()
    original = session.state
    session.do(SetRate("A", "lateral", 1e5))
    session.undo()
    assert session.wait(20)
    assert session.state == original
    assert session.answers[-1].state == original
    assert not session.can_undo
    session.redo()
    assert session.wait(20)
    assert session.answers[-1].now.rates["A"].lateral == 1e5


def test_all_is_compared_with_the_set_chosen(session):
    session.start()
    session.do(Alter(against="Soft"))
    assert session.wait(20)
    solved = session.answers[-1]
    prepared = prepare(mounted_cabin())
    expected = solve(prepared, session.vehicle.rate_sets["soft"], FLAT)
    np.testing.assert_allclose(solved.base.psd, expected.psd, rtol=1e-9)
    np.testing.assert_allclose(
        solved.followed.track.shares, follow(solved.base, solved.now).shares, atol=1e-12
    )


def test_a_pinned_set_is_solved_and_forgotten(session):
    session.start()
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Pin("Mine"))
    session.do(TakeRates(session.vehicle.rates))
    session.do(Alter(against="Mine", overlaid=frozenset({"Mine"})))
    assert session.wait(20)
    solved = session.answers[-1]
    assert solved.base.rates["A"].lateral == 1e5
    assert list(solved.named.results) == ["Original", "Soft", "Mine"]
    session.do(Forget("Mine"))
    assert session.wait(20)
    assert list(session.answers[-1].named.results) == ["Original", "Soft"]
    assert session.state.against == "Original"
    assert not session.state.charts.overlaid


def test_a_set_whose_pinning_is_undone_is_compared_with_no_longer(session):
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Pin("Mine"))
    session.do(CompareWith("Mine"))
    session.do(Overlay("Mine", True))
    session.undo()
    assert session.state.against == "Original"
    assert not session.state.charts.overlaid
    session.start()
    assert session.wait(20)
    assert session.answers[-1].base.rates == session.vehicle.rates


def test_looks_at_a_set_follow_its_name_back_and_forth_through_undo_and_redo(session):
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Pin("Mine"))
    session.do(CompareWith("Mine"))
    session.do(Rename("Mine", "Yours"))
    session.do(Overlay("Yours", True))
    for step, name in ((session.undo, "Mine"), (session.redo, "Yours"), (session.undo, "Mine")):
        step()
        assert (session.state.against, session.state.charts.overlaid) == (name, {name})
    session.undo()
    assert (session.state.against, session.state.charts.overlaid) == ("Original", frozenset())
    session.redo()
    assert (session.state.against, session.state.charts.overlaid) == ("Mine", {"Mine"})


def test_what_is_asked_just_before_an_older_state_is_answered_is_drawn_all_the_same(session):
    session.start()
    assert session.wait_checked(60)
    heard, answer = [], session._loop._worker._work
    session._loop._notify = heard.append

    def ask_first(job):
        session._loop._worker._work = answer
        session.do(ChangeCharts(decibels=False))
        answer(job)

    session._loop._worker._work = ask_first
    session.do(ChangeCharts(log_frequency=True))
    assert session.wait_checked(60)
    drawn = [said.solved.state for said in heard if isinstance(said, Answered)]
    assert drawn[-1] == session.state


def test_pinned_sets_follow_the_road(session):
    session.start()
    session.do(Pin("Mine"))
    assert session.wait(20)
    flat = session.answers[-1].named.results["Mine"]
    session.do(Alter(conditions=Conditions("rough", 20.0)))
    assert session.wait(20)
    np.testing.assert_allclose(session.answers[-1].named.results["Mine"].rms, 2 * flat.rms, rtol=1e-12)


def test_the_vehicles_own_sets_cannot_be_replaced_or_forgotten(session):
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Pin("Original"))
    session.do(Forget("Soft"))
    assert not session.state.design.variants


def test_pinning_replaces_no_other_set_without_a_word(session):
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Pin("Mine"))
    session.do(Pin("Mine"))  # it is that set
    session.do(SetRate("A", "lateral", 2e5))
    with pytest.raises(TakenNameError, match="another set called Mine") as refusal:
        session.do(Pin("Mine"))
    assert refusal.value.free == "Mine 2"
    assert session.state.design.variants["Mine"].rates["A"].lateral == 1e5
    session.do(Pin("Mine", replaces=True))
    assert session.state.design.variants["Mine"].rates["A"].lateral == 2e5
    session.undo()
    assert session.state.design.variants["Mine"].rates["A"].lateral == 1e5


def test_only_ones_own_changes_are_gone_over_and_by_the_owner_all(session):
    anna, first = Author("Anna", "2"), session.state
    session._asked._acting = lambda: anna
    session.do(SetRate("A", "lateral", 1e5))
    session._asked._acting = lambda: Author("Ben", "3")
    for insists in (False, True):
        with pytest.raises(NotOnesOwnError, match="Anna's") as refusal:
            session.undo(insists)
        assert not refusal.value.may_insist
    session._asked._acting = lambda: OWNER
    with pytest.raises(NotOnesOwnError) as refusal:
        session.undo()
    assert refusal.value.may_insist
    session.undo(insists=True)
    assert session.state.design == first.design
    session._asked._acting = lambda: anna
    session.redo()
    assert session.state.design != first.design


def test_that_only_the_owner_can_go_over_a_change_of_the_owners_is_said_once(session):
    session.do(SetRate("A", "lateral", 1e5))
    session._asked._acting = lambda: Author("Anna", "2")
    with pytest.raises(NotOnesOwnError, match="Owner's, so only Owner can go over it"):
        session.undo()


def test_a_set_that_is_added_replaces_no_other(session):
    soft, softer = ({"A": MountRates(rate, rate, rate)} for rate in (2e5, 1e5))
    for name, rates in (("Mine", soft), ("Mine", softer), ("Original", softer)):
        session.do(AddVariant(name, rates))
    variants = session.state.design.variants
    lateral = {name: variant.rates["A"].lateral for name, variant in variants.items()}
    assert lateral == {"Mine": 2e5, "Mine 2": 1e5, "Original 2": 1e5}


def test_a_set_that_is_added_again_is_the_one_there_is(session):
    own = session.vehicle.rates["A"]
    for name, rates in (("Mine", {"A": own}), ("Mine", {}), ("Original", {})):
        session.do(AddVariant(name, rates))
    assert list(session.state.design.variants) == ["Mine"]


def test_a_loss_factor_that_is_the_groups_own_makes_no_other_set(session):
    repeated = {"A": replace(session.vehicle.rates["A"], loss_factor=0.15)}
    session.do(AddVariant("Mine", repeated))
    assert session.state.design.variants["Mine"].rates == session.vehicle.rates
    assert first_state(session.vehicle, repeated, FLAT).design.rates == session.vehicle.rates


def test_swapping_changes_places_and_keeps_what_had_no_name(session):
    session.start()
    session.do(SetRate("A", "lateral", 1e5))
    tried = session.state.design.rates
    session.do(Swap())
    assert session.state.design.rates == session.vehicle.rates
    assert session.state.against == "Trial 1"
    session.do(Swap())
    assert session.state.design.rates == tried
    assert session.state.against == "Original"
    assert list(session.state.design.variants) == ["Trial 1"]


TOO_STIFF = MountRates(1e16, 1e16, 1e16)


def test_a_set_without_an_answer_is_left_out_and_says_why(session):
    session.start()
    session.do(AddVariant("Rigid", {"A": TOO_STIFF}))
    session.do(Alter(overlaid=frozenset({"Rigid", "Soft"}), load=session.vehicle.wheel_loads[0].name))
    assert session.wait(20)
    solved = session.answers[-1]
    assert list(solved.named.results) == ["Original", "Soft"]
    assert set(solved.wheels) == {"Original", "Soft", ""}
    assert "a spring is too stiff" in solved.named.unsolved["Rigid"]
    assert not solved.missing


def test_the_original_stands_for_a_compared_set_without_an_answer(session):
    session.start()
    session.do(AddVariant("Rigid", {"A": TOO_STIFF}))
    session.do(CompareWith("Rigid"))
    assert session.wait(20)
    solved = session.answers[-1]
    assert (solved.state.against, solved.missing) == ("Original", "Rigid")
    assert solved.base.rates == session.vehicle.rates
    assert session.state.against == "Rigid"


def test_what_cannot_be_found_out_is_tried_once(session, monkeypatch):
    asked = []

    def failing(*_):
        asked.append(1)
        raise SolveError("too stiff")

    monkeypatch.setattr("modeviz.viewer.session.inquiry.sensitivity", failing)
    session.start()
    assert session.wait_checked(60)
    for coloring in ("displacement", "bodies"):
        session.do(Alter(coloring=coloring))
        assert session.wait_checked(60)
    assert session.answers[-1].findings.problem == "too stiff"
    assert len(asked) == 1


def test_wheel_loads_are_solved_while_one_is_chosen(session):
    session.start()
    load = session.vehicle.wheel_loads[0].name
    session.do(SetRate("A", "lateral", 1e5))
    session.do(Alter(load=load, overlaid=frozenset({"Soft"})))
    assert session.wait(20)
    wheels = session.answers[-1].wheels
    assert set(wheels) == {"Original", "Soft", ""}
    expected = solve_wheels(prepare(mounted_cabin()), session.state.design.rates)
    np.testing.assert_allclose(
        wheels[""].acceleration_g[:, 0], expected.acceleration_g[:, 0], rtol=1e-9
    )
    session.do(Alter(load=""))
    assert session.wait(20)
    assert not session.answers[-1].wheels


def test_at_rest_the_effect_of_every_rate_is_known(session):
    session.start()
    session.do(SetRate("A", "lateral", 2e5))
    assert session.wait_checked(60)
    solved = session.answers[-1]
    found, step = solved.findings.sensitivity, 1e-4
    prepared = prepare(mounted_cabin())
    f, rms = [], []
    for factor in (1 - step, 1 + step):
        rates = {
            **session.state.design.rates,
            "A": replace(session.state.design.rates["A"], lateral=2e5 * factor),
        }
        results = solve(prepared, rates, FLAT)
        f.append(results.modes.frequency_hz[solved.followed.mode])
        rms.append(results.rms[0])
    assert found.frequency_hz[solved.followed.mode, 1] == pytest.approx(
        (f[1] - f[0]) / (2 * step), rel=1e-5
    )
    expected = (rms[1] - rms[0]) / (2 * step) / solved.now.rms[0]
    np.testing.assert_allclose(found.rms[0, :, 1], expected, rtol=1e-5)


def test_a_mode_that_is_asked_for_moves_whatever_moved_before(session):
    session.do(Alter(kind="component"))
    session.do(ShowMode("cab roll"))
    assert (session.state.motion.mode, session.state.motion.kind) == ("cab roll", "mode")
    session.do(Alter(kind="damped mode"))
    session.do(ShowMode("cab yaw"))
    assert session.state.motion.kind == "damped mode"


def test_after_a_failure_and_the_way_back_the_comparison_is_right_and_checked(session):
    session.expects_failure = True
    session.start()
    session.do(SetRate("A", "lateral", 1e5))
    assert session.wait_checked(60)
    good = session.answers[-1]
    solve_flat, answers = session._loop.answers.answer, session._loop.answers

    def failing(state, findings, progress):
        answers._solve_named(state)
        raise SolveError("not on this road")

    answers.answer = failing
    session.do(Drive(road="rough"))
    assert session._loop._worker.wait(20)
    answers.answer = solve_flat
    session.do(Drive(road="flat"))
    assert session.wait_checked(60)
    last = session.answers[-1]
    assert last.base.conditions == last.state.conditions == FLAT
    assert_near(last.base.psd, good.base.psd, CABIN)
    assert last.findings.check.is_complete
    assert last.findings.sensitivity is not None


def test_an_answer_overtaken_before_its_check_is_checked_when_it_comes_back(session):
    session.start()
    assert session.wait(20)
    session.do(SetRate("A", "lateral", 1e5))
    assert session.wait(20)
    session.undo()
    assert session.wait_checked(60)
    assert session.answers[-1].findings.check.is_complete


def test_what_is_found_out_is_told_and_nothing_is_drawn_for_it():
    """Drawn is the answer; what ten percent of each rate do comes where the rates are."""
    vehicle = mounted_cabin()
    said = []
    session = Session(vehicle, first_state(vehicle, vehicle.rates, FLAT), said.append)
    try:
        session.start()
        assert session.wait_checked(20)
    finally:
        session.close()
    assert said[-1].solved.findings.check.is_complete
    assert said[-1].solved.findings.sensitivity is not None
    assert sum(isinstance(notification, Answered) for notification in said) == 1
