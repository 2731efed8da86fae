"""Mounts moved and turned in a session: every answer is that of a vehicle made with such mounts."""

import threading
import time
from contextlib import contextmanager

import numpy as np
import pytest
from block_on_a_sheet import A, B, at, on_a_block, place, sheet
from mounted_cabin import mounted_cabin
from session_commands import Listener

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli.options import RoadOptions
from modeviz.errors import VehicleError
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.viewer.panels.side_by_side import side_by_side
from modeviz.viewer.session.commands.decisions import (
    DragMounts,
    Load,
    Pin,
    PlaceMounts,
    ResetPlacement,
    SetRate,
    Swap,
)
from modeviz.viewer.session.commands.looks import CompareWith
from modeviz.viewer.session.design import variant_name
from modeviz.viewer.session.notifications import Preparing
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state

FLAT = Conditions("flat", 20.0)


@contextmanager
def shown(vehicle, conditions, heard):
    session = Session(vehicle, first_state(vehicle, vehicle.rates, conditions), heard)
    session.start()
    try:
        yield session
    finally:
        session.close()


@pytest.fixture
def session():
    heard = Listener()
    with shown(mounted_cabin(), FLAT, heard) as session:
        yield session
    assert not heard.failures


def test_placed_mounts_give_what_a_fresh_solve_gives(session):
    session.do(PlaceMounts("A", "angles", (0.5, None, None)))
    session.do(PlaceMounts("A", "angles", (None, None, -0.3)))
    session.do(PlaceMounts("A", "offset", (None, 0.04, None)))
    session.do(SetRate("A", "vertical", 3e5))
    now = session.wait_for_answer(60).now
    turned = with_placements(mounted_cabin(), {"A": Placement((0, 0.04, 0), (0.5, 0.0, -0.3))})
    fresh = solve(prepare(turned), session.state.design.rates, FLAT)
    np.testing.assert_allclose(now.modes.frequency_hz, fresh.modes.frequency_hz, rtol=1e-9)
    np.testing.assert_allclose(now.psd, fresh.psd, rtol=1e-7, atol=1e-12 * np.abs(fresh.psd).max())
    assert session.wait_checked(60)
    assert session.answer.findings.check.error < 1e-6
    assert session.vehicle.mount_group("A").mounts[0].axes == pytest.approx(
        turned.mount_group("A").mounts[0].axes
    )


def test_turning_is_undone_and_redone(session):
    before = session.wait_for_answer(60).now.modes.frequency_hz
    session.do(PlaceMounts("A", "angles", (0.5, None, None)))
    turned = session.wait_for_answer(60).now.modes.frequency_hz
    assert not np.allclose(turned, before, rtol=1e-4)
    session.undo()
    assert session.wait_for_answer(60).now.modes.frequency_hz == pytest.approx(before, rel=1e-12)
    session.redo()
    assert session.wait_for_answer(60).now.modes.frequency_hz == pytest.approx(turned, rel=1e-12)


def test_what_is_compared_with_stays_where_it_was(session):
    before = session.wait_for_answer(60)
    session.do(PlaceMounts("A", "offset", (0.2, None, None)))
    solved = session.wait_for_answer(60)
    assert solved.base is before.base
    assert solved.base.modes.frequency_hz == pytest.approx(before.now.modes.frequency_hz, rel=1e-12)
    assert not np.allclose(solved.now.psd, solved.base.psd, rtol=1e-3)
    assert variant_name(session.vehicle, session.state.design) == "Trial 1"
    html = side_by_side(solved)
    assert "as in the file" in html
    assert "200, 0, 0 mm" in html
    assert solved.static.base.case("standing").motion == pytest.approx(
        before.static.now.case("standing").motion
    )


