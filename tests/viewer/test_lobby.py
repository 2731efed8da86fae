"""A server of several vehicles: its start page, what a browser finds there, and what probes get."""

import gc
import io
import json
import re
import threading
import weakref
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from html import unescape

import pytest
from mounted_cabin import mounted_cabin
from PIL import Image
from serving_cabin import key_of, page_at, way
from session_commands import Alter
from visitors import CAMERA, TOKEN, encoded, get, knock, own_origin, wait_until

from modeviz.analysis.results import Conditions
from modeviz.cli import serve as command
from modeviz.errors import ModevizError
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.keys import digest_of
from modeviz.journal.study_file import StudyFile
from modeviz.text.log import JsonFormatter
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.front import open_front
from modeviz.viewer.serving import lobby
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.directory import Directory
from modeviz.viewer.session.commands.decisions import Pin, SetRate

NAMES = "first", "second"
SOON = 20


@contextmanager
def serving(tmp_path=None, token=None):
    """A front with two cabins behind it, which are not made ready yet."""
    with ExitStack() as ending:
        front = open_front(port=0, token=token and Secret(token))
        benches = {}
        for name in NAMES:
            cabin = replace(mounted_cabin(), name=f"The {name} <i>")
            study = None
            if tmp_path:
                study = StudyFile.open(tmp_path / name, cabin.name, fingerprint_of(cabin))
                ending.callback(study.close)
            conditions = Conditions("flat", 20.0)
            benches[name] = Bench(cabin, cabin.rates, conditions, study=study)
        directory = Directory(front, benches, dark=False, has_lobby=True)
        ending.callback(directory.close)
        ending.callback(front.close)
        front.open(directory)
        yield front, directory


def start_page(front, cookie=""):
    status, headers, body = get(front, "/", **({"Cookie": cookie} if cookie else {}))
    assert status == 200
    return headers, body.decode()


def links(page):
    return [unescape(link)[1:] for link in re.findall(r'href="([^"]*)"', page) if link[0] == "."]


def picture(front, address, cookie=""):
    status, headers, body = get(front, address, **({"Cookie": cookie} if cookie else {}))
    assert (status, headers["Content-Type"]) == (200, "image/png")
    with Image.open(io.BytesIO(body)) as image:
        assert image.size == lobby.SIZE
    return body


def test_the_start_page_lists_vehicles_with_pictures_and_loads_nothing_else():
    with serving() as (front, _):
        headers, page = start_page(front)
        assert "The first &lt;i&gt;" in page
        assert "<i>" not in page
        assert "2 vehicles" in page
        assert "made ready when it is opened" in page
        assert "default-src 'none'" in headers["Content-Security-Policy"]
        assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
        assert "script" not in page
        assert picture(front, "/picture?vehicle=first")
        assert get(front, "/picture?vehicle=third")[0] == 404
        assert get(front, "/?vehicle=third")[0] == 404
        assert {link for link in links(page) if "new" not in link} == {f"/?vehicle={n}" for n in NAMES}


def test_a_vehicle_is_made_ready_once_somebody_opens_it():
    with serving() as (front, directory):
        path = way(front, "/?vehicle=first")
        assert not any(bench.is_prepared for bench in directory.benches.values())
        with page_at(front, path):
            wait_until(lambda: directory.benches["first"].is_prepared)
        assert not directory.benches["second"].is_prepared
        assert "ready" in start_page(front)[1]


def visited(front, path):
    """The cookie of a browser that has opened an address."""
    return get(front, path)[1]["Set-Cookie"].partition(";")[0]


