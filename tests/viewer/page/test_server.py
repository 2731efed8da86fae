"""Who gets in, by raw HTTP and by websocket."""

import gzip
import http.client
import math
import re
import socket
from functools import partial
from urllib.parse import urlencode

import pytest
import rich
import viser
from viser import _messages
from visitors import CAMERA, TOKEN, encoded, get, knock, own_origin, wait_until
from websockets.exceptions import ConnectionClosed, InvalidStatus

from benchmarks.page_client import messages as decoded
from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.door import WHY
from modeviz.viewer.page.doors.kept_tokens import LIFE_S, KeptToken
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import surroundings
from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.wire.house import MOST_OPENINGS


@pytest.fixture(scope="module")
def server():
    """A server for whoever is on this machine."""
    server = open_server(port=0)
    yield server
    server.stop()


@pytest.fixture(scope="module")
def locked():
    """A server that others may reach, with the token."""
    server = open_server("0.0.0.0", 0, token=TOKEN, title="Bench")
    yield server
    server.stop()


def refused_status(server, origin, path="/", **headers):
    with pytest.raises(InvalidStatus) as refusal, knock(server, origin, path, **headers):
        pass
    return refusal.value.response.status_code


def test_page_has_our_title_and_icon_and_may_not_be_framed(server):
    status, headers, page = get(server)
    assert status == 200
    assert b"<title>modeviz</title>" in page
    assert b'href="data:image/svg+xml;base64,' in page
    assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]


def test_a_server_says_nothing_by_itself_wherever_rich_would_show_it(capsys):
    with rich.get_console().capture() as shown:  # as in a notebook, where rich needs no stdout
        open_server(port=0).stop()
    assert shown.get() == ""
    assert capsys.readouterr().out == ""
    assert not rich.get_console().quiet


def test_pages_of_other_origins_can_take_no_answer_for_a_picture_or_a_script(server):
    for path in ("/", "/nothing", f"/{WHY}", "/?websocket=x"):
        headers = get(server, path)[1]
        assert headers["Cross-Origin-Resource-Policy"] == "same-origin"
        assert headers["X-Content-Type-Options"] == "nosniff"


def test_zipped_page_is_the_same_page(server):
    status, headers, body = get(server, **{"Accept-Encoding": "gzip"})
    assert (status, headers["Content-Encoding"]) == (200, "gzip")
    assert int(headers["Content-Length"]) == len(body)
    assert gzip.decompress(body) == get(server)[2]


def test_page_is_given_to_who_names_no_encoding(server):
    connection = http.client.HTTPConnection("127.0.0.1", server.get_port(), timeout=20)
    connection.putrequest("GET", "/", skip_accept_encoding=True)
    connection.endheaders()
    assert connection.getresponse().status == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "127.0.0.1.evil.example", "10.0.0.1", "me@127.0.0.1", "[::1", ""]
)
def test_foreign_host_is_refused(server, host):
    assert get(server, Host=f"{host}:{server.get_port()}")[0] == 403


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"])
def test_names_of_this_machine_are_welcome(server, host):
    assert get(server, Host=f"{host}:{server.get_port()}")[0] == 200


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1"])
def test_foreign_origin_is_refused_at_page_and_websocket(server, origin):
    assert get(server, Origin=origin)[0] == 403
    assert refused_status(server, origin) == 403


def test_websocket_without_an_origin_is_refused(server):
    assert refused_status(server, None) == 403


@pytest.mark.parametrize(
    "parameter", ["websocket=ws://evil.example", "playbackPath=http://evil.example"]
)
def test_links_to_other_peoples_scenes_are_refused(server, parameter):
    assert get(server, f"/?{parameter}")[0] == 403
    assert refused_status(server, own_origin(server), f"/?{parameter}") == 403


def test_own_page_may_open_a_websocket(server):
    with knock(server, own_origin(server)) as socket:
        assert socket.recv(timeout=20)


def test_without_the_token_nobody_enters(locked):
    assert get(locked)[0] == 403
    assert get(locked, "/?token=wrong")[0] == 403
    for cookie in ("wrong", TOKEN):
        assert get(locked, Cookie=f"modeviz{locked.get_port()}={cookie}")[0] == 403
    assert refused_status(locked, own_origin(locked)) == 403
    assert refused_status(locked, own_origin(locked), f"/?token={TOKEN}") == 403


