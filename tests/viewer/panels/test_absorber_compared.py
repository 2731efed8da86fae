"""One screen, report and file show what an absorber brings: the set compared with is without it."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from opened_app import SOON, opened_app, text

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli.options import RoadOptions
from modeviz.optimise.goals import prepare_goal
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.viewer.session.commands.absorbers import AddAbsorber, RemoveAbsorber
from modeviz.viewer.session.commands.decisions import Pin, SetRate
from modeviz.viewer.session.commands.looks import ChangeCharts, ChooseCurve, CompareWith
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.state import ForceCurve, ResponseCurve
from modeviz.viewer.session.wheel_responses import NOW

ROOF = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)
PROBLEM = Problem(
    "ride", (DesignGroup("A"),), (Performance(np.array([5.0, 12.0]), ("flat",)),), is_normalised=True
)
SOFTER = 5e5


@pytest.fixture(scope="module")
def app():
    app = opened_app(*RoadOptions().shown(replace(mounted_cabin(), problems=(PROBLEM,))))
    app.session.do(AddAbsorber(ROOF))
    app.session.do(SetRate("A", "vertical", SOFTER))
    app.session.do(ChooseCurve(1, ForceCurve("roof", "z")))
    assert app.session.wait_checked(SOON)
    yield app
    app.close()


def test_every_panel_compares_with_the_vehicle_without_it(app):
    solved = app.session.answer
    responses = Responses(solved)
    seat = ResponseCurve(0, "vertical")
    without = solve(prepare(mounted_cabin()), {}, Conditions("flat", 20.0))
    before = responses.of("Original", seat)
    np.testing.assert_allclose(before, without.response(0, "vertical"), rtol=1e-9)
    assert responses.figure(NOW, seat) != pytest.approx(responses.figure("Original", seat), rel=0.01)

    beside = text(app.screen.controls.variants._side_by_side)
    assert "Absorbers Original Trial 1 roof – 6 kg" in beside
    assert "A vertical 800 500" in beside
    assert "roof vertical" not in beside
    modes = text(app.screen.results.modes._content)
    assert "Roof bounce" in modes
    assert "new" in modes
    energy = text(app.screen.results.energy._content)
    assert "Roof" in energy
    forces = text(app.screen.results.forces._content)
    assert "new" in forces
    assert np.isnan(responses.of("Original", ForceCurve("roof", "z"))).all()
    sliders = app.screen.controls.mounts._folders["roof"]._rows["vertical"]._slider
    assert "As it was added: " in sliders.hint
    assert sliders.label == "Vertical"


def test_forces_under_a_harmonic_load_and_paths_are_compared_too(app):
    app.session.do(ChangeCharts(load="front left radial force"))
    assert app.session.wait_for_answer(SOON)
    solved = app.session.answer
    base, now = (Responses(solved).mount_forces(name) for name in ("Original", NOW))
    assert len(now.figures) == len(base.figures) + 1
    assert "roof" in text(app.screen.results.paths._content)
    assert "new" in text(app.screen.results.forces._content)
    app.session.do(ChangeCharts(load=""))


def test_the_report_has_both_vehicles_and_their_goals(app):
    page = app.documents.report([]).decode()
    assert "Roof bounce" in page
    for section in ("Mount rates", "Objective", "Natural frequencies", "Forces of mounts", "Paths to"):
        assert section in page
    given = replace(mounted_cabin(), problems=(PROBLEM,))
    goal = prepare_goal(given, PROBLEM, given.rates, 20.0)
    own = goal.value({})
    rates = app.session.state.design.rates
    now = goal.of_vehicle(with_absorbers(given, [ROOF])).value(rates)
    assert own == pytest.approx(1.0)
    assert f"{now:.4g}" in page


def test_the_offline_file_has_both_vehicles(app):
    page = app.documents.offline(np.array([5.0, -5.0, 3.0]), np.zeros(3)).decode()
    beside = page[page.index("<aside>") :]
    assert "nan" not in beside
    assert "roof" in beside


def test_what_was_taken_away_again_is_compared_with_the_set_that_has_it(app):
    app.session.do(Pin("with it"))
    app.session.do(RemoveAbsorber("roof"))
    app.session.do(CompareWith("with it"))
    solved = app.session.wait_for_answer(SOON)
    assert "roof" not in solved.now.rates
    assert "roof" in solved.base.rates
    assert "Absorbers with it Trial 1 roof 6 kg –" in text(app.screen.controls.variants._side_by_side)
    page = app.documents.report([]).decode()
    assert "roof" in page
    assert app.documents.offline(np.array([5.0, -5.0, 3.0]), np.zeros(3))
