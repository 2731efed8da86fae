"""What a page says while it is not connected, and that one behind a proxy is."""

import re

import pytest
from pages import NOTICE, said_in_time, wait_for
from small_proxy import proxy
from visitors import TOKEN

from modeviz.viewer.page.doors.door import WHY
from modeviz.viewer.page.server import open_server

SEEN = "document.elementFromPoint(innerWidth / 2, innerHeight / 2).textContent"


@pytest.fixture(scope="module")
def locked():
    """A server that others may reach, with the token; every page is told that it is live."""
    server = open_server("0.0.0.0", 0, token=TOKEN, title="Bench")
    server.scene.configure_environment_map(None)

    @server.on_client_connect
    def _(client):
        client.gui.add_markdown("live")

    yield server
    server.stop()


def without_upgrade(path, headers):
    return path, {k: v for k, v in headers.items() if k not in ("Upgrade", "Connection")}


def silent_to_sockets(path, headers):
    return None if "Upgrade" in headers else (path, headers)


def silent_to_all_but_the_page(path, headers):
    return None if "Upgrade" in headers or WHY in path else (path, headers)


def other_host(port):
    return lambda path, headers: (path, {**headers, "Host": f"127.0.0.1:{port}"})


def without_prefix(path, headers):
    """As nginx does with `location /truck/`: it knows no other place."""
    assert path.startswith("/truck/"), path
    return path.removeprefix("/truck"), headers


def test_page_behind_the_token_works_in_a_browser(locked, show):
    page = show(locked.local_link)
    assert TOKEN not in page.url
    assert page.title() == "Bench"
    wait_for(page, "document.body.innerText.includes('live')")
    page.wait_for_timeout(4000)
    assert page.evaluate(NOTICE) is None
    assert "Opening" not in page.evaluate(SEEN)


@pytest.mark.parametrize("change", [without_upgrade, silent_to_sockets])
def test_a_page_whose_socket_is_blocked_says_so(locked, show, change):
    with proxy(locked.get_port(), change) as port:
        page = show(f"http://127.0.0.1:{port}/?token={TOKEN}")
        said = said_in_time(page)
        assert said.startswith("Not connected: ")
        assert "WebSocket, does not get through: a proxy or firewall" in said


def test_a_page_whose_socket_opens_and_stays_silent_says_so(locked, show):
    with proxy(locked.get_port(), lambda path, headers: (path, headers), is_mute=True) as port:
        page = show(f"http://127.0.0.1:{port}/?token={TOKEN}")
        assert "is open, but nothing has come through it yet" in said_in_time(page)
        assert page.evaluate(SEEN) == "Opening …"


def test_a_page_of_which_all_that_follows_is_held_back_says_so(locked, show):
    with proxy(locked.get_port(), silent_to_all_but_the_page) as port:
        page = show(f"http://127.0.0.1:{port}/?token={TOKEN}")
        assert "the server does not answer" in said_in_time(page)


def test_a_page_whose_socket_is_refused_says_why(locked, show):
    with proxy(locked.get_port(), other_host(locked.get_port())) as port:
        page = show(f"http://127.0.0.1:{port}/?token={TOKEN}")
        said = said_in_time(page)
        assert f"this one is at http://127.0.0.1:{port}" in said
        assert "has to pass the header Host on" in said


def test_a_page_behind_a_prefix_is_live_and_can_be_loaded_again(locked, show):
    with proxy(locked.get_port(), without_prefix) as port:
        page = show(f"http://127.0.0.1:{port}/truck/?a=b&token={TOKEN}")
        for _ in range(2):
            wait_for(page, "document.body.innerText.includes('live')")
            assert re.fullmatch(rf"http://127\.0\.0\.1:{port}/truck/\?a=b", page.url)
            page.reload()


def test_a_page_whose_server_has_ended_says_so_until_there_is_one_again(show):
    server = open_server(port=0)
    port = server.get_port()
    server.scene.configure_environment_map(None)
    server.gui.add_markdown("live")
    page = show(server.link)
    wait_for(page, "document.body.innerText.includes('live')")
    server.stop()
    assert "modeviz was stopped" in wait_for(page, NOTICE)
    server = open_server(port=port)
    page.bring_to_front()
    wait_for(page, f"!{NOTICE}")
    server.stop()
