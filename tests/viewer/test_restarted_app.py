"""A page that is opened as its session was left: panels, scene and what there is to say."""

import time

import pytest
from every_command import ABSORBERS, FORE_AFT, VEHICLE
from opened_app import SOON, text
from visitors import CAMERA as CAMERA_MESSAGE
from visitors import encoded, update, visit

from modeviz.analysis.results import Conditions
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile, _tell_all
from modeviz.viewer.app import App
from modeviz.viewer.keeping import Keeping
from modeviz.viewer.page.server import open_server
from modeviz.viewer.screen.screen import Screen
from modeviz.viewer.session.commands import decisions, looks
from modeviz.viewer.session.encoding.link import opening_of_link
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.recorded import recorded
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ForceCurve, first_state
from modeviz.viewer.session.view import Animation, CameraPose
from modeviz.viewer.tasks.tasks import Tasks

FLAT = Conditions("flat", 20.0)
FIRST = first_state(VEHICLE, VEHICLE.rates, FLAT)
PRINT = fingerprint_of(VEHICLE)
KEY = StudyFile.session_id("a key")
CAMERA = CameraPose((3.0, -4.0, 2.5), (1.0, 0.0, 0.7))
MOVING = Animation(1.85, 0.75, 215.0, False)


def opened(opening):
    server = open_server(port=0)
    app = App(VEHICLE, VEHICLE.rates, FLAT, server, opening=opening)
    app.start()
    assert app.session.wait(SOON)
    return app


def test_a_session_with_an_absorber_is_there_after_a_restart_and_can_lose_it(tmp_path):
    study = StudyFile.open(tmp_path / "study.modeviz", "cabin", PRINT)
    app = opened(Opening(FIRST))
    app.record(study, KEY)
    app.session.do(decisions.SetRate("B", "lateral", 123456.0))
    app.session.do(ABSORBERS[0])
    app.session.do(looks.ChooseCurve(0, ForceCurve("roof", "z")))
    app.session.do(looks.ChangeLook(coloring="kinetic energy"))
    state = app.session.state
    app.close()
    again = opened(recorded(study, KEY, FIRST, VEHICLE, PRINT.digest))
    again.record(study, KEY)
    try:
        assert again.session.state == state
        assert again.session.answer.now.rates["roof"] == state.design.rates["roof"]
        assert "roof" in text(again.screen.results.modes._content)
        again.session.undo()
        assert again.session.wait(SOON)
        assert not again.session.state.design.alterations.absorbers
        assert again.session.state.charts.curves[0] == FIRST.charts.curves[0]
        again.session.undo()
        assert again.session.state.design == FIRST.design
    finally:
        again.close()
        study.close()


def test_what_is_done_until_the_page_is_told_of_the_end_is_there_after_a_restart(tmp_path, monkeypatch):
    study = StudyFile.open(tmp_path / "study.modeviz", "cabin", PRINT)
    app = opened(Opening(FIRST))
    app.record(study, KEY)
    close = app.session.close

    def going_on():
        app.session.do(decisions.SetRate("B", "lateral", 123456.0))
        close()

    monkeypatch.setattr(app.session, "close", going_on)
    app.close()
    assert (
        recorded(study, KEY, FIRST, VEHICLE, PRINT.digest).state.design.rates["B"].lateral == 123456.0
    )
    study.close()


def test_all_else_is_closed_though_the_scene_does_not_close(monkeypatch):
    app, closed = opened(Opening(FIRST)), []
    for kind in (Keeping, Session, Screen, Tasks):

        def close(part, close=kind.close):
            closed.append(part)
            close(part)

        monkeypatch.setattr(kind, "close", close)
    monkeypatch.setattr(app.scene, "close", lambda: [].pop())
    with pytest.raises(IndexError):
        app.close()
    assert closed == [app.tasks, app.screen, app.session, app.keeping]


def test_camera_and_motion_are_there_after_a_restart(tmp_path):
    """As a page says that somebody has moved its camera, and the slider of the amplitude."""
    study = StudyFile.open(tmp_path / "study.modeviz", "cabin", PRINT)
    app = opened(Opening(FIRST))
    app.record(study, KEY)
    with visit(app.server) as socket:
        moved = {**CAMERA_MESSAGE, "position": CAMERA.position, "look_at": CAMERA.look_at}
        socket.send(encoded(CAMERA_MESSAGE))
        socket.send(update(app.screen.motion.animation._amplitude, 1.85))
        end = time.monotonic() + SOON
        while app.keeping.camera != CAMERA or app.screen.motion.animation._amplitude.value != 1.85:
            assert time.monotonic() < end
            socket.send(encoded(moved))  # until the page is known whose camera that is
            time.sleep(0.1)
    app.close()
    found = recorded(study, KEY, FIRST, VEHICLE, PRINT.digest)
    assert found.camera == CAMERA
    assert found.animation == Animation(amplitude=1.85)
    study.close()


def test_a_camera_that_is_where_the_session_was_left_is_kept_there():
    """As a page says that opens: it begins where viser's do, and goes where ours do."""
    app = opened(Opening(FIRST, camera=CAMERA))
    begun = CameraPose((3.0, 3.0, 3.0), (0.0, 0.0, 0.0))
    try:
        with visit(app.server) as socket:
            socket.send(encoded(CAMERA_MESSAGE))
            for pose in (begun, CAMERA):
                end = time.monotonic() + SOON
                while app.keeping.camera != pose:
                    assert time.monotonic() < end
                    where = {"position": pose.position, "look_at": pose.look_at}
                    socket.send(encoded({**CAMERA_MESSAGE, **where}))
                    time.sleep(0.1)
    finally:
        app.close()


def test_what_the_page_links_to_opens_the_same_view():
    begin = Opening(FIRST, animation=MOVING, camera=CAMERA, remarks=("mount group 'C' is gone",))
    app = opened(begin)
    try:
        app.session.do(decisions.SetRate("B", "lateral", 123456.0))
        app.session.do(looks.ChooseCurve(1, FORE_AFT))
        link = app.documents.link(CAMERA)
        found = opening_of_link(link, FIRST, VEHICLE, PRINT.digest)
        assert found.state == app.session.state
        assert (found.animation, found.camera) == (MOVING, CAMERA)
        initial = app.server.initial_camera
        assert tuple(initial.position) == CAMERA.position
        assert tuple(initial.look_at) == CAMERA.look_at
        assert "Mount group 'C' is gone." in text(app.screen.controls.status._content)
    finally:
        app.close()


def test_a_page_says_what_cannot_be_saved_until_it_can(tmp_path):
    study = StudyFile.open(tmp_path / "study.modeviz", "cabin", PRINT)
    app = opened(Opening(FIRST))
    app.record(study, KEY)
    try:
        _tell_all(study._watchers, "not saved: the disk is full")
        assert "Not saved: the disk is full." in text(app.screen.controls.status._content)
        app.session.do(decisions.SetRate("B", "lateral", 123456.0))
        assert app.session.wait(SOON)
        assert "Not saved: the disk is full." in text(app.screen.controls.status._content)
        _tell_all(study._watchers, "")
        assert "Not saved" not in text(app.screen.controls.status._content)
    finally:
        app.close()
        _tell_all(study._watchers, "not saved: the page is gone")
        study.close()
