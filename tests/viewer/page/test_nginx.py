"""A server behind a real nginx, as the documentation has it: TLS, a path, websockets."""

import http.client
import socket
import ssl
from pathlib import Path

import pytest
import viser
from nginx import NAME, certificate, documented, free_port, nginx
from visitors import PATIENCE_S, TOKEN
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from benchmarks.page_client import handshake
from modeviz.viewer.page.doors.guesses import MOST_GUESSES
from modeviz.viewer.page.doors.surroundings import surroundings
from modeviz.viewer.page.server import open_server

DOCS = Path(__file__).parents[3] / "docs" / "serving.md"


class Outside:
    """Who reaches nginx alone, from an address of their own."""

    def __init__(self, port: int, made: Path) -> None:
        self.port = port
        self._tls = ssl.create_default_context(cafile=made)

    def socket(self, address: str) -> ssl.SSLSocket:
        plain = socket.create_connection(("127.0.0.1", self.port), PATIENCE_S, (address, 0))
        return self._tls.wrap_socket(plain, server_hostname=NAME)

    def get(self, path: str, address: str = "127.0.0.2", **headers: str):
        connection = http.client.HTTPSConnection(NAME, self.port)
        connection.sock = self.socket(address)
        connection.request("GET", path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.headers, answer.read()

    def knock(self, origin: str, address: str = "127.0.0.2", **headers: str):
        url = f"ws://{NAME}:{self.port}/bench/"
        options = handshake(origin, viser.__version__, **headers)
        return connect(url, sock=self.socket(address), open_timeout=PATIENCE_S, **options)


@pytest.fixture(scope="module")
def served():
    around = surroundings((NAME,), (), ("127.0.0.1",), "/bench")
    server = open_server(port=0, token=TOKEN, around=around)
    yield server
    server.stop()


@pytest.fixture(scope="module")
def outside(served, tmp_path_factory):
    folder, port = tmp_path_factory.mktemp("nginx"), free_port()
    made, key = certificate(folder)
    with nginx(folder, documented(DOCS.read_text(), port, served.get_port(), made, key), [port]):
        yield Outside(port, made)


@pytest.fixture(scope="module")
def cookie(outside):
    status, headers, _ = outside.get(f"/bench/?token={TOKEN}&a=b")
    assert (status, headers["Location"]) == (303, "./?a=b")
    cookie, *flags = headers["Set-Cookie"].split("; ")
    assert flags == ["Max-Age=2592000", "HttpOnly", "SameSite=Strict", "Secure"]
    return cookie


def test_the_documented_proxy_serves_the_page_and_its_websocket(outside, cookie):
    assert outside.get("/bench/")[0] == 403
    assert outside.get("/bench?a=b")[1]["Location"] == "./bench/?a=b"
    status, headers, page = outside.get("/bench/", Cookie=cookie)
    assert status == 200
    assert b"<title>modeviz</title>" in page
    assert f"wss://{NAME}" in headers["Content-Security-Policy"]
    with outside.knock(f"https://{NAME}:{outside.port}", Cookie=cookie) as websocket:
        assert websocket.recv(timeout=PATIENCE_S)


def test_through_it_no_other_site_gets_a_websocket_and_nobody_without_the_cookie(outside, cookie):
    for origin, brought in (("https://evil.example", cookie), (f"https://{NAME}:{outside.port}", "")):
        with pytest.raises(InvalidStatus, match="403"), outside.knock(origin, Cookie=brought):
            pass
    for told in ({}, {"X-Forwarded-Host": NAME}, {"Forwarded": f"host={NAME}"}):
        assert outside.get("/bench/", Cookie=cookie, Host="evil.example", **told)[0] == 403


def test_through_it_each_client_is_one(outside, monkeypatch):
    """Whatever they write into the header themselves."""
    monkeypatch.setattr("modeviz.viewer.page.doors.guesses.DELAY", 0.0)
    told = {"X-Forwarded-For": "127.0.0.9"}
    for _ in range(MOST_GUESSES):
        assert outside.get("/bench/?token=wrong", "127.0.0.3", **told)[0] == 403
    assert outside.get("/bench/?token=wrong", "127.0.0.3", **told)[0] == 429
    assert outside.get(f"/bench/?token={TOKEN}", "127.0.0.4", **told)[0] == 303
