"""Who gets in, tried by a browser: pages of other sites, old cookies, and pages behind a real nginx."""

import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from nginx import NAME, certificate, documented, free_port, nginx
from pages import NOTICE, said_in_time, wait_for, wait_until
from visitors import TOKEN

from modeviz.viewer.page.doors.door import SUBPROTOCOL
from modeviz.viewer.page.doors.kept_tokens import KeptToken
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import surroundings
from modeviz.viewer.page.server import open_server

DOCS = Path(__file__).parents[2] / "docs" / "serving.md"
LIVE = "document.body.innerText.includes('live')"

BLOCKED = """
server {{
    listen 127.0.0.1:{port};
    location / {{
        proxy_pass http://127.0.0.1:{to};
        proxy_http_version 1.1;
        proxy_set_header Host $http_host;
    }}
}}
"""
"""A proxy that does not pass websockets on."""

ATTACK = """async ({ page, socket, subprotocol }) => {
  const said = {};
  const fails = (promise) => promise.then(() => "done", () => "refused");
  const text = (how) => fetch(page, { credentials: "include", ...how }).then((answer) => answer.text());
  said.read = await text({}).catch(() => "refused");
  said.opaque = await text({ mode: "no-cors" }).catch(() => "refused");
  said.socket = await fails(new Promise((opened, failed) => {
    const websocket = new WebSocket(socket, subprotocol);
    websocket.onopen = opened;
    websocket.onerror = failed;
  }));
  const loaded = (tag, source) => new Promise((done) => {
    const element = document.createElement(tag);
    element.onload = element.onerror = () => done(element);
    element.src = source;
    document.body.append(element);
  });
  const frame = await loaded("iframe", page);
  try {
    said.frame = frame.contentDocument ? "read" : "refused";
  } catch {
    said.frame = "refused";
  }
  said.frames = frame.contentWindow.length;
  await loaded("script", page);
  const other = window.open(page);
  await new Promise((done) => setTimeout(done, 1000));
  try {
    said.window = other.document.title;
  } catch {
    said.window = "refused";
  }
  return said;
}"""
"""What a page of another origin can try, with the browser's cookies; "refused" or nothing is right."""


FRAME = """(source) => {
  const frame = document.createElement("iframe");
  frame.src = source;
  document.body.append(frame);
}"""
"""Shows an address in a frame."""


def live_server(**options):
    """A server whose pages say that they are live."""
    server = open_server(**{"port": 0, "token": TOKEN, **options})
    server.scene.configure_environment_map(None)
    server.gui.add_markdown("live")
    return server


@pytest.fixture
def elsewhere():
    """A web server of somebody else: the port of its empty page."""

    class Empty(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(b"<!doctype html><title>elsewhere</title><body></body>")

        def log_message(self, format: str, *arguments: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Empty)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield server.server_port
    server.shutdown()


def test_a_page_of_another_origin_neither_reads_the_scene_nor_moves_a_slider(show, elsewhere):
    """Of another port of this machine too, to which browsers send the same cookies as to ours."""
    server = live_server()
    try:
        page = show(server.local_link)
        wait_for(page, LIVE)
        n_inside = len(server.get_clients())
        target = f"127.0.0.1:{server.get_port()}"
        asked = {"page": f"http://{target}/", "socket": f"ws://{target}/", "subprotocol": SUBPROTOCOL}
        for host in ("127.0.0.1", "localhost"):
            other = page.context.new_page()
            other.goto(f"http://{host}:{elsewhere}/")
            said = other.evaluate(ATTACK, asked)
            assert said.pop("frames") == 0
            assert set(said.values()) == {"refused"}, said
            for opened in page.context.pages[1:]:
                opened.close()
        wait_until(page, lambda: len(server.get_clients()) == n_inside)
        own = page.context.new_page()  # what is tried is right, and ours may do it
        own.goto(f"http://{target}/")
        said = own.evaluate(ATTACK, asked)
        assert said["socket"] == "done"
        assert "<title>modeviz</title>" in said["read"]
        assert said["window"] == "modeviz"
    finally:
        server.stop()


def test_pages_of_an_allowed_origin_show_it_in_a_frame_and_no_others_do(show, elsewhere):
    """At another name of this machine, which is another site to browsers."""
    around = surroundings(frames=(f"http://localhost:{elsewhere}",))
    server = live_server(around=around)
    try:
        page = show(f"http://localhost:{elsewhere}/")
        page.evaluate(FRAME, server.local_link)
        wait_until(page, lambda: server.get_clients())
        (frame,) = page.frames[1:]
        wait_until(page, lambda: frame.evaluate(LIVE))
        assert page.evaluate("frames.length") == 1
        page.goto(f"http://127.0.0.1:{elsewhere}/")
        wait_until(page, lambda: not server.get_clients())
        page.evaluate(FRAME, server.local_link)
        wait_until(page, lambda: page.frames[1].url.startswith("chrome-error:"))
        assert not server.get_clients()
    finally:
        server.stop()


def test_an_open_page_comes_back_after_a_restart_and_is_thrown_out_when_the_token_is_revoked(
    show, tmp_path
):
    kept = KeptToken(tmp_path / "token", ())
    server = live_server(token=Secret(kept.token))
    port = server.get_port()
    page = show(server.local_link)
    wait_for(page, LIVE)
    (cookie,) = page.context.cookies()
    assert cookie["expires"] > time.time() + 29 * 86400  # so it outlives the browser
    assert cookie["httpOnly"]
    server.stop()
    assert "modeviz was stopped" in wait_for(page, NOTICE)
    server = live_server(token=Secret(kept.token), port=port)
    try:
        page.bring_to_front()
        wait_for(page, f"!{NOTICE} && {LIVE}")
        kept.replace()
        assert "open the whole link" in wait_for(page, NOTICE)
        page.goto(server.local_link)
        wait_for(page, f"!{NOTICE} && {LIVE}")
    finally:
        server.stop()


def test_a_page_behind_nginx_is_live_by_tls_and_says_in_time_that_websockets_are_blocked(
    show, tmp_path
):
    server = live_server(around=surroundings((NAME,), (), ("127.0.0.1",), "/bench"))
    secure, blocked = free_port(), free_port()
    made, key = certificate(tmp_path)
    example = documented(DOCS.read_text(), secure, server.get_port(), made, key)
    servers = example + BLOCKED.format(port=blocked, to=server.get_port())
    try:
        with nginx(tmp_path, servers, [secure, blocked]):
            page = show(f"https://127.0.0.1:{secure}/bench?token={TOKEN}")
            for _ in range(2):
                wait_for(page, LIVE)
                assert page.url == f"https://127.0.0.1:{secure}/bench/"
                page.reload()
            assert page.context.cookies()[0]["secure"]
            page = show(f"http://127.0.0.1:{blocked}/?token={TOKEN}")
            assert "a WebSocket, does not get through: a proxy or firewall" in said_in_time(page)
    finally:
        server.stop()
