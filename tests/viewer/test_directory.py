"""Which session a page is of, over real connections."""

import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from urllib.parse import urlencode

import pytest
import viser
from guests import all_is_heard
from serving_cabin import key_of, page_at, serving, way
from visitors import CAMERA, TOKEN, encoded, get, knock, own_origin, update, wait_until
from websockets.exceptions import InvalidStatus

from modeviz.compute.precedence import Precedence
from modeviz.journal.keys import digest_of
from modeviz.viewer.page.doors.door import SUBPROTOCOL, WHY
from modeviz.viewer.page.doors.surroundings import surroundings
from modeviz.viewer.panels.guide import Guide
from modeviz.viewer.serving import open_session
from modeviz.viewer.serving import open_sessions as rules
from modeviz.viewer.serving.directory import BEING_OPENED, NO_KEY


@pytest.fixture(scope="module")
def served():
    with serving() as both:
        yield both


def test_who_comes_without_a_session_is_sent_to_a_new_one_and_back_to_it_another_time(served):
    front, _ = served
    first, second = way(front), way(front)
    assert key_of(first) != key_of(second)
    status, headers, page = get(front, first)
    assert status == 200
    assert b"modeviz</title>" in page
    cookie = headers["Set-Cookie"].split(";")[0]
    assert way(front, Cookie=cookie) == first
    assert key_of(way(front, "/?new", Cookie=cookie)) != key_of(first)


def test_pages_alone_open_no_session(served):
    front, directory = served
    before = len(directory.sessions.open)
    for _ in range(5):
        get(front, way(front))
    assert len(directory.sessions.open) == before


@pytest.mark.parametrize(
    "path", ["/?session=x", "/?session=", "/other", "/?vehicle=none", "/?review=a"]
)
def test_there_is_nothing_at_other_addresses(served, path):
    front, directory = served
    before = len(directory.sessions.open)
    assert get(front, path)[0] == 404
    with pytest.raises(InvalidStatus) as refusal, knock(front, own_origin(front), path):
        pass
    assert refusal.value.response.status_code == 404
    assert len(directory.sessions.open) == before


def n_looked_at(directory):
    return sum(not each.idle for each in directory.sessions.open.values())


def slider(session):
    """The first slider on a session's page, of a mount rate."""
    handles = session.server.gui._gui_input_handle_from_uuid.values()
    return next(each for each in handles if isinstance(each, viser.GuiSliderHandle))


def test_a_session_is_moved_by_its_own_pages_alone(served):
    front, directory = served
    ways = way(front), way(front)
    with page_at(front, ways[0]) as mine, page_at(front, ways[1]) as stranger, page_at(front, ways[0]):
        places = [("cabin", digest_of(key_of(each))) for each in ways]
        wait_until(lambda: all(map(directory.sessions.get, places)))
        one, other = (directory.sessions.open[place] for place in places)
        wait_until(lambda: one.app.session.answer and other.app.session.answer, 60)
        wait_until(lambda: len(one.server.get_clients()) == 2)
        before = one.app.session.state.design.rates
        rate = slider(one).value
        mine.send(update(slider(one), rate + 20))
        wait_until(lambda: one.app.session.state.design.rates != before)
        moved = one.app.session.state.design.rates
        stranger.send(update(slider(one), rate + 7))
        all_is_heard(other.server, stranger)
        assert slider(one).value == rate + 20
        assert one.app.session.state.design.rates == moved
        assert other.app.session.state.design.rates == before
        assert one.app.session.prepared is other.app.session.prepared


def test_a_session_that_nobody_looks_at_is_closed_and_others_stay(served, monkeypatch):
    front, directory = served
    with page_at(front, way(front)), page_at(front, way(front)) as left:
        wait_until(lambda: n_looked_at(directory) == 2, 60)
        wait_until(
            lambda: all(each.app.session.answer for each in directory.sessions.open.values()), 60
        )
        left.close()
        wait_until(lambda: n_looked_at(directory) == 1)
        monkeypatch.setattr(rules, "MOST_OPEN", 2)
        with page_at(front, way(front)):
            wait_until(lambda: n_looked_at(directory) == 2)
            assert len(directory.sessions.open) == 2


def test_the_last_session_is_remembered_in_a_frame_of_another_site_too():
    """Else whoever loads a wiki's page again would have a new session each time."""
    around = surroundings(frames=("https://wiki.example.com",))
    with serving(around=around) as (front, _):
        kept = get(front, way(front))[1]["Set-Cookie"]
    assert kept.endswith("; HttpOnly; SameSite=None; Secure; Partitioned")


