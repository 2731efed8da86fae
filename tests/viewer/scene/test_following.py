"""Cameras of who looks go where that of who presents goes, told at the websocket."""

import json
import math
import re
import time

import numpy as np
import pytest
from guests import guest, hand_over, heard, heard_until, opened
from visitors import CAMERA, encoded, update

from modeviz.viewer.page.server import open_server
from modeviz.viewer.panels.review.panel import ReviewPanel
from modeviz.viewer.scene.following import PAUSE, Following
from modeviz.viewer.session.session_title import SessionTitle


@pytest.fixture
def server():
    server = open_server(port=0)
    following = Following(server, server.visitors.has_control)
    panel = ReviewPanel(server, following.switch, SessionTitle(""))
    server.visitors.on_change(following.look_again)
    server.led = following.is_led
    server.cards = panel._cards
    yield server
    panel.close()
    server.stop()


def camera(x, **fields):
    """What a page tells of a camera that looks at the origin from there."""
    return encoded({**CAMERA, "position": (x, 0.0, 0.0), "look_at": (0.0, 0.0, 0.0), **fields})


def sent(messages):
    """The places to which a page's camera was sent, (n, 3), m."""
    said = (
        re.search(r"__modevizFollow\?\.\(\.\.\.(.*)\);", message["source"])
        for message in messages
        if message["type"] == "RunJavascriptMessage"
    )
    return np.array([json.loads(match[1])[0] for match in said if match]).reshape(-1, 3)


def wait_for_place(page, x):
    """Waits until a page's camera is sent to a place on the x-axis."""
    heard_until(page, lambda told: np.allclose(sent(told)[-1:], [[x, 0.0, 0.0]]) and len(sent(told)))


def test_who_looks_is_sent_the_newest_place_and_not_every_one(server):
    with opened(server) as owner, guest(server, "Anna") as anna:
        heard(anna)
        begin = time.monotonic()
        for i in range(40):
            owner.send(camera(2.0 + 0.1 * i))
            time.sleep(0.01)
        places = sent(heard(anna))
        lasted = time.monotonic() - begin
    assert places[-1] == pytest.approx([5.9, 0.0, 0.0])
    assert 4 <= len(places) <= math.ceil(lasted / PAUSE) + 1
    assert (np.diff(places[:, 0]) >= 0).all()


def test_a_follower_that_came_elsewhere_is_sent_again_and_one_that_is_there_is_not(server):
    with opened(server) as owner, guest(server, "Anna") as anna:
        owner.send(camera(4.0))
        heard(anna)
        anna.send(camera(9.0))
        wait_for_place(anna, 4.0)
        anna.send(camera(4.0))
        assert len(sent(heard(anna))) <= 1  # planned before it said so
        anna.send(camera(4.001))
        assert not len(sent(heard(anna)))


def test_a_narrow_picture_is_taken_from_farther_away_and_shows_as_much(server):
    with opened(server) as owner, guest(server, "Anna") as anna:
        anna.send(camera(1.0, image_width=400, image_height=600))
        owner.send(camera(4.0, image_width=800, image_height=600))
        wait_for_place(anna, 8.0)


def test_who_switches_following_off_looks_where_he_likes_until_it_is_on_again(server):
    with opened(server) as owner, guest(server, "Anna") as anna:
        owner.send(camera(4.0))
        heard(anna)
        page = max(server.get_clients())
        switch = server.cards[page]._follow
        assert server.led(page)
        anna.send(update(switch, False))
        heard(anna)
        owner.send(camera(6.0))
        assert not len(sent(heard(anna)))
        assert not server.led(page)
        anna.send(update(switch, True))
        wait_for_place(anna, 6.0)


def test_after_control_is_handed_over_the_owner_follows_and_the_presenter_does_not(server):
    with opened(server) as owner, guest(server, "Anna") as anna:
        owner.send(camera(4.0))
        hand_over(server, "Anna")
        heard(owner), heard(anna)
        anna.send(camera(7.0))
        wait_for_place(owner, 7.0)
        owner.send(camera(5.0))
        assert not len(sent(heard(anna)))


def test_pages_of_one_owner_do_not_follow_each_other(server):
    with opened(server) as one, opened(server) as other:
        heard(other)
        one.send(camera(7.0))
        assert not len(sent(heard(other)))
