"""Mounts moved and turned in a session: every answer is that of a vehicle made with such mounts."""

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from session_commands import Listener

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.viewer.session.commands.decisions import PlaceMounts, SetRate
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state

FLAT = Conditions("flat", 20.0)


@pytest.fixture
def session():
    vehicle = mounted_cabin()
    heard = Listener()
    session = Session(vehicle, first_state(vehicle, vehicle.rates, FLAT), heard)
    session.start()
    yield session
    session.close()
    assert not heard.failures


def test_placed_mounts_give_what_a_fresh_solve_gives(session):
    session.do(PlaceMounts("A", "angles", 0, 0.5))
    session.do(PlaceMounts("A", "angles", 2, -0.3))
    session.do(PlaceMounts("A", "offset", 1, 0.04))
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
    session.do(PlaceMounts("A", "angles", 0, 0.5))
    turned = session.wait_for_answer(60).now.modes.frequency_hz
    assert not np.allclose(turned, before, rtol=1e-4)
    session.undo()
    assert session.wait_for_answer(60).now.modes.frequency_hz == pytest.approx(before, rel=1e-12)
    session.redo()
    assert session.wait_for_answer(60).now.modes.frequency_hz == pytest.approx(turned, rel=1e-12)


def test_what_is_compared_with_is_turned_too(session):
    session.do(PlaceMounts("A", "angles", 0, 0.5))
    solved = session.wait_for_answer(60)
    assert solved.base.modes.frequency_hz == pytest.approx(solved.now.modes.frequency_hz, rel=1e-9)


def test_a_drag_back_to_no_turn_is_no_step(session):
    session.do(PlaceMounts("A", "angles", 0, 0.5))
    session.do(PlaceMounts("A", "angles", 0, 0.0))
    assert session.state.design.alterations == Alterations()
    assert not session.can_undo