def test_without_the_token_no_session_is_opened():
    with serving(token=TOKEN) as (front, directory):
        path = "/?session=" + "a" * 22
        assert get(front)[0] == get(front, path)[0] == 403
        with pytest.raises(InvalidStatus) as refusal, knock(front, own_origin(front), path):
            pass
        assert refusal.value.response.status_code == 403
        with pytest.raises(InvalidStatus), knock(front, "http://elsewhere.example", path):
            pass
        assert not directory.sessions.open


def moved(front, directory, path):
    """The rates of a session after its slider was moved on a page."""
    with page_at(front, path) as page:
        name = digest_of(key_of(path))
        wait_until(lambda: directory.sessions.get(("cabin", name)))
        session = directory.sessions.open["cabin", name]
        wait_until(lambda: session.app.session.answer, 60)
        before = session.app.session.state.design.rates
        page.send(update(slider(session), slider(session).value + 20))
        wait_until(lambda: session.app.session.state.design.rates != before)
        return session.app.session.state.design.rates


def rates_of(front, directory, path, name=None):
    """The rates that a page finds, and whether they can be taken back."""
    with page_at(front, path):
        name = name or digest_of(key_of(path))
        wait_until(lambda: directory.sessions.get(("cabin", name)))
        session = directory.sessions.open["cabin", name].app.session
        return session.state.design.rates, session.can_undo


def test_a_session_goes_on_where_it_was_left_after_the_server_has_been_restarted(tmp_path):
    study = tmp_path / "cabin.modeviz"
    with serving(study) as (front, directory):
        path = way(front)
        left = moved(front, directory, path)
        (bench,) = directory.benches.values()
        review = f"/?review={bench.share(digest_of(key_of(path)), 'Ada')}"
    with serving(study) as (front, directory):
        assert rates_of(front, directory, path) == (left, True)
        fresh, can_undo = rates_of(front, directory, way(front))
        assert fresh != left
        assert not can_undo
        assert get(front, review)[0] == 200
    with serving(study) as (front, directory):
        assert rates_of(front, directory, review, digest_of(key_of(path))) == (left, True)


def test_a_session_of_a_later_modeviz_is_left_as_it_is_and_the_page_says_so(tmp_path):
    file, later = tmp_path / "cabin.modeviz", '{"version": 99, "content": {}}'
    with serving(file) as (front, directory):
        path = way(front)
        name = digest_of(key_of(path))
        (bench,) = directory.benches.values()
        bench.study.begin(name)
        bench.study.look(name, later)
        moved(front, directory, path)
        status = directory.sessions.open["cabin", name].app.screen.controls.status._content.content
        assert "written by a later modeviz" in status
        assert "what is done here is not saved" in status
    with serving(file) as (front, directory):
        (bench,) = directory.benches.values()
        assert bench.study.restore(name).state == later
        assert not bench.study.restore(name).past


def test_an_idle_session_goes_to_disk_and_comes_back(tmp_path, monkeypatch):
    monkeypatch.setattr(rules, "IDLE", 0.2)
    monkeypatch.setattr(rules, "LOOKS_EVERY", 0.1)
    with serving(tmp_path / "cabin.modeviz") as (front, directory):
        path = way(front)
        left = moved(front, directory, path)
        wait_until(lambda: not directory.sessions.open)
        assert rates_of(front, directory, path) == (left, True)


def test_the_link_of_a_review_opens_the_session_until_it_is_ended(tmp_path):
    with serving(tmp_path / "cabin.modeviz") as (front, directory):
        path = way(front)
        moved(front, directory, path)
        name = digest_of(key_of(path))
        visitors = directory.sessions.open["cabin", name].server.visitors
        links = []
        for _ in range(2):
            links.append(visitors.share().removeprefix("."))
            assert get(front, links[-1])[0] == 200
            with page_at(front, links[-1]) as looking:
                assert looking.recv(timeout=20)
                assert not visitors.there[-1].is_owner
            assert len(directory.sessions.open) == 1
            visitors.stop_sharing()
            assert get(front, links[-1])[0] == 404
        assert links[0] != links[1]
        assert key_of(path) not in links[0]