def test_a_browser_finds_the_sessions_that_it_left_and_nobody_else_does(tmp_path):
    with serving(tmp_path) as (front, directory):
        path = way(front, "/?vehicle=first")
        cookie = visited(front, path)
        with page_at(front, path):
            wait_until(lambda: directory.sessions.open)
            session = next(iter(directory.sessions.open.values())).app.session
            wait_until(lambda: session.answer)
            session.do(SetRate("A", "lateral", 1e5))
            session.do(Pin("Soft <b>"))
            assert session.wait(60)
            wait_until(lambda: "2 changes" in start_page(front, cookie)[1])
            page = start_page(front, cookie)[1]
            assert "Soft &lt;b&gt;" in page
            assert path in links(page)
            named = next(iter(directory.sessions.open.values())).app.keeping.title
            named.put("Cab <1>")
            assert "Cab &lt;1&gt;" in start_page(front, cookie)[1]
            moving = picture(front, "/picture?vehicle=first&left=0", cookie)
            session.do(Alter(mode=session.answer.now.names[8].name))
            assert session.wait(60)
            assert picture(front, "/picture?vehicle=first&left=0", cookie) != moving
        stranger = start_page(front)[1]
        assert "You left" not in stranger
        assert key_of(path) not in stranger
        assert "Soft" not in stranger
        at_rest = picture(front, "/picture?vehicle=first")
        for left in ("0", "1", "-1", "x"):
            assert picture(front, f"/picture?vehicle=first&left={left}") == at_rest
        # the way to the vehicle leads back, a new session beside it, and both are found
        assert way(front, "/?vehicle=first", Cookie=cookie) == path
        new = way(front, "/?vehicle=first&new", Cookie=cookie)
        assert new != path
        both = get(front, new, Cookie=cookie)[1]["Set-Cookie"].partition(";")[0]
        assert way(front, "/?vehicle=first", Cookie=both) == new
        assert path in links(start_page(front, both)[1])


def test_the_key_of_another_vehicles_session_opens_a_new_one_of_the_vehicle_asked_for(tmp_path):
    with serving(tmp_path) as (front, directory), ExitStack() as pages:
        path = way(front, "/?vehicle=first&new")
        elsewhere = path.replace("vehicle=first", "vehicle=second")
        places = [(vehicle, digest_of(key_of(path))) for vehicle in NAMES]
        for each in (path, elsewhere):
            pages.enter_context(page_at(front, each))
        wait_until(lambda: all(map(directory.sessions.get, places)))
        first, second = (directory.sessions.open[place].app.session for place in places)
        assert [each.vehicle.name for each in (first, second)] == ["The first <i>", "The second <i>"]
        assert b"The second" in get(front, elsewhere)[2]
        before = second.state.design.rates
        first.do(SetRate("A", "lateral", 1e5))
        assert second.state.design.rates == before
    with serving(tmp_path) as (front, directory), page_at(front, elsewhere):
        wait_until(lambda: directory.sessions.get(places[1]))
        assert directory.sessions.open[places[1]].app.session.state.design.rates == before


def test_a_review_is_of_its_own_vehicle_alone():
    with serving() as (front, directory):
        path = way(front, "/?vehicle=first&new")
        key = directory.benches["first"].share(digest_of(key_of(path)), "")
        assert get(front, f"/?vehicle=first&review={key}")[0] == 200
        assert get(front, f"/?vehicle=second&review={key}")[0] == 404


def test_pictures_that_are_being_drawn_hold_no_session_up(monkeypatch):
    going_on = threading.Event()
    drawn = lobby.still_at_rest

    def slowly(*arguments):
        assert going_on.wait(SOON)
        return drawn(*arguments)

    monkeypatch.setattr(lobby, "still_at_rest", slowly)
    with serving() as (front, directory), ThreadPoolExecutor(8) as browsers:
        images = [browsers.submit(picture, front, f"/picture?vehicle={name}") for name in NAMES * 4]
        wait_until(lambda: directory.sessions.precedence._queue)
        path = way(front, "/?vehicle=first&new")
        with page_at(front, path):
            wait_until(lambda: directory.sessions.get(("first", digest_of(key_of(path)))), SOON)
        going_on.set()
        for image in images:
            image.result(SOON)


