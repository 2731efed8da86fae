"""Who is there and who is in control, by raw websockets."""

import time

import pytest
from guests import all_is_heard, guest, hand_over, heard, opened, take_back
from visitors import knock, own_origin, update, wait_until
from websockets.exceptions import ConnectionClosed

from modeviz.viewer.page.people import visitors as module
from modeviz.viewer.page.server import open_server

ANNA, BEN = "anna-anna-anna-anna-1", "ben-ben-ben-ben-ben-2"
SOON = 5.0


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


@pytest.fixture
def slider(server):
    return server.gui.add_slider("Rate", 0.0, 10.0, 1.0, 5.0)


def names(server):
    return [each.name for each in server.visitors.there]


def moves(server, page, slider, value):
    """Whether a page that moves a slider has it moved."""
    before = slider.value
    page.send(update(slider, value))
    all_is_heard(server, page)
    moved, slider.value = slider.value == value != before, before
    return moved


def test_every_page_of_the_sessions_own_address_is_in_control(server, slider):
    with opened(server) as one, opened(server) as other:
        assert moves(server, one, slider, 6.0)
        assert moves(server, other, slider, 7.0)


def test_visitors_only_look_and_are_put_back_at_once(server, slider):
    with guest(server) as page:
        assert not moves(server, page, slider, 6.0)
        page.send(update(slider, 7.0))
        told = [m for m in heard(page) if m.get("uuid") == slider._impl.uuid and "updates" in m]
    assert told[0]["updates"] == {"value": 5.0}
    assert slider.value == 5.0


def test_a_page_changes_nothing_before_it_says_where_its_camera_is(server, slider):
    with guest(server), knock(server, own_origin(server), "/?review=r") as page:
        assert not moves(server, page, slider, 6.0)


def test_control_is_handed_over_and_taken_back(server, slider):
    with opened(server) as owner, guest(server, "Anna", ANNA) as anna, guest(server, "Ben", BEN) as ben:
        assert names(server) == ["Owner", "Anna", "Ben"]
        hand_over(server, "Anna")
        assert [moves(server, page, slider, 6.0) for page in (owner, anna, ben)] == [False, True, False]
        hand_over(server, "Ben")
        assert [moves(server, page, slider, 6.0) for page in (owner, anna, ben)] == [False, False, True]
        take_back(server)
        assert [moves(server, page, slider, 6.0) for page in (owner, anna, ben)] == [True, False, False]


def test_control_is_given_by_the_owner_and_by_who_has_it_and_to_who_is_there(server):
    visitors = server.visitors
    with opened(server), guest(server, "Anna", ANNA), guest(server, "Ben", BEN):
        owner, anna, ben = sorted(server.get_clients())
        numbers = [visitors.of_page(page).number for page in (owner, anna, ben)]
        assert visitors.hand_over(anna, numbers[1]) is None  # nobody takes it
        assert visitors.hand_over(owner, numbers[1]).name == "Anna"
        assert visitors.hand_over(ben, numbers[2]) is None
        assert visitors.hand_over(owner, 99) is None
        assert visitors.hand_over(99, numbers[2]) is None
        assert visitors.hand_over(anna, numbers[2]).name == "Ben"
        assert visitors.hand_over(ben, numbers[0]).name == "Owner"
        assert visitors.presenter is None


def test_a_presenter_who_leaves_gives_control_back_to_the_owner(server, slider, monkeypatch):
    monkeypatch.setattr(module, "GRACE_S", 0.2)
    with guest(server, "Ben", BEN) as ben:
        with guest(server, "Anna", ANNA):
            hand_over(server, "Anna")
        wait_until(lambda: server.visitors.presenter is None, SOON)
        assert not moves(server, ben, slider, 6.0)  # though no owner is there
    with opened(server) as owner:
        assert moves(server, owner, slider, 6.0)


def test_a_presenter_who_loads_the_page_again_stays_in_control(server, slider, monkeypatch):
    monkeypatch.setattr(module, "GRACE_S", 1.5)
    with guest(server, "Anna", ANNA):
        hand_over(server, "Anna")
    with guest(server, "Anna", ANNA) as again:
        time.sleep(1.7)
        assert moves(server, again, slider, 6.0)


def test_one_visitor_has_one_name_in_all_tabs_and_nobody_else_has_it(server):
    with guest(server, "Anna", ANNA), guest(server, "Anna", ANNA), guest(server, "Anna", BEN):
        assert names(server) == ["Anna", "Anna 2"]
        page = max(server.get_clients())
        assert server.visitors.rename(page, "<b>Anna</b>").name == "bAnna/b"
        assert server.visitors.rename(page, "Anna").name == "Anna 2"
        assert server.visitors.rename(page, "").name == "Guest 2"


def test_without_a_shared_review_nobody_looks(server):
    with (
        knock(server, own_origin(server), "/?review=r") as page,
        pytest.raises(ConnectionClosed) as end,
    ):
        page.recv(timeout=SOON)
    assert end.value.rcvd.reason == module.ENDED
    assert server.visitors.there == []


def test_who_looks_at_a_review_that_ends_is_told_and_put_out(server):
    with opened(server), guest(server, "Anna") as anna:
        hand_over(server, "Anna")
        server.visitors.stop_sharing()
        told = heard(anna, SOON)
        assert any(m["type"] == "NotificationShowMessage" for m in told)
        assert anna.close_reason == module.ENDED
        assert server.visitors.presenter is None
        wait_until(lambda: names(server) == ["Owner"])


def test_a_change_is_by_whose_page_asked_for_it(server, slider):
    authors = []
    slider.on_update(lambda _: authors.append(server.visitors.acting()))
    with opened(server, name="Olga") as owner, guest(server, "Anna") as anna:
        assert moves(server, owner, slider, 6.0)
        hand_over(server, "Anna")
        assert moves(server, anna, slider, 7.0)
        wait_until(lambda: len(authors) >= 2)
    assert {(author.name, author.is_owner) for author in authors} >= {("Olga", True), ("Anna", False)}
    assert server.visitors.acting().is_owner  # of a thread that hears no page
