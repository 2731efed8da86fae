"""The link of a review that was given out before a restart, and what its owner can do then."""

from contextlib import contextmanager

import pytest
from serving_cabin import key_of, page_at, serving, way
from visitors import get, update, wait_until

from modeviz.errors import ModevizError
from modeviz.journal.keys import digest_of
from modeviz.journal.records import Records
from modeviz.viewer.panels.review.card import ANOTHER, COPY, REPLACE, STOP
from modeviz.viewer.session.session_title import SessionTitle


@contextmanager
def owners_card(front, directory, path):
    """The folder on the owner's page, and the page."""
    with page_at(front, path) as page:
        wait_until(lambda: directory.sessions.open)
        (session,) = directory.sessions.open.values()
        wait_until(lambda: session.app.screen.review._cards)
        (card,) = session.app.screen.review._cards.values()
        wait_until(lambda: card._now)
        yield card, page


@pytest.fixture
def file(tmp_path):
    return tmp_path / "cabin.modeviz"


@pytest.fixture
def given_out(file):
    """The address of a session, and the link that its owner gave out before the server ended."""
    with serving(file) as (front, directory):
        path = way(front)
        with owners_card(front, directory, path) as (card, _):
            link = card._visitors.share().removeprefix(".")
            wait_until(lambda: card._links.options == (COPY, STOP))
            assert "It is stored nowhere: keep it" in card._link.content
    return path, link


@pytest.mark.parametrize(("button", "goes_on"), [(ANOTHER, True), (REPLACE, False)])
def test_the_owner_makes_a_new_link_and_the_old_one_stays_or_ends(file, given_out, button, goes_on):
    path, old = given_out
    with serving(file) as (front, directory), owners_card(front, directory, path) as (card, page):
        wait_until(lambda: card._links.options == (ANOTHER, REPLACE, STOP))
        assert "cannot be shown again" in card._link.content
        assert get(front, old)[0] == 200
        page.send(update(card._links, button))
        wait_until(lambda: card._visitors.link)
        new = card._visitors.link.removeprefix(".")
        assert new != old
        assert get(front, new)[0] == 200
        assert get(front, old)[0] == (200 if goes_on else 404)
    (session,) = Records.of_file(file).sessions()
    assert [review.author for review in session.reviews] == ["Owner", "Owner"]
    assert [review.ended is None for review in session.reviews] == [goes_on, True]


def test_the_owner_names_the_session_on_all_pages_and_in_the_study(file, given_out):
    path, _ = given_out
    with serving(file) as (front, directory), owners_card(front, directory, path) as (card, page):
        page.send(update(card._title, "  Softer   cab "))
        wait_until(lambda: "Softer cab" in card._list.content)
    assert [each.title for each in Records.of_file(file).sessions()] == ["Softer cab"]
    with serving(file) as (front, directory), owners_card(front, directory, path) as (card, _):
        assert card._title.value == "Softer cab"
        assert directory.sessions.get(("cabin", digest_of(key_of(path))))


@pytest.mark.parametrize("wrong", ["x" * 61, "a\x07b"])
def test_a_title_that_cannot_be_told_is_refused(wrong):
    title = SessionTitle("before")
    with pytest.raises(ModevizError, match="the title has"):
        title.put(wrong)
    assert title.text == "before"