def test_a_pinned_set_keeps_where_mounts_were_and_has_its_own_answer(session):
    placed = Placement((0.2, 0, 0))
    session.do(DragMounts("A", placed, 0))
    session.do(Pin("Mine"))
    mine = session.wait_for_answer(60).now
    session.do(ResetPlacement("A"))
    session.do(SetRate("A", "vertical", 3e5))
    solved = session.wait_for_answer(60)
    kept = solved.named.results["Mine"]
    assert kept.modes.frequency_hz == pytest.approx(mine.modes.frequency_hz, rel=1e-9)
    session.do(CompareWith("Mine"))
    assert session.wait_for_answer(60).base is kept
    session.do(Swap())
    assert session.state.design.alterations == Alterations({"A": placed})
    assert session.wait_for_answer(60).now.psd == pytest.approx(mine.psd, rel=1e-7)
    session.do(Load("Original"))
    assert session.state.design.alterations == Alterations()
    assert session.wait_for_answer(60).now.psd == pytest.approx(solved.named.results["Original"].psd)


def test_a_drag_back_to_no_turn_is_no_step(session):
    session.do(PlaceMounts("A", "angles", (0.5, None, None)))
    session.do(PlaceMounts("A", "angles", (0.0, None, None)))
    assert session.state.design.alterations == Alterations()
    assert not session.can_undo


def test_a_drag_is_one_step_however_long_and_the_next_is_another(session, monkeypatch):
    times = iter(100.0 * np.arange(100))
    monkeypatch.setattr("modeviz.viewer.session.history.time.monotonic", lambda: next(times))
    for drag, offsets in enumerate(((0.01, 0.02, 0.03), (0.04, 0.05))):
        for x in offsets:
            session.do(DragMounts("A", Placement((x, 0, 0)), drag))
    session.undo()
    assert session.state.design.alterations.placement("A") == Placement((0.03, 0, 0))
    session.undo()
    assert session.state.design.alterations == Alterations()


def test_a_place_off_a_flexible_body_is_refused_and_the_last_stays():
    vehicle, conditions = RoadOptions().shown(on_a_block(sheet(at(A)), place(A)))
    heard = Listener()
    with shown(vehicle, conditions, heard) as session:
        held = Placement(tuple(place(B) - place(A)))
        session.do(DragMounts("m", held, 0))
        with pytest.raises(VehicleError, match="is off body 'sheet'"):
            session.do(DragMounts("m", Placement((0.02, 0, 0.5)), 0))
        assert session.state.design.alterations == Alterations({"m": held})
        notes = session.wait_for_answer(60).now.prepared.vehicle.notes
        assert notes[0].startswith("mounts 'm' are moved by ")
        assert "no residual vectors of its own where mounts 'm' are moved to" in notes[1]
    assert not heard.failures


def test_a_preparation_that_takes_long_is_told_and_given_up_when_it_is_overtaken(session, monkeypatch):
    monkeypatch.setattr("modeviz.viewer.session.answer_loop.FOLLOWS", 0.0)
    prepared, fractions, go_on = [], [], threading.Event()

    def slowly(vehicle, progress):
        offset = vehicle.mounts[0].points[0, 0] - mounted_cabin().mounts[0].points[0, 0]
        for fraction in (0.2, 0.8):
            progress(fraction)
            if not prepared:
                go_on.wait(10)
        prepared.append(round(offset, 6))
        return prepare(vehicle)

    session.wait_for_answer(60)
    monkeypatch.setattr("modeviz.viewer.session.preparations.prepare", slowly)
    heard = session._loop._notify
    session._loop._notify = lambda told: (
        fractions.append(told) if isinstance(told, Preparing) else heard(told)
    )
    session.do(DragMounts("A", Placement((0.01, 0, 0)), 0))
    while not fractions:
        time.sleep(0.01)
    session.do(DragMounts("A", Placement((0.02, 0, 0)), 0))
    go_on.set()
    assert session.wait_for_answer(60).state.design.alterations.placement("A").offset[0] == 0.02
    assert prepared == [0.02]
    assert [told.fraction for told in fractions] == [0.2, 0.2, 0.8]
