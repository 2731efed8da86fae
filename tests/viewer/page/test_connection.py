"""What one client can do to a server and to the pages of others, over real connections."""

import socket
import statistics
import threading
import time
from contextlib import ExitStack, contextmanager, suppress
from itertools import count

import pytest
from visitors import (
    CAMERA,
    PART_OF_FILE,
    PATIENCE_S,
    TOKEN,
    encoded,
    get,
    knock,
    own_origin,
    update,
    visit,
    wait_until,
)
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.frames import Frame, Opcode

from modeviz.viewer.page import front
from modeviz.viewer.page.doors import guesses
from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.wire import connection, house, pace
from modeviz.viewer.page.wire.connection import MOST_WRONG
from modeviz.viewer.page.wire.decoding import PART
from modeviz.viewer.page.wire.house import MOST_PAGES_OF_ONE
from modeviz.viewer.page.wire.pace import MOST_BYTES
from modeviz.viewer.page.wire.uploads import take_files_of


@contextmanager
def opened(**options):
    server = open_server(port=0, **options)
    try:
        yield server
    finally:
        server.stop()


@pytest.fixture
def server():
    with opened() as server:
        yield server


@pytest.fixture
def slider(server):
    return server.gui.add_slider("Rate", min=0.0, max=1000.0, step=1.0, initial_value=5.0)


@contextmanager
def page(server):
    """A websocket that has told its camera, of a page that viser knows by then."""
    before = len(server.get_clients())
    with visit(server) as socket:
        socket.send(encoded(CAMERA))
        wait_until(lambda: len(server.get_clients()) > before)
        yield socket


def reach(server):
    """A bare connection."""
    return socket.create_connection(("127.0.0.1", server.get_port()), timeout=5)


def closed(socket):
    """How a websocket is closed by the server: code and reason."""
    with suppress(ConnectionClosed):
        while True:
            socket.recv(timeout=20)
    return socket.close_code, socket.close_reason


def lines(capfd):
    return [line for line in capfd.readouterr().err.splitlines() if line]


def next_lines(capfd):
    """What is on the terminal as soon as something is: a page may know first that it is closed."""
    said = []
    wait_until(lambda: said or said.extend(lines(capfd)))
    return said


def test_a_message_of_megabytes_closes_the_page_before_it_is_read(server, capfd):
    message = b"\x81\xa4type\xdd\x01\x00\x00\x00" + b"\x80" * 20_000_000
    with page(server) as socket:
        begin = Frame(Opcode.BINARY, message).serialize(mask=True)[:1000]
        socket.socket.sendall(begin)  # the rest never comes
        assert closed(socket)[0] == 1009
    assert next_lines(capfd) == [
        "modeviz: 127.0.0.1 sent a message that is too large: its page is closed"
    ]


def test_a_message_that_is_there_to_exhaust_closes_its_page(server, capfd):
    with page(server) as socket:
        socket.send(b"\x81\xa1x" * 100_000 + b"\x80")
        assert closed(socket) == (1008, "This page sent a message that is too large or too deep.")
    assert len(next_lines(capfd)) == 1


def test_whatever_a_page_says_of_a_slider_is_one_line_on_the_terminal(server, slider, capfd):
    uuid = slider._impl.uuid
    with page(server) as socket:
        for wrong in (5, None, "x", [], {"value": {}}, {"value": [[1.0]]}, {"value": b"x"}):
            for _ in range(5):
                fields = {"type": "GuiUpdateMessage", "uuid": uuid, "updates": wrong}
                socket.send(encoded(fields))
        for wrong in ([], {}, None, 5):
            socket.send(encoded({"type": "GuiUpdateMessage", "uuid": wrong, "updates": {"value": 1.0}}))
        for wrong in (1e308, 10**18, "x" * 1000, [1.0], True, -1):
            socket.send(update(slider, wrong))
        socket.send(update(slider, 7))
        wait_until(lambda: slider.value == 7)
    server.stop()
    said = "127.0.0.1 sent messages that no page sends: they are left out"
    assert lines(capfd) == [f"modeviz: {said}", f"modeviz: {said}: 39 times in all"]


