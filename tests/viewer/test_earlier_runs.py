"""What was computed in a session is drawn again when it is opened, and can be chosen as before."""

import json
from dataclasses import replace

import numpy as np
import pytest
from cabin_session import SOON
from opened_app import text
from studied_cabin import cabin_study
from visitors import CAMERA, encoded, update, visit, wait_until

from modeviz.analysis.results import Conditions
from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.runs import Run
from modeviz.journal.study_file import StudyFile
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.optimise.verification import Verification
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.commands.decisions import SetRate
from modeviz.viewer.session.recorded import recorded
from modeviz.viewer.session.state import ResponseCurve, first_state
from modeviz.viewer.tasks.background_task import Job
from modeviz.viewer.tasks.earlier_runs import design_of, front_of, scatter_of
from modeviz.viewer.tasks.front_task import Goals, Trade
from modeviz.viewer.tasks.run_recorder import told

VEHICLE = cabin_study().vehicle
FLAT = Conditions("flat", 20.0)
FIRST = first_state(VEHICLE, VEHICLE.rates, FLAT)
PRINT = fingerprint_of(VEHICLE)
KEY = StudyFile.session_id("a key")
CURVE = ResponseCurve(0, "lateral")


def opened(study):
    """The page of the session as the study has it."""
    opening = recorded(study, KEY, FIRST, VEHICLE, PRINT.digest)
    app = App(VEHICLE, VEHICLE.rates, FLAT, open_server(port=0), opening=opening)
    app.start()
    app.record(study, KEY)
    assert app.session.wait(SOON)
    return app


def runs_of(study, n):
    wait_until(lambda: len(study.runs(KEY)) == n, SOON)
    return study.runs(KEY)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """A study in which a front and a scatter were computed, with what the page said of them."""
    path = tmp_path_factory.mktemp("runs") / "cabin.modeviz"
    study = StudyFile.open(path, VEHICLE.name, PRINT)
    app = opened(study)
    app.tasks.front.start(app.tasks.front.offers()[0])
    wait_until(lambda: not app.tasks.front.job.is_running, SOON)
    app.tasks.scatter.start(300)
    wait_until(lambda: not app.tasks.scatter.job.is_running, SOON)
    runs_of(study, 2)
    wait_until(lambda: "300 vehicles" in text(app.screen.controls.earlier._list))
    app.screen.controls.trade_off.follow()
    app.screen.controls.scatter.follow()
    said = text(app.screen.controls.trade_off._front), text(app.screen.controls.scatter._text)
    shown = app.tasks.front.job, app.tasks.scatter.job
    app.close()
    study.close()
    return path, said, shown


@pytest.fixture
def study(file):
    study = StudyFile.open(file[0], VEHICLE.name, PRINT)
    yield study
    study.close()


def test_front_and_band_are_drawn_when_the_session_is_opened_again(file, study, caplog):
    _, said, (front, scatter) = file
    app = opened(study)
    try:
        assert [each.message for each in caplog.records if each.levelname == "ERROR"] == []
        assert (
            text(app.screen.controls.trade_off._front),
            text(app.screen.controls.scatter._text),
        ) == said
        assert [d.values for d in app.tasks.front.job.found] == [d.values for d in front.found]
        f, band = app.tasks.scatter.shaded(app.session.state, CURVE)
        np.testing.assert_array_equal(f, scatter.found.frequency_hz)
        np.testing.assert_allclose(band, scatter.found.percentiles[:, :, 0, 1], rtol=1e-5)
        app.session.do(SetRate("A", "vertical", 3e5))
        assert app.tasks.scatter.shaded(app.session.state, CURVE) is None
        app.session.undo()
    finally:
        app.close()


def test_a_design_of_an_earlier_front_is_loaded_by_a_click_and_another_run_is_shown(study):
    app = opened(study)
    before = app.session.state.design.rates
    try:
        with visit(app.server) as page:
            page.send(encoded(CAMERA))
            design = app.tasks.front.job.found[1]
            page.send(update(app.screen.controls.trade_off._points._buttons[design], True))
            wait_until(lambda: app.session.state.design.rates == design.rates)
            other = replace(design, values=(1.0, 2.0))
            app.tasks.front.show(Job(Goals(("this", "that")), "ended", 1.0, (other,)))
            assert "This" in text(app.screen.controls.trade_off._front)
            (token,) = [run.token for run in study.runs(KEY) if run.kind == "front"]
            page.send(update(app.screen.controls.earlier._buttons._buttons[token], True))
            wait_until(lambda: len(app.tasks.front.job.found) > 1)
        app.session.undo()
        assert app.session.state.design.rates == before
    finally:
        app.close()


def test_what_the_full_model_said_of_a_design_comes_back_as_it_was_said():
    gap = TruncationGap(("cab",), 0.1, 9.5, 30.0, 2.0)
    nan = float("nan")
    said = [
        Verification(1.5, 1e-9, np.array([8.0]), True, "", gap, np.array([1e-3])),
        Verification(nan, nan, np.zeros(0), False, "it is singular"),
        None,
    ]
    designs = tuple(ParetoPoint(np.zeros(1), VEHICLE.rates, (1.0, 2.0), each) for each in said)
    trade = Trade(("this", "that"), VEHICLE.problems[0], None, FIRST, ())
    title, record = told(Job(trade, "cancelled", 0.5, designs))
    found = front_of(Run("front", title, json.dumps({"phase": "cancelled", **record}))).found
    for one, other in zip(said, [design.verification for design in found], strict=True):
        assert (one is None) == (other is None)
        if one:
            assert (other.impossible, other.are_kept, other.gap) == (
                one.impossible,
                one.are_kept,
                one.gap,
            )
            np.testing.assert_array_equal(
                [other.value, other.difference, *other.frequency_hz, *other.deflection],
                [one.value, one.difference, *one.frequency_hz, *one.deflection],
            )


@pytest.mark.parametrize(
    ("kind", "record"),
    [
        ("front", '{"phase": "ended", "problem": "p", "sides": ["a", "b"], "designs": []}'),
        ("front", '{"phase": "ended", "sides": ["a"], "designs": [{"values": [1]}]}'),
        ("front", "no JSON"),
        ("front", "[]"),
        ("scatter", '{"phase": "ended", "samples": 4, "quantities": {}}'),
        ("scatter", '{"phase": "ended", "bands": {"points": ["x"], "frequency_hz": [1.0]}}'),
        ("search", '{"phase": "failed", "problem": "p"}'),
        ("search", '{"value": 1.0, "rates": {"A": {"unknown": 1}}, "placements": {}}'),
    ],
)
def test_a_run_of_which_too_little_is_kept_is_listed_only(kind, record):
    run = Run(kind, "a run", record)
    assert (front_of(run), scatter_of(run), design_of(run)) == (None, None, None)
