"""The server of a notebook's page: in a frame, and behind the server of a notebook elsewhere."""

import http.client
from base64 import b64encode

import pytest
from visitors import PATIENCE_S, TOKEN, get, own_origin

from modeviz.viewer.page.doors.door import ALIVE, SUBPROTOCOL
from modeviz.viewer.page.server import open_server

HUB, OTHER = "hub.example.com:8443", "https://evil.example"


@pytest.fixture(scope="module")
def framed():
    server = open_server(port=0, token=TOKEN, is_framed=True)
    yield server
    server.stop()


def cookies(server, path=f"/?token={TOKEN}", **headers):
    """What a server sets who asks for a page."""
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=PATIENCE_S)
    connection.request("GET", path, headers=headers)
    return connection.getresponse().headers.get_all("Set-Cookie") or []


def entered(server):
    return cookies(server)[0].split(";")[0]


def knocked(server, origin, cookie):
    """The status that a websocket from a page elsewhere gets through the notebook's server."""
    return get(
        server,
        Host=HUB,
        Origin=origin,
        Cookie=cookie,
        Upgrade="websocket",
        Connection="Upgrade",
        **{
            "Sec-WebSocket-Key": b64encode(bytes(16)).decode(),
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Protocol": SUBPROTOCOL,
        },
    )[0]


def test_a_page_for_notebooks_may_be_framed_by_itself_this_machine_and_vs_code_alone(framed):
    status, headers, _ = get(framed, "/", Cookie=entered(framed))
    assert status == 200
    name, *ancestors = headers["Content-Security-Policy"].split(";")[0].split()
    assert name == "frame-ancestors"
    machine = {
        f"{scheme}://{name}:*" for scheme in ("http", "https") for name in ("localhost", "127.0.0.1")
    }
    assert set(ancestors) == {"'self'", "vscode-webview:", "vscode-file:", *machine}


def test_a_browser_keeps_the_cookie_in_a_frame_of_another_site_and_without_tls_at_home(framed):
    """One of two sites is kept for the other alone; a name without TLS keeps none that is secure."""
    set_by_us = [cookie.split("; ") for cookie in cookies(framed, Host=HUB)]
    assert [kept for _, _, *kept in set_by_us] == [
        ["HttpOnly", "SameSite=Strict"],
        ["HttpOnly", "SameSite=None", "Secure", "Partitioned"],
    ]
    assert set_by_us[0][0] == set_by_us[1][0]


def test_under_any_name_who_has_the_token_gets_in_and_nobody_else(framed):
    cookie = entered(framed)
    assert get(framed, Host=HUB)[0] == 403
    assert get(framed, Host=HUB, Cookie=cookie)[0] == 200
    assert get(framed, Host="hub.example.com; script-src *", Cookie=cookie)[0] == 403
    assert knocked(framed, f"https://{HUB}", cookie) == 101
    for origin, brought in ((f"https://{HUB}", ""), (OTHER, cookie), (own_origin(framed), cookie)):
        assert knocked(framed, origin, brought) == 403


def test_the_picture_that_says_who_is_alive_is_for_who_has_the_token(framed):
    assert get(framed, f"/{ALIVE}")[0] == 403
    assert get(framed, f"/{ALIVE}?token=wrong")[0] == 403
    status, headers, _ = get(framed, f"/{ALIVE}?token={TOKEN}")
    assert (status, headers["Location"]) == (303, f"./{ALIVE}")
    status, headers, picture = get(framed, f"/{ALIVE}", Cookie=entered(framed))
    assert (status, headers["Content-Type"]) == (200, "image/svg+xml")
    assert picture.startswith(b"<svg")