def test_link_with_the_token_is_exchanged_for_a_cookie_that_opens_page_and_websocket(locked):
    status, headers, _ = get(locked, f"/?vehicle=truck&token={TOKEN}")
    assert (status, headers["Location"]) == (303, "./?vehicle=truck")
    assert headers["Set-Cookie"].endswith("; HttpOnly; SameSite=Strict")
    assert TOKEN not in headers["Set-Cookie"]
    cookie = headers["Set-Cookie"].split(";")[0]
    status, _, page = get(locked, "/?vehicle=truck", Cookie=cookie)
    assert status == 200
    assert b"<title>Bench</title>" in page
    with knock(locked, own_origin(locked), Cookie=cookie) as socket:
        assert socket.recv(timeout=20)


def test_link_cannot_send_the_browser_elsewhere(locked):
    for path in ("//evil.example", "/\\evil.example", "/%0d%0aevil:", "/a/http:evil.example"):
        location = get(locked, f"{path}?token={TOKEN}")[1]["Location"]
        assert re.fullmatch(r"\./[\w.%]*", location)


def test_a_cookie_outlives_the_browser_and_the_server_but_not_the_token(locked):
    """A browser deletes a cookie that says no age when it ends."""
    given = get(locked, f"/?token={TOKEN}")[1]["Set-Cookie"]
    assert re.search(r"; Max-Age=2592000;", given)
    value = given.split(";")[0].partition("=")[2]
    for token, status in ((TOKEN, 200), ("another-token-1", 403)):
        again = open_server(port=0, token=token)
        try:
            assert get(again, Cookie=f"modeviz{again.get_port()}={value}")[0] == status
        finally:
            again.stop()


def test_a_cookie_that_is_a_day_old_is_renewed_with_the_page():
    now = [1e9]
    server = open_server(port=0, token=Secret(TOKEN, lambda: now[0]))
    try:
        cookie = cookie_of(server)
        assert "Set-Cookie" not in get(server, Cookie=cookie)[1]
        now[0] += 2 * 86400
        renewed = get(server, Cookie=cookie)[1]["Set-Cookie"]
        now[0] += LIFE_S - 86400
        assert get(server, Cookie=cookie)[0] == 403
        assert get(server, Cookie=renewed.split(";")[0])[0] == 200
    finally:
        server.stop()


def test_a_token_that_is_revoked_throws_everybody_out_who_has_not_brought_the_new_one(tmp_path, capfd):
    kept = KeptToken(tmp_path / "token", ())
    server = open_server(port=0, token=Secret(kept.token))
    try:
        link, cookie = server.link, cookie_of(server, kept.token())
        with knock(server, own_origin(server), Cookie=cookie) as socket:
            assert socket.recv(timeout=20)
            kept.replace()
            with pytest.raises(ConnectionClosed):
                list(iter(partial(socket.recv, timeout=5), None))
        assert get(server, Cookie=cookie)[0] == 403
        assert get(server, link[link.index("/?") :])[0] == 403
        assert refused_status(server, own_origin(server), Cookie=cookie) == 403
        assert capfd.readouterr().out == f"modeviz is now at {server.link}\n"
        cookie = cookie_of(server, kept.token())
        with knock(server, own_origin(server), Cookie=cookie) as socket:
            assert socket.recv(timeout=20)
    finally:
        server.stop()


def cookie_of(locked, token=TOKEN):
    """That of who has brought the token."""
    return get(locked, f"/?token={token}")[1]["Set-Cookie"].split(";")[0]


def test_a_path_that_a_proxy_puts_before_ours_survives_the_token(locked):
    """A browser puts what it is sent to after the folder it asked for, which only it knows."""
    for path, page in (("/", "./"), ("/index.html", "./index.html")):
        _, headers, _ = get(locked, f"{path}?a=b&token={TOKEN}")
        assert headers["Location"] == f"{page}?a=b"
        assert "Path" not in headers["Set-Cookie"]  # so it is that folder, too


def test_shared_server_knows_its_addresses_but_no_foreign_name(locked):
    port = locked.get_port()
    cookie = cookie_of(locked)
    for host in ("192.0.2.7", socket.gethostname(), "localhost"):
        assert get(locked, Host=f"{host}:{port}", Cookie=cookie)[0] == 200
    assert get(locked, Host=f"evil.example:{port}", Cookie=cookie)[0] == 403


@pytest.fixture(scope="module")
def public():
    """A server that a proxy makes known under a name."""
    server = open_server(port=0, around=surroundings(("Tool.example.com",)))
    yield server
    server.stop()