def test_whoever_has_a_review_open_as_the_server_restarts_still_only_looks(tmp_path):
    study = tmp_path / "cabin.modeviz"
    with serving(study) as (front, directory):
        path = way(front)
        moved(front, directory, path)
        name = digest_of(key_of(path))
        link = directory.sessions.open["cabin", name].server.visitors.share().removeprefix(".")
    with serving(study) as (front, directory):
        with page_at(front, link) as looking:
            wait_until(lambda: directory.sessions.get(("cabin", name)))
            session = directory.sessions.open["cabin", name]
            wait_until(lambda: session.app.session.answer, 60)
            before = session.app.session.state.design.rates
            rate = slider(session).value
            looking.send(update(slider(session), rate - 20))
            all_is_heard(session.server, looking)
            assert slider(session).value == rate
            assert session.app.session.state.design.rates == before
            session.server.visitors.stop_sharing()
        assert get(front, link)[0] == 404


def test_the_link_of_a_review_opens_that_without_the_token_and_nothing_else():
    with serving(token=TOKEN) as (front, directory):
        cookie = get(front, f"/?token={TOKEN}")[1]["Set-Cookie"].split(";")[0]
        path = way(front, Cookie=cookie)
        with knock(front, own_origin(front), path, Cookie=cookie) as owner:
            owner.send(encoded(CAMERA))
            name = digest_of(key_of(path))
            wait_until(lambda: directory.sessions.get(("cabin", name)))
            visitors = directory.sessions.open["cabin", name].server.visitors
            link = visitors.share().removeprefix(".")
            status, headers, _ = get(front, link)
            assert (status, "Set-Cookie" in headers) == (200, False)
            with page_at(front, link) as looking:
                assert looking.recv(timeout=20)
                assert not visitors.there[-1].is_owner
            session = path.removeprefix("/?")
            for asked in ("/", path, f"{link}&{session}", f"/x{link[1:]}", "/?review=" + "a" * 22):
                assert get(front, asked)[0] == 403
                with pytest.raises(InvalidStatus), knock(front, own_origin(front), asked):
                    pass
            visitors.stop_sharing()
            assert get(front, link)[0] == 403


def test_a_page_that_comes_while_its_session_is_being_opened_is_told_to_wait(tmp_path, monkeypatch):
    going_on = threading.Event()
    opened = rules.OpenSession.__init__

    def slowly(*arguments):
        going_on.wait(20)
        opened(*arguments)

    with serving(tmp_path / "cabin.modeviz") as (front, directory):
        path = way(front)
        origin = f"http://127.0.0.1:{front.get_port()}"
        query = urlencode({"origin": origin, "subprotocol": SUBPROTOCOL, "session": key_of(path)})
        monkeypatch.setattr(rules.OpenSession, "__init__", slowly)
        assert get(front, f"/{WHY}?{query}")[::2] == (200, b"")
        with ThreadPoolExecutor() as pages:
            coming = pages.submit(moved, front, directory, path)
            wait_until(lambda: directory.sessions._locks)
            assert get(front, f"/{WHY}?{query}")[2].decode() == BEING_OPENED
            going_on.set()
            coming.result(60)
        assert get(front, f"/{WHY}?{query}")[::2] == (200, b"")
        assert get(front, f"/{WHY}?{query}x")[2].decode() == NO_KEY


def test_sessions_that_are_closed_at_once_leave_the_output_as_it_was(capsys):
    output = sys.stdout
    with serving() as (front, directory), ExitStack() as pages:
        for _ in range(6):
            pages.enter_context(page_at(front, way(front)))
        wait_until(lambda: len(directory.sessions.open) == 6, 60)
    assert sys.stdout is output
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("where", [(open_session.App, "__init__"), (Guide, "welcome_first")])
def test_a_session_that_cannot_be_built_leaves_no_server_and_no_thread(served, monkeypatch, where):
    def broken(*_):
        raise RuntimeError("broken")

    front, directory = served
    (bench,) = directory.benches.values()
    monkeypatch.setattr(*where, broken)
    before = set(threading.enumerate())
    with pytest.raises(RuntimeError, match="broken"):
        rules.OpenSession(bench, digest_of("no page"), bench.opening(), front, "", False, Precedence())
    wait_until(lambda: set(threading.enumerate()) <= before)


def test_idle_sessions_are_closed_though_closing_one_went_wrong(capsys, monkeypatch):
    monkeypatch.setattr(rules, "IDLE", 0.2)
    monkeypatch.setattr(rules, "LOOKS_EVERY", 0.1)
    closed = rules.OpenSession.close
    broken = []

    def close(session):
        closed(session)
        if not broken:
            broken.append(session)
            raise RuntimeError("broken")

    monkeypatch.setattr(rules.OpenSession, "close", close)
    with serving() as (front, directory):
        for _ in range(2):
            with page_at(front, way(front)):
                wait_until(lambda: directory.sessions.open)
            wait_until(lambda: not directory.sessions.open, 60)
    assert "broken" in capsys.readouterr().err