def test_the_picture_of_a_session_keeps_nothing_else_of_it_in_memory():
    with serving() as (front, directory):
        path = way(front, "/?vehicle=first")
        cookie = visited(front, path)
        name = digest_of(key_of(path))
        with page_at(front, path):
            wait_until(lambda: directory.sessions.get(("first", name)))
            wait_until(lambda: directory.sessions.open["first", name].app.session.answer, 60)
            picture(front, "/picture?vehicle=first&left=0", cookie)
            answer = weakref.ref(directory.sessions.open["first", name].app.session.answer)
        directory.sessions._close(("first", name), -1.0)
        wait_until(lambda: gc.collect() >= 0 and answer() is None)


def test_a_session_on_disk_shows_its_newest_picture(tmp_path):
    with serving(tmp_path) as (front, directory):
        path = way(front, "/?vehicle=second")
        cookie, study = visited(front, path), directory.benches["second"].study
        session = study.session_id(key_of(path))
        study.begin(session)
        file = io.BytesIO()
        Image.new("RGB", (1600, 500), (200, 30, 40)).save(file, "PNG")
        study.put_picture(session, file.getvalue(), "red")
        assert study.flush(20)
        body = picture(front, "/picture?vehicle=second&left=0", cookie)
        with Image.open(io.BytesIO(body)) as image:
            assert image.getpixel((320, 200)) == (200, 30, 40)


def health(front, **headers):
    status, _, body = get(front, "/healthz", **headers)
    return status, json.loads(body) if status != 403 else body


def test_a_probe_needs_no_token_and_is_told_nothing_private():
    with serving(token=TOKEN) as (front, directory):
        assert get(front, "/")[0] == 403
        assert get(front, "/picture?vehicle=first")[0] == 403
        status, told = health(front)
        assert status == 200
        assert told.pop("version")
        nothing = dict.fromkeys(("prepared", "sessions", "pages", "stuck", "unsaved"), 0)
        assert told == {"status": "ok", "vehicles": 2, **nothing}
        assert health(front, Host="evil.example")[0] == 403
        assert health(front, Origin="http://evil.example")[0] == 403
        directory.sessions._ended.set()
        assert health(front)[0] == 503
        assert health(front)[1]["status"] == "stopping"


def test_a_probe_is_told_of_sessions_that_do_not_go_on():
    with serving() as (front, directory), page_at(front, way(front, "/?vehicle=first")):
        wait_until(lambda: health(front)[1]["pages"] == 1)
        (session,) = directory.sessions.open.values()
        session.app.session._loop._worker._is_stuck = True
        status, told = health(front)
        assert (status, told["status"], told["sessions"]) == (503, "stuck", 1)


def test_folders_have_names_of_their_own_and_none_is_there_twice(tmp_path):
    one, other = tmp_path / "a" / "truck", tmp_path / "b" / "truck"
    assert command.named_folders([one, other]) == {"truck": one, "truck-2": other}
    with pytest.raises(ModevizError, match="is there twice"):
        command.named_folders([one, one / ".." / "truck"])


def test_the_log_names_sessions_and_never_what_opens_them(caplog):
    with caplog.at_level("INFO", "modeviz"), serving(token=TOKEN) as (front, directory):
        _, headers, _ = get(front, f"/?token={TOKEN}")
        entered = headers["Set-Cookie"].partition(";")[0]
        path = way(front, "/?vehicle=first", Cookie=entered)
        with knock(front, own_origin(front), path, Cookie=entered) as page:
            page.send(encoded(CAMERA))
            wait_until(lambda: health(front)[1]["pages"] == 1)
            (session,) = directory.sessions.open.values()
            number = session.server.mistake(ValueError(f"asked for {path} with {entered}"))
        wait_until(lambda: health(front)[1]["pages"] == 0)
    lines = [JsonFormatter().format(record) for record in caplog.records]
    told = [json.loads(line) for line in lines]
    name = digest_of(key_of(path))[:8]
    of_session = [each["event"] for each in told if each.get("session") == name]
    assert {"session opened", "page opened", "mistake", "page closed"} <= {*of_session}
    assert number in [each.get("id") for each in told]
    secrets = (TOKEN, key_of(path), entered.partition("=")[2])
    assert not any(secret in line for secret in secrets for line in lines)
