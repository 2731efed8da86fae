"""What the page says and draws of a body on its mounts."""

import re
import time
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from four_cylinder import FREQUENCIES, TORQUE_ROLL, four_cylinder, on_subframe
from opened_app import SOON, text

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import body_axes, body_purity
from modeviz.errors import VehicleError
from modeviz.files.records.decoupling import decoupling_text
from modeviz.vehicle.decoupling import USUAL, Decoupling
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.commands.decisions import ChangePlan, ChangeTargets, SetRate, TakeRates
from modeviz.viewer.session.commands.looks import LookAtRigid


def done(app, *commands):
    for command in commands:
        app.session.do(command)
    solved = app.session.wait_for_answer(SOON)
    assert app.session.wait(SOON)
    return solved


def test_the_heat_map_has_every_mode_with_its_energy(opened):
    panel = opened(four_cylinder()).screen.results.rigid
    rows = re.findall(r"<tr.*?</tr>", panel._energy.content.split("Decoupling")[0])[1:]
    assert [float(re.search(r">(\d+\.\d\d)<", r)[1]) for r in rows] == pytest.approx(
        FREQUENCIES, abs=0.006
    )
    first = re.findall(r"<i[^>]*>([^<]*)</i>", rows[0])
    assert first == ["0.1", "98", "0.1", "1.2", "0.0", "0.1"]
    own = re.findall(r'<i class=own style="--c:var\(--mv-now\);--s:(\d+)%"', "".join(rows))
    assert own == ["71", "69", "35", "36", "67", "64"]  # 72 % of colour at all of the energy


def test_verdicts_say_which_directions_fail(opened):
    words = text(opened(four_cylinder()).screen.results.rigid._energy)
    assert re.search(r"Purity of 85 %\s+z, rz\s+fails", words)
    assert re.search(r"5 to 30 Hz\s+ry\s+fails", words)
    assert re.search(r"1.5 Hz between modes\s+holds", words)


def test_tables_follow_the_rates(opened):
    app = opened(four_cylinder())
    before = app.screen.results.rigid._energy.content, app.screen.results.rigid._axes.content
    done(app, SetRate("M1", "vertical", 9e5))
    after = app.screen.results.rigid._energy.content, app.screen.results.rigid._axes.content
    assert before[0] != after[0]
    assert before[1] != after[1]


def test_axes_are_those_of_the_present_rates_also_under_another_crank(opened):
    app = opened(on_subframe())
    rates = {"M2": MountRates(1e5, 4e5, 2e5)}
    solved = done(app, TakeRates(rates), LookAtRigid(body="subframe", crank="z", axes="crank"))
    results = solve_modal(prepare_modes(app.session.vehicle), rates)
    up = np.array([0, 0, 1.0])
    expected = body_axes(results, 1, up)
    assert solved.rigid_axes.held.center == pytest.approx(expected.held.center)
    assert solved.rigid_axes.mounted.angle == pytest.approx(expected.mounted.angle, rel=1e-6)
    found = body_purity(results, 1, "crank", USUAL, up)
    assert solved.purity.energy == pytest.approx(found.energy, abs=1e-6)
    assert "0.000 0.000 1.000" in text(app.screen.results.rigid._axes)


def test_lines_move_with_the_rates_and_are_there_only_when_wanted(opened):
    app = opened(four_cylinder())
    marks = app.scene._axes
    roll, torque, center, focus = (
        m._frame for m in (marks._roll, marks._torque, marks._center, marks._focus)
    )
    assert not torque.visible
    done(app, LookAtRigid(drawn=True))
    assert roll.visible
    assert not focus.visible  # no mount leans
    assert _turned(roll.wxyz) == pytest.approx(TORQUE_ROLL, abs=1e-5)
    before = np.array(center.position), np.array(torque.wxyz)
    solved = done(app, SetRate("M1", "vertical", 9e5))
    assert center.position == pytest.approx(solved.rigid_axes.held.center)
    assert not np.allclose(center.position, before[0])
    assert not np.allclose(torque.wxyz, before[1])
    assert _turned(torque.wxyz) == pytest.approx(solved.rigid_axes.held.torque_axis.direction)
    assert _turned(roll.wxyz) == pytest.approx(TORQUE_ROLL, abs=1e-5)
    done(app, LookAtRigid(drawn=False))
    assert [f.visible for f in (roll, torque, center)] == [False] * 3


def _turned(wxyz):
    """What a quaternion makes of z, by hand."""
    w, x, y, z = wxyz
    return [2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z]


def test_targets_are_changed_undone_and_kept(opened):
    app = opened(four_cylinder())
    done(app, ChangeTargets({"purity": 0.45, "highest_frequency": 32.0}))
    words = text(app.screen.results.rigid._energy)
    assert re.search(r"Purity of 45 %\s+holds", words)
    assert re.search(r"Decoupling\s+holds", words)
    with pytest.raises(VehicleError, match="highest_frequency"):
        app.session.do(ChangeTargets({"highest_frequency": 1.0}))
    app.session.undo()
    assert app.session.wait(SOON)
    assert app.session.state.design.decoupling == USUAL
    assert "Purity of 85 %" in text(app.screen.results.rigid._energy)


def test_saved_targets_are_the_table_of_a_vehicle_s_file():
    wanted = Decoupling(0.9, 6.0, 25.0, 1.0, 3.0)
    assert Decoupling(**tomllib.loads(decoupling_text(wanted))["decoupling"]) == wanted


def test_a_click_on_a_mode_shows_it(opened):
    app = opened(four_cylinder())
    app.screen.results.rigid._select(4)
    solved = app.session.wait_for_answer(SOON)
    assert solved.followed.mode == 4
    app.screen.results.rigid._select(39)  # no such row


def test_the_powertrain_is_looked_at_first(opened):
    assert opened(on_subframe()).session.state.rigid.body == "engine"


def test_a_search_on_the_page_decouples_to_the_targets_that_are_there(opened):
    app = opened(four_cylinder())
    assert app.session.state.design.plan.goal == "decoupling"
    assert "missing to purity, band and gaps" in text(app.screen.controls.optimise._editor._summary)
    done(app, ChangeTargets({"purity": 0.9}), ChangePlan(lambda _, plan: replace(plan, n_starts=3)))
    assert not app.session.answer.purity.passes
    app.tasks.search.start()
    assert wait_until(lambda: app.tasks.search.job.found)
    assert app.tasks.search.job.found.value < 1e-9
    solved = app.session.wait_for_answer(SOON)
    least = [solved.purity.purity(m) for m in ("x", "y", "z", "rx", "ry", "rz")]
    assert min(least) > 0.9 - 1e-6


def wait_until(reached):
    end = time.monotonic() + SOON
    while not reached() and time.monotonic() < end:
        time.sleep(0.05)
    return reached()
