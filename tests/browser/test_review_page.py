"""A review in two browsers: what its visitor sees, may do and is told."""

import numpy as np
import pytest
from apps import open_solved_cabin
from guests import SharedHere
from pages import send, wait_for, wait_until

BANNER = "document.getElementById('modeviz-presence')?.innerText"
INERT = "getComputedStyle(document.querySelector('.mantine-Slider-root')).pointerEvents === 'none'"
MIDDLE = """(() => {
  const { x, y, width, height } = __viserMutable.canvas.getBoundingClientRect();
  return [x + width / 2, y + height / 2];
})()"""


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        server.visitors.offer(SharedHere())
        server.visitors.share()
        yield app


def turn(page):
    """Turns the camera with the mouse."""
    x, y = page.evaluate(MIDDLE)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 90, y + 20, steps=6)
    page.mouse.up()


def are_together(one, other):
    """Whether two cameras look along the same line at the same place."""
    ways = [camera.position - camera.look_at for camera in (one.camera, other.camera)]
    aimed = np.allclose(one.camera.look_at, other.camera.look_at, atol=0.02)
    return aimed and np.allclose(*(way / np.linalg.norm(way) for way in ways), atol=0.01)


def test_a_visitor_looks_along_with_who_presents_until_he_looks_himself(
    server, app, open_page, no_errors
):
    owner_page = open_page(server, (1100, 700))
    guest_page = open_page(server, (900, 700), "?review=r&fixedDpr=1")
    wait_until(guest_page, lambda: len(server.visitors.there) == 2)
    owner, guest = (server.get_clients()[page] for page in sorted(server.get_clients()))
    wait_for(guest_page, f"{BANNER} === 'Owner presents – you are looking'")
    wait_for(guest_page, INERT)
    assert owner_page.evaluate(f"{BANNER} ?? null") is None

    amplitude = app.screen.motion.animation._amplitude
    send(guest_page, amplitude, 2.0)
    send(guest_page, app.screen.controls.variants._name._box, "mine")
    card = app.screen.review._cards[guest.client_id]
    send(guest_page, card._name, "<b>Eve</b>")
    wait_until(guest_page, lambda: server.visitors.of_page(guest.client_id).name == "bEve/b")
    assert amplitude.value == 1.0
    wait_for(guest_page, "localStorage.getItem('modeviz-name') === 'bEve/b'")
    assert "bEve/b" in app.screen.review._cards[owner.client_id]._list.content

    wait_until(guest_page, lambda: are_together(owner, guest))
    began = owner.camera.position
    turn(owner_page)
    wait_until(guest_page, lambda: not np.allclose(owner.camera.position, began, atol=0.1))
    wait_until(guest_page, lambda: are_together(owner, guest))
    turn(guest_page)
    wait_for(guest_page, f"{BANNER}.endsWith('Follow')")
    guest_page.wait_for_timeout(300)
    assert not are_together(owner, guest)
    guest_page.click("#modeviz-presence button")
    wait_until(guest_page, lambda: are_together(owner, guest))

    server.visitors.hand_over(owner.client_id, server.visitors.of_page(guest.client_id).number)
    wait_for(owner_page, f"{BANNER}.startsWith('bEve/b presents')")
    wait_for(guest_page, f"{BANNER} === undefined && !({INERT})")
    send(guest_page, amplitude, 2.0)
    wait_until(guest_page, lambda: amplitude.value == 2.0)
    owner_page.click("#modeviz-presence button:last-child")
    wait_for(owner_page, f"{BANNER} === undefined")

    server.visitors.stop_sharing()
    told = "document.getElementById('modeviz-connection')?.innerText"
    wait_for(guest_page, f"{told} === 'Not connected: the review has ended: ask for another link.'")
    no_errors(guest_page)  # of a websocket that is closed