@pytest.mark.parametrize("host", ["tool.example.com", "TOOL.example.com:8443", "127.0.0.1"])
def test_a_public_name_is_welcome_beside_those_of_this_machine(public, host):
    status, headers, _ = get(public, Host=host)
    assert status == 200
    assert "wss://tool.example.com:*" in headers["Content-Security-Policy"]


@pytest.mark.parametrize("host", ["evil.example", "tool.example.com.evil.example", "example.com"])
def test_a_public_name_lets_no_other_in(public, host):
    assert get(public, Host=host)[0] == 403
    assert refused_status(public, f"https://{host}") == 403


def test_a_page_of_a_public_name_may_open_a_websocket_even_if_the_proxy_calls_us_otherwise(public):
    with knock(public, "https://tool.example.com") as socket:
        assert socket.recv(timeout=20)
    assert refused_status(public, "ftp://tool.example.com") == 403


def why(server, **query):
    """What a page is told that cannot open its websocket."""
    about = {"origin": own_origin(server), "subprotocol": f"viser-v{viser.__version__}", **query}
    headers = about.pop("headers", {})
    status, _, text = get(server, f"/some/path/{WHY}?{urlencode(about)}", **headers)
    assert status == 200
    return text.decode()


def test_a_page_is_told_why_its_websocket_is_refused(server, locked):
    assert why(server) == ""
    assert "pass the header Host on" in why(server, origin="http://tool.example.com")
    assert "another version" in why(server, subprotocol="viser-v0.2")
    assert "whole link" in why(locked)
    assert why(locked, headers={"Cookie": cookie_of(locked)}) == ""
    locked._front.house.openings.take(MOST_OPENINGS + 1.0)
    assert "many pages are being opened" in why(locked, headers={"Cookie": cookie_of(locked)})
    locked._front.house.openings.take(-MOST_OPENINGS - 1.0)
    assert get(server, f"/{WHY}", Host="evil.example")[0] == 403


def test_port_in_use_is_an_error_that_says_so(server):
    port = server.get_port()
    with pytest.raises(ModevizError, match=f"port {port} of 127.0.0.1 is in use: choose another with"):
        open_server(port=port)


@pytest.mark.parametrize("port", [-1, 70000])
def test_impossible_port_is_an_error_that_says_so(port):
    with pytest.raises(ModevizError, match=f"port: found {port}, expected 0 to 65535"):
        open_server(port=port)


def test_address_of_another_machine_is_an_error_that_says_so():
    with pytest.raises(ModevizError, match=r"cannot listen on port 0 of 192\.0\.2\.1"):
        open_server("192.0.2.1", 0, token=TOKEN)


def test_other_machines_need_a_token():
    with pytest.raises(ModevizError, match="a token is needed"):
        open_server("0.0.0.0", 0)


def test_token_that_would_break_a_cookie_is_refused():
    with pytest.raises(ModevizError, match="letters, digits"):
        open_server(port=0, token="a;b;c;d;e;f;g")


def test_server_says_nothing_on_the_terminal(capfd):
    open_server(port=0).stop()
    assert capfd.readouterr().out == ""


def test_what_is_said_to_a_page_that_has_left_is_not_on_the_terminal(server, recwarn):
    left = []
    server.on_client_disconnect(left.append)
    with knock(server, own_origin(server)) as socket:
        socket.send(encoded(CAMERA))
        wait_until(server.get_clients)
    wait_until(lambda: left)
    left[0].add_notification("Gone", "too late")
    left[0].flush()
    assert not recwarn.list


def test_public_tunnel_cannot_be_asked_for(server):
    assert server.request_share_url() is None
    handlers = server._websock_server._incoming_handlers
    assert _messages.ShareUrlRequest not in handlers
    assert _messages.ShareUrlDisconnect not in handlers


@pytest.fixture(scope="module")
def fence(server):
    """A widget whose correction shows that everything said before has been handled."""
    return server.gui.add_checkbox("Fence", False)


def say(server, fence, *messages, n_fences=1):
    """Sends messages as a page would, and returns the values it is sent until the fence's own.

    That comes at once, and for a second time when all that was refused is put right again.
    """
    corrections = []
    with knock(server, own_origin(server)) as socket:
        for message in (*messages, update(fence, value="neither")):
            socket.send(encoded(message))
        while sum(m["uuid"] == fence._impl.uuid for m in corrections) < n_fences:
            sent = decoded(socket.recv(timeout=20))
            corrections += [m for m in sent if m["type"] == "GuiUpdateMessage"]
    return corrections[:-1]


def update(handle, **updates):
    return {"type": "GuiUpdateMessage", "uuid": handle._impl.uuid, "updates": updates}


