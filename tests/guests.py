"""Pages without a browser that come to a session by its own address or by the link of a review."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlencode

from visitors import CAMERA, PATIENCE_S, encoded, knock, own_origin, update, wait_until
from websockets.exceptions import ConnectionClosed

from benchmarks.page_client import messages
from modeviz.viewer.page.people.looking import let_all_use


class SharedHere:
    """Makes a link, and keeps whether it opens something."""

    def __init__(self):
        self.is_shared = False

    def share(self, author: str) -> str:
        self.is_shared = True
        return "./?review=r"

    def stop(self) -> None:
        self.is_shared = False


@contextmanager
def opened(server, **query: str) -> Iterator:
    """A page that has told its camera; its query says who looks, `review` that it is a visitor's."""
    before = set(server.get_clients())
    with knock(server, own_origin(server), f"/?{urlencode(query)}") as page:
        page.send(encoded(CAMERA))
        wait_until(lambda: set(server.get_clients()) - before)
        yield page


@contextmanager
def guest(server, name: str = "", key: str = "") -> Iterator:
    """A page of a review, which is shared."""
    if not server.visitors.is_shared:
        server.visitors.offer(SharedHere())
        server.visitors.share()
    with opened(server, review="r", name=name, visitor=key) as page:
        yield page


def hand_over(server, name: str) -> None:
    """Has the owner hand control over to somebody who is there."""
    number = next(each.number for each in server.visitors.there if each.name == name)
    with opened(server):
        assert server.visitors.hand_over(max(server.get_clients()), number)


def take_back(server) -> None:
    """Has the owner take control."""
    with opened(server):
        page = max(server.get_clients())
        assert server.visitors.hand_over(page, server.visitors.of_page(page).number)


def all_is_heard(server, page) -> None:
    """Waits until a server has heard everything that a page has said."""
    last = server.gui.add_checkbox("heard", False)
    let_all_use(last)
    page.send(update(last, True))
    wait_until(lambda: last.value)


def heard_until(page, found: Callable[[list], Any]) -> Any:
    """Listens until something is found in what a page has been told, and gives that."""
    told, end = [], time.monotonic() + PATIENCE_S
    while not (result := found(told)):
        told += messages(page.recv(timeout=end - time.monotonic()))
    return result


def heard(page, seconds: float = 0.3) -> list:
    """What a page is told until it is quiet for so long."""
    told = []
    try:
        while True:
            told += messages(page.recv(timeout=seconds))
    except (TimeoutError, ConnectionClosed):
        return told
