"""Whose turn it is where sessions are opened, at a front whose sessions take long to open."""

import asyncio
import socket
import time

import pytest
from visitors import get, wait_until

from modeviz.viewer.page.doors.answers import answer
from modeviz.viewer.page.front import OPENED_AT_ONCE, open_front
from modeviz.viewer.page.wire import request_head
from modeviz.viewer.page.wire.request_head import query_of

MANY = 12


class SlowSite:
    """Opens a session only when it is told to, and none in the end."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.n_ended = 0
        self.may_end = False

    async def page(self, connection, request):
        return answer(200, "page")

    async def acceptor(self, request):
        self.begun.append(query_of(request)["who"])
        while not self.may_end:
            await asyncio.sleep(0.01)
        self.n_ended += 1


@pytest.fixture
def slow():
    site, front = SlowSite(), open_front(port=0)
    front.open(site)
    yield front, site
    site.may_end = True
    front.close()


def knocking(front, who, address="127.0.0.1"):
    """A connection that asks for a websocket."""
    port = front.get_port()
    connection = socket.create_connection(("127.0.0.1", port), 10, (address, 0))
    head = [
        f"GET /?who={who} HTTP/1.1",
        f"Host: 127.0.0.1:{port}",
        f"Origin: http://127.0.0.1:{port}",
        "Upgrade: websocket",
        "Connection: Upgrade",
    ]
    connection.sendall("\r\n".join([*head, "", ""]).encode())
    return connection


def test_who_wants_many_sessions_keeps_nobody_else_waiting(slow):
    front, site = slow
    greedy = [knocking(front, "greedy") for _ in range(MANY)]
    wait_until(lambda: len(site.begun) == OPENED_AT_ONCE)
    other = knocking(front, "other", "127.0.0.2")
    wait_until(lambda: "other" in site.begun)
    assert site.begun.count("greedy") == OPENED_AT_ONCE
    site.may_end = True
    wait_until(lambda: site.n_ended == MANY + 1)
    for connection in (*greedy, other):
        connection.close()


def test_no_session_is_opened_for_who_has_left(slow):
    front, site = slow
    for _ in range(MANY):
        knocking(front, "gone").close()
    stays = knocking(front, "stays")
    site.may_end = True
    wait_until(lambda: "stays" in site.begun)
    assert site.begun.count("gone") <= OPENED_AT_ONCE
    stays.close()


def test_a_head_that_comes_slowly_is_looked_at_seldom_and_read_in_the_end(slow, monkeypatch):
    front, _ = slow
    looks = []
    look = request_head.request_head
    monkeypatch.setattr(request_head, "request_head", lambda each: looks.append(each) or look(each))
    port = front.get_port()
    with socket.create_connection(("127.0.0.1", port), 10) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\n")
        time.sleep(1.5)
        assert len(looks) < 10
        connection.sendall(f"Host: 127.0.0.1:{port}\r\n\r\n".encode())
        assert connection.recv(100).startswith(b"HTTP/1.1 200")
    assert get(front)[0] == 200