@pytest.fixture(scope="module")
def slider(server):
    return server.gui.add_slider("Rate", min=0.0, max=10.0, step=0.1, initial_value=5.0)


def test_possible_value_arrives(server, fence, slider):
    say(server, fence, update(slider, value=7))
    assert slider.value == 7.0
    say(server, fence, update(slider, value=5))


@pytest.mark.parametrize("value", [1e9, -0.1, math.nan, math.inf, "5", True, None, [5.0]])
def test_impossible_slider_values_are_dropped(server, fence, slider, value):
    say(server, fence, update(slider, value=value))
    assert slider.value == 5.0


def test_page_cannot_set_internal_attributes(server, fence, slider):
    say(server, fence, update(slider, update_cb=[]))
    say(server, fence, update(slider, value=6.0, removed=True))
    assert slider.value == 5.0
    assert not slider._impl.removed


@pytest.mark.parametrize(
    ("add", "possible", "impossible"),
    [
        (lambda gui: gui.add_dropdown("d", ("a", "b")), ["b"], ["c", 1, None, ["a"]]),
        (lambda gui: gui.add_button_group("g", ("a", "b")), ["b"], ["c", True]),
        (lambda gui: gui.add_checkbox("c", False), [True], [1, "true"]),
        (lambda gui: gui.add_text("t", "x"), ["y"], ["y" * 4001, 3]),
        (lambda gui: gui.add_number("n", 1, min=0, max=3), [2], [4, -1, math.nan]),
        (
            lambda gui: gui.add_vector3("v", (1.0, 2, 3), min=(0.0, 0, 0)),
            [[3, 2, 1]],
            [[1, 2], [-1, 2, 3]],
        ),
        (lambda gui: gui.add_multi_slider("m", 0, 9, 1, (1, 2)), [[3, 4]], [[3, 10], [1], "34"]),
    ],
)
def test_every_widget_takes_what_it_can_produce_and_nothing_else(
    server, fence, add, possible, impossible
):
    widget = add(server.gui)
    start = widget.value
    for value in impossible:
        say(server, fence, update(widget, value=value))
        assert widget.value == start
    for value in possible:
        say(server, fence, update(widget, value=value))
        assert widget.value == (tuple(value) if isinstance(value, list) else value)
    widget.remove()


def test_refused_value_is_put_back_on_the_screen(server, fence):
    number = server.gui.add_number("Speed", 20.0, min=0.0, max=50.0)
    sent = say(server, fence, update(number, value=1e9))
    corrections = [m["updates"] for m in sent if m["uuid"] == number._impl.uuid]
    assert corrections == [{"value": 20.0}]
    number.remove()


def test_a_correction_does_not_undo_the_possible_value_that_follows(server, fence):
    """As a box does that is left with a number that is too large: it says that, then the largest."""
    number = server.gui.add_number("Speed", 20.0, min=0.0, max=50.0)
    wrong, right = update(number, value=99999), update(number, value=50)
    sent = say(server, fence, wrong, right, n_fences=2)
    corrections = [m["updates"] for m in sent if m["uuid"] == number._impl.uuid]
    assert corrections == [{"value": 20.0}, {"value": 50.0}]
    assert number.value == 50
    number.remove()


def test_message_of_a_kind_we_do_not_use_is_dropped(server, fence):
    heard = []
    kind = _messages.GuiButtonHoldMessage
    server._websock_server.register_handler(kind, lambda _, message: heard.append(message))
    say(server, fence, {"type": kind.__name__, "uuid": "no widget", "frequency": 10.0})
    assert not heard


def test_a_camera_that_no_page_has_is_dropped(server, fence):
    clients = []

    @server.on_client_connect  # a client is one whose camera has been heard of
    async def _(client):
        clients.append(client)

    for wrong in (
        {"position": (math.nan, 0.0, 0.0)},
        {"position": (1.0,) * 1000},
        {"wxyz": (1.0, 0.0, 0.0)},
        {"wxyz": (0.0,) * 4},
        {"near": math.inf},
        {"image_height": 0},
        {"image_width": 30_000},
    ):
        say(server, fence, {**CAMERA, **wrong})
        assert not clients
    say(server, fence, CAMERA)
    assert len(clients) == 1


def test_a_vehicles_name_brings_no_markup_into_the_page():
    server = open_server(port=0, title="R&D </title><b>")
    try:
        _, _, body = get(server)
    finally:
        server.stop()
    assert b"<title>R&amp;D &lt;/title&gt;&lt;b&gt;</title>" in body