@pytest.mark.parametrize(
    "wrong", [{"image_height": 0}, {"wxyz": [0.5] * 500}, {"near": -1.0}, {"image_width": 30_000}]
)
def test_whatever_a_page_says_of_its_camera_is_one_line_on_the_terminal(server, capfd, wrong):
    with page(server) as socket:
        (client,) = server.get_clients().values()
        for _ in range(50):
            socket.send(encoded({**CAMERA, **wrong}))
        socket.send(encoded({**CAMERA, "image_width": 2 * CAMERA["image_height"]}))
        wait_until(lambda: client.camera.aspect == 2.0)
    assert len(lines(capfd)) == 1


def test_a_page_that_sends_nothing_but_nonsense_is_closed(server, capfd):
    with page(server) as socket:
        with suppress(ConnectionClosed):
            for _ in range(2 * MOST_WRONG):
                socket.send(b"\xc1")
        assert closed(socket)[0] == 1008
    assert len(lines(capfd)) == 2


def test_a_page_that_sends_megabytes_in_small_messages_is_closed(server, capfd, monkeypatch):
    """Each is answered before the next: whoever writes to a closed door may not hear why it is."""
    monkeypatch.setattr(pace, "BYTES_PER_S", 1.0)
    with page(server) as socket:
        with suppress(ConnectionClosed):
            for _ in range(int(MOST_BYTES // PART) + 2):
                socket.send(encoded(PART_OF_FILE))
                assert socket.ping(ack_on_close=True).wait(PATIENCE_S)
        assert closed(socket) == (1008, "This page sent more than 8 MB at once.")
    assert next_lines(capfd) == ["modeviz: 127.0.0.1 sent more than 8 MB at once: its page is closed"]


def test_a_page_may_send_a_file_that_is_taken_however_large(server, monkeypatch):
    monkeypatch.setattr(pace, "BYTES_PER_S", 1.0)
    button = server.gui.add_upload_button("file")
    size = int(2 * MOST_BYTES)
    take_files_of(button, size)
    parts = -(-size // PART)
    told = {"source_component_uuid": button._impl.uuid, "transfer_uuid": "a file"}
    begin = {"filename": "a.op2", "mime_type": "", "part_count": parts, "size_bytes": size}
    with page(server) as socket:
        socket.send(encoded({"type": "FileTransferStartUpload", **told, **begin}))
        for index in range(parts):
            content = bytes(min(PART, size - index * PART))
            part = {"part_index": index, "content": content}
            socket.send(encoded({"type": "FileTransferPart", **told, **part}))
            assert socket.ping(ack_on_close=True).wait(PATIENCE_S)
        wait_until(lambda: len(button.value.content) == size)


def test_a_page_that_hurries_on_and_on_is_closed(server, slider, monkeypatch):
    monkeypatch.setattr(pace, "LONGEST_HURRY", 0.5)
    with page(server) as socket:
        with suppress(ConnectionClosed):
            for i in range(2000):
                socket.send(update(slider, i % 900))
        assert "messages a second" in closed(socket)[1]


def test_a_page_that_says_nothing_is_closed(server, monkeypatch):
    monkeypatch.setattr(connection, "SILENT", 0.3)
    with visit(server) as silent, page(server) as other:
        assert "said nothing" in closed(silent)[1]
        other.ping().wait(5)
        assert other.close_code is None


@pytest.mark.parametrize("begin", [b"", b"GET / HTTP/1.1\r\nHost: x\r\n"])
def test_a_request_that_does_not_end_is_given_up(monkeypatch, begin):
    monkeypatch.setattr(front, "HANDSHAKE_S", 0.5)
    with opened() as server, reach(server) as slow:
        slow.sendall(begin)
        with suppress(ConnectionResetError):
            assert slow.recv(1) == b""


def test_pages_of_one_client_are_bounded_and_make_place_when_they_close(monkeypatch, capfd):
    monkeypatch.setattr(house, "OPENINGS_PER_S", 1000.0)
    with opened() as server, ExitStack() as pages:
        first = pages.enter_context(visit(server))
        for _ in range(MOST_PAGES_OF_ONE - 1):
            pages.enter_context(visit(server))
        for _ in range(5):
            with pytest.raises(InvalidStatus) as refusal, visit(server):
                pass
            assert refusal.value.response.status_code == 503
        assert get(server)[0] == 200  # it can say what is wrong
        first.close()
        wait_until(lambda: server._websock_server._live_connections.get(0) is None)
        pages.enter_context(visit(server))
    said = "modeviz: 127.0.0.1 opened more pages than it may: the last are refused"
    assert lines(capfd) == [said, f"{said}: 5 times in all"]


def test_connections_of_one_client_are_bounded(monkeypatch, capfd):
    monkeypatch.setattr(house, "MOST_OF_ONE", 5)
    with opened() as server, ExitStack() as silent:
        for _ in range(5):
            silent.enter_context(reach(server))
        for _ in range(3):
            with pytest.raises(ConnectionError):
                get(server)
        silent.close()
        wait_until(lambda: is_served(server))
    said = "modeviz: 127.0.0.1 opened more connections than it may: the last are refused"
    assert lines(capfd)[0] == said


def is_served(server):
    with suppress(ConnectionError):
        return get(server)[0] == 200
    return False


def test_what_goes_wrong_in_the_servers_loop_is_said_once(server, capfd):
    """As when there are no more files to open: asyncio tells each time it tries."""
    loop = server._event_loop
    for _ in range(100):
        context = {
            "message": "socket.accept() out of system resource",
            "exception": OSError(24, "no files"),
        }
        loop.call_soon_threadsafe(loop.call_exception_handler, context)
    loop.call_soon_threadsafe(loop.call_exception_handler, {"message": "something"})
    done = threading.Event()
    loop.call_soon_threadsafe(done.set)
    assert done.wait(5)
    assert lines(capfd) == [
        "modeviz: the server cannot take a connection: no files",
        "modeviz: the server has trouble: something",
    ]


def test_what_is_no_request_is_not_on_the_terminal(monkeypatch, capfd):
    monkeypatch.setattr(front, "HANDSHAKE_S", 0.5)
    with opened() as server:
        for nonsense in (b"\x16\x03\x01" + b"\0" * 200, b"GET nothing\r\n\r\n", b"\r\n" * 10):
            with reach(server) as scan:
                scan.sendall(nonsense)
                with suppress(OSError):
                    scan.recv(1000)
        assert get(server)[0] == 200
    out, err = capfd.readouterr()
    assert (out, err) == ("", "")


@pytest.mark.parametrize("path", ["//[", "/?a=%ff", "/%ff", "/\xff"])
def test_an_address_that_is_none_is_no_error_of_ours(server, path):
    with reach(server) as raw:
        host = f"127.0.0.1:{server.get_port()}"
        raw.sendall(f"GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n".encode("latin-1"))
        status = int(raw.recv(1000).split()[1])
    assert status in (200, 400, 404)


def test_a_page_of_another_version_is_refused_without_a_word(server, capfd):
    for _ in range(3):
        with pytest.raises(InvalidStatus) as refusal, knock(server, own_origin(server), version="0.2"):
            pass
        assert refusal.value.response.status_code == 400
    out, err = capfd.readouterr()
    assert (out, err) == ("", "")


def test_a_flood_of_one_page_does_not_hold_up_the_moves_of_another(server, slider):
    """It may say a hundred things a second, whatever it sends: counted by those, not by the clock."""
    heard, flooded = [], []
    other = server.gui.add_slider("Other", min=0.0, max=1000.0, step=1.0, initial_value=5.0)

    @slider.on_update
    def _(event):
        flooded.append(event)
        time.sleep(0.02)  # as somebody has to do something for each

    @other.on_update
    def _(event):
        heard.append(len(flooded))

    def flood(flooding):
        with suppress(ConnectionClosed):
            for i in count():
                flooding.send(update(slider, i % 900))

    with page(server) as quiet, page(server) as loud:
        flooding = threading.Thread(target=flood, args=(loud,))
        flooding.start()
        n_before = []
        for i in range(20):
            time.sleep(0.1)
            began = len(flooded)
            quiet.send(update(other, i))
            wait_until(lambda n=i: len(heard) > n)
            n_before.append(heard[-1] - began)
        loud.socket.shutdown(socket.SHUT_RDWR)
        flooding.join(30)
    assert len(flooded) > 20
    assert statistics.median(n_before) < 30
    assert max(n_before) < 200


def test_many_pages_at_ten_moves_a_second_lose_none(server):
    """Each has a slider of its own, so that each value is told."""
    n_pages, n_moves = 25, 20
    sliders = [
        server.gui.add_slider(f"Rate {i}", min=0.0, max=1000.0, step=1.0, initial_value=5.0)
        for i in range(n_pages)
    ]
    heard = []
    for slider in sliders:
        slider.on_update(lambda event: heard.append(event.target))

    with ExitStack() as stack:
        pages = [stack.enter_context(page(server)) for _ in range(n_pages)]
        for k in range(n_moves):
            for slider, each in zip(sliders, pages, strict=True):
                each.send(update(slider, 100 + k))
            time.sleep(0.1)
        wait_until(lambda: len(heard) == n_pages * n_moves)
    assert all(slider.value == 100 + n_moves - 1 for slider in sliders)


def test_a_callback_that_fails_is_on_the_terminal_once(server, slider, capfd):
    slider.on_update(lambda event: 1 / 0)
    with page(server) as socket:
        for i in range(10):
            socket.send(update(slider, i))
        wait_until(lambda: slider.value == 9)
    server.stop()
    text = capfd.readouterr().err
    assert text.count("Traceback") == 1
    assert "10 times in all" in text


def test_tokens_are_guessed_slowly_and_only_a_few_times(monkeypatch):
    monkeypatch.setattr(guesses, "DELAY", 0.1)
    with opened(token=TOKEN) as server:
        cookie = get(server, f"/?token={TOKEN}")[1]["Set-Cookie"].split(";")[0]
        answers = []

        def guess():
            for i in range(20):
                answers.append(get(server, f"/?token=guess-number-{i}")[0])

        guessers = [threading.Thread(target=guess) for _ in range(5)]
        for guesser in guessers:
            guesser.start()
        for guesser in guessers:
            guesser.join()
        assert answers.count(403) == guesses.MOST_GUESSES
        assert answers.count(429) == len(answers) - guesses.MOST_GUESSES
        assert get(server, f"/?token={TOKEN}")[0] == 429
        assert get(server, Cookie=cookie)[0] == 200  # who is in stays in
        with knock(server, own_origin(server), Cookie=cookie) as socket:
            assert socket.recv(timeout=20)


def test_old_cookies_lock_nobody_out():
    """A page of a server that is no longer there tries again and again."""
    with opened(token=TOKEN) as server:
        for _ in range(3 * guesses.MOST_GUESSES):
            with pytest.raises(InvalidStatus), knock(server, own_origin(server), Cookie="modeviz=old"):
                pass
        assert get(server, f"/?token={TOKEN}")[0] == 303


@pytest.mark.parametrize("token", ["é", "%ff", "%C3%A9", "\xff"])
def test_a_token_that_is_no_ascii_is_a_wrong_one(token):
    with opened(token=TOKEN) as server:
        port = server.get_port()
        for begin in (
            f"GET /?token={token} HTTP/1.1\r\n",
            f"GET / HTTP/1.1\r\nCookie: modeviz{port}={token}\r\n",
        ):
            with reach(server) as raw:
                raw.sendall(f"{begin}Host: 127.0.0.1:{port}\r\n\r\n".encode("latin-1"))
                assert int(raw.recv(1000).split()[1]) == 403
