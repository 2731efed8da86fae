"""A server behind proxies that it believes, and in frames of others."""

import pytest
from visitors import TOKEN, get, knock, wait_until
from websockets.exceptions import InvalidStatus

from modeviz.viewer.page.doors.guesses import MOST_GUESSES
from modeviz.viewer.page.doors.surroundings import surroundings
from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.wire.house import MOST_PAGES_OF_ONE
from modeviz.viewer.page.wire.limits import Places

PUBLIC = {"X-Forwarded-Host": "tool.example.com", "X-Forwarded-Proto": "https"}


@pytest.fixture
def proxied():
    """A server that believes who is on this machine."""
    around = surroundings(("tool.example.com",), (), ("127.0.0.1",), "/bench")
    server = open_server(port=0, token=TOKEN, around=around)
    yield server
    server.stop()


def cookie_of(server, **headers):
    return get(server, f"/?token={TOKEN}", **headers)[1]["Set-Cookie"]


def test_a_page_that_came_by_tls_has_a_cookie_for_tls_alone(proxied):
    assert "Secure" not in cookie_of(proxied)
    assert cookie_of(proxied, **PUBLIC).endswith("; HttpOnly; SameSite=Strict; Secure")


def test_a_name_that_a_proxy_was_asked_by_counts_as_the_servers_if_it_is_one(proxied):
    cookie = cookie_of(proxied, **PUBLIC).split(";")[0]
    headers = {**PUBLIC, "Cookie": cookie}
    with knock(proxied, "https://tool.example.com", **headers) as socket:
        assert socket.recv(timeout=20)
    for wrong in ({"X-Forwarded-Host": "evil.example"}, {"X-Forwarded-Host": "tool.example.com, evil"}):
        assert get(proxied, **{**headers, **wrong})[0] == 403
    for origin in ("https://evil.example", f"http://127.0.0.1:{proxied.get_port()}"):
        with pytest.raises(InvalidStatus), knock(proxied, origin, **headers):
            pass


def test_who_guesses_through_a_proxy_is_locked_out_and_others_behind_it_are_not(proxied, monkeypatch):
    monkeypatch.setattr("modeviz.viewer.page.doors.guesses.DELAY", 0.0)
    for _ in range(MOST_GUESSES):
        get(proxied, "/?token=wrong", **{"X-Forwarded-For": "203.0.113.9"})
    status = {}
    for client in ("203.0.113.9", "198.51.100.1, 203.0.113.9", "203.0.113.10"):
        status[client] = get(proxied, f"/?token={TOKEN}", **{"X-Forwarded-For": client})[0]
    assert list(status.values()) == [429, 429, 303]


def test_pages_are_counted_for_who_has_them_and_not_for_the_proxy(proxied):
    house = proxied._front.house
    house.connections, house.arrivals = Places(10, 1), Places(10, 1)
    for _ in range(MOST_PAGES_OF_ONE):
        house.pages.take("203.0.113.9")
    cookie = cookie_of(proxied).split(";")[0]
    origin = f"http://127.0.0.1:{proxied.get_port()}"

    def knocks(client):
        return knock(proxied, origin, Cookie=cookie, **{"X-Forwarded-For": client})

    with pytest.raises(InvalidStatus, match="503"), knocks("203.0.113.9"):
        pass
    clients = [f"203.0.113.{i}" for i in (10, 11, 12)]
    with knocks(clients[0]) as one, knocks(clients[1]) as two, knocks(clients[2]) as three:
        assert all(socket.recv(timeout=20) for socket in (one, two, three))
        assert not any(map(house.connections.is_free, clients))
        with pytest.raises(InvalidStatus, match="429"), knocks(clients[0]):
            pass
    wait_until(lambda: all(map(house.connections.is_free, [*clients, "127.0.0.1"])))


def test_a_page_is_below_its_prefix_or_where_a_proxy_has_taken_that_off(proxied):
    assert proxied.link.endswith(f"/bench/?token={TOKEN}")
    cookie = cookie_of(proxied).split(";")[0]
    for path in ("/bench/", "/", "/bench/index.html", "/bench/?a=b"):
        assert get(proxied, path, Cookie=cookie)[0] == 200
    status, headers, _ = get(proxied, f"/bench?a=b&token={TOKEN}")
    assert (status, headers["Location"]) == (303, f"./bench/?a=b&token={TOKEN}")
    status, headers, _ = get(proxied, f"/bench/?a=b&token={TOKEN}")
    assert (status, headers["Location"]) == (303, "./?a=b")
    for path in ("/benchmark", "/bench/bench/", "/bench//evil.example"):
        assert get(proxied, path, Cookie=cookie)[0] == 404


def test_pages_of_an_allowed_origin_and_no_other_may_show_it_in_a_frame():
    around = surroundings(frames=("https://wiki.example.com", "http://127.0.0.1:8888"))
    server = open_server(port=0, token=TOKEN, around=around)
    try:
        cookie = cookie_of(server)
        assert cookie.endswith("; SameSite=None; Secure; Partitioned")
        policy = get(server, Cookie=cookie.split(";")[0])[1]["Content-Security-Policy"]
    finally:
        server.stop()
    assert policy.startswith("frame-ancestors https://wiki.example.com http://127.0.0.1:8888; ")
