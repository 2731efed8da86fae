"""Pictures that are asked of pages: nobody waits for one that does not draw, and none is too large."""

import struct
import threading
import time
import zlib
from contextlib import ExitStack, contextmanager
from types import SimpleNamespace

import numpy as np
import pytest
from guests import all_is_heard, heard_until
from visitors import CAMERA, encoded, update, visit, wait_until

from benchmarks.page_client import messages as decoded
from modeviz.errors import ModevizError
from modeviz.viewer.page.server import open_server
from modeviz.viewer.panels import pictures as panel
from modeviz.viewer.panels.pictures import PicturePanel
from modeviz.viewer.pictures.headless import MOST_PIXELS, _bounded, _launched
from modeviz.viewer.pictures.pictures import ImageSettings, Pose, picture
from modeviz.viewer.scene.stage import LIGHT
from modeviz.viewer.tasks.page_jobs import CancelledError, run, turn

POSE = Pose(np.array([1.0, 0, 0, 0]), np.zeros(3))


@pytest.fixture
def server():
    server = open_server(port=0)
    yield server
    server.stop()


@contextmanager
def page(server):
    """A page that viser knows, and its number there."""
    before = set(server.get_clients())
    with visit(server) as socket:
        socket.send(encoded(CAMERA))
        wait_until(lambda: set(server.get_clients()) - before)
        yield socket, *(set(server.get_clients()) - before)


def pressed(server):
    """The panel with its button, and how a page presses that."""
    shown = PicturePanel(
        server.gui,
        server,
        LIGHT,
        subject=lambda: "cabin",
        is_real=lambda: True,
        scale=lambda: None,
        offline=lambda *_: b"html",
        report=lambda png: b"report",
    )
    handles = server.gui._gui_input_handle_from_uuid.values()
    button = next(handle for handle in handles if getattr(handle, "label", "") == "Save…")
    return shown, update(button, True)


def until_asked(socket):
    """Waits until a page is asked for a picture."""
    heard_until(socket, lambda told: any(m["type"] == "GetRenderRequestMessage" for m in told))


def n_asked(socket, seconds=0.5):
    """How many pictures a page is asked for within some time."""
    end, n = time.monotonic() + seconds, 0
    while (left := end - time.monotonic()) > 0:
        try:
            messages = decoded(socket.recv(timeout=left))
        except TimeoutError:
            break
        n += sum(message["type"] == "GetRenderRequestMessage" for message in messages)
    return n


def drawn(width, height, red=0, color_type=6):
    """A PNG file: as a page sends it, or of another kind."""

    def chunk(kind, content):
        return (
            struct.pack(">I", len(content))
            + kind
            + content
            + struct.pack(">I", zlib.crc32(kind + content))
        )

    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    pixel = {0: b"\x80", 2: b"\x80" * 3, 6: bytes([red, 0, 0, 255])}[color_type]
    rows = (b"\0" + pixel * width) * height
    content = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + content


def answer(socket, payload):
    """Answers what a page is asked for next."""
    while True:
        for message in decoded(socket.recv(timeout=20)):
            if message["type"] == "GetRenderRequestMessage":
                fields = {"payload": payload, "render_uuid": message["render_uuid"]}
                socket.send(encoded({"type": "GetRenderResponseMessage", **fields}))
                return


def test_pages_that_ask_and_do_not_draw_hold_up_no_slider(server):
    slider = server.gui.add_slider("Rate", min=0.0, max=1000.0, step=1.0, initial_value=5.0)
    heard = threading.Event()
    slider.on_update(lambda event: heard.set())
    _, press = pressed(server)
    with ExitStack() as stack:
        for _ in range(34):
            socket, _ = stack.enter_context(page(server))
            socket.send(press)
        socket, _ = stack.enter_context(page(server))
        for value in (10, 20, 30):
            heard.clear()
            socket.send(update(slider, value))
            assert heard.wait(20)  # a page may draw three times as long


def test_a_page_is_asked_for_one_picture_at_a_time_however_often_it_asks(server):
    _, press = pressed(server)
    with page(server) as (socket, _):
        for _ in range(20):
            socket.send(press)
        until_asked(socket)
        all_is_heard(server, socket)
        assert n_asked(socket) == 0


def test_few_pages_are_asked_at_once_and_the_next_when_one_has_answered(server, monkeypatch):
    monkeypatch.setattr(panel, "N_JOBS", 1)
    shown, press = pressed(server)
    shown._width.value, shown._height.value = 16, 16
    with page(server) as (first, _), page(server) as (second, _):
        first.send(press)
        until_asked(first)
        second.send(press)
        all_is_heard(server, second)
        assert n_asked(second) == 0
        first.close()
        until_asked(second)


@pytest.fixture
def shot():
    return ImageSettings(40, 30, "transparent", LIGHT, 0.5)


def test_a_picture_is_taken_as_the_page_draws_it(server, shot):
    with page(server) as (socket, number):
        client = server.get_clients()[number]
        threading.Thread(target=answer, args=(socket, drawn(40, 30, 200))).start()
        image = picture(client, shot, POSE, 20.0)
    assert image.size == (40, 30)
    assert image.getpixel((0, 0)) == (200, 0, 0, 255)


def test_a_picture_of_another_size_is_refused(server, shot):
    with page(server) as (socket, number):
        client = server.get_clients()[number]
        threading.Thread(target=answer, args=(socket, drawn(400, 300))).start()
        with pytest.raises(ModevizError, match="otherwise than asked"):
            picture(client, shot, POSE, 20.0)


@pytest.mark.parametrize("color_type", [0, 2], ids=["grey", "opaque"])
def test_a_picture_of_another_kind_is_refused(server, shot, color_type):
    with page(server) as (socket, number):
        client = server.get_clients()[number]
        payload = drawn(40, 30, color_type=color_type)
        threading.Thread(target=answer, args=(socket, payload)).start()
        with pytest.raises(ModevizError, match="the page"):
            picture(client, shot, POSE, 20.0)


def test_a_page_may_send_what_is_as_large_as_a_picture_only_while_it_is_asked(server, monkeypatch):
    large = ImageSettings(1000, 1000, "transparent", LIGHT, 0.5)
    noise = np.random.default_rng(1).integers(0, 256, 2_000_000, np.uint8).tobytes()
    payload = drawn(1000, 1000)[:-12] + struct.pack(">I", len(noise)) + b"tEXt" + noise
    with page(server) as (_, number):
        client = server.get_clients()[number]
        connection = server._websock_server._live_connections[number]
        limits = []

        def get_render(*_, **__):
            limits.append(connection.protocol.max_message_size)
            return np.ones((1000, 1000, 4), np.uint8)

        monkeypatch.setattr(client, "get_render", get_render)
        before = connection.protocol.max_message_size
        picture(client, large, POSE)
        assert limits[0] >= len(payload)
        assert connection.protocol.max_message_size == before < len(payload)


def noted(run_one):
    """What becomes of a job: what it told its page, and what was reported."""
    told = []
    client = SimpleNamespace(gui=Gui(), add_notification=lambda *said, **_: told.append(said))
    reported = []
    run_one(client, reported.append)
    return told, reported


class Gui:
    """What a page's job shows, none of it seen."""

    def __getattr__(self, _):
        return lambda *_, **__: self

    def on_click(self, press):
        return press

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass


def test_work_for_a_page_that_has_left_ends_and_says_nothing():
    there, ended = threading.Event(), []

    def work(tell):
        try:
            for _ in range(100):
                tell(0.0)
                there.set()
        except CancelledError:
            ended.append(True)
            raise

    told, reported = noted(
        lambda client, report: run(client, "Whole page", work, lambda: not there.is_set(), report)
    )
    assert ended
    assert not told
    assert not reported


def test_our_mistakes_in_such_work_are_reported_to_who_counts_them():
    told, reported = noted(
        lambda client, report: run(client, "x", lambda _: 1 / 0, lambda: True, report)
    )
    assert [type(error) for error in reported] == [ZeroDivisionError]
    assert len(told) == 1


def test_who_waits_for_a_turn_can_cancel():
    places = threading.Semaphore(1)

    def tell(_):
        raise CancelledError

    with turn(places, lambda _: None), pytest.raises(CancelledError), turn(places, tell):
        raise AssertionError
    with turn(places, lambda _: None):
        pass


@pytest.mark.parametrize("size", [(30_000, 20_000), (16_384, 16_384), (16_384, 1), (7680, 4320)])
def test_a_window_for_a_page_is_no_larger_than_a_browser_can_draw(size):
    width, height = _bounded(*size)
    assert width * height <= MOST_PIXELS
    if min(size) > 1:
        assert width / height == pytest.approx(size[0] / size[1], rel=1e-2)
    assert _bounded(1280, 720) == (1280, 720)


def test_the_browser_has_its_sandbox_where_it_can(monkeypatch):
    from playwright.sync_api import Error

    class Kind:
        def __init__(self, can):
            self.can, self.tried = can, []

        def launch(self, chromium_sandbox, **_):
            self.tried.append(chromium_sandbox)
            if chromium_sandbox and not self.can:
                raise Error("No usable sandbox!")
            return "browser"

    for can, tried in ((True, [True]), (False, [True, False])):
        kind = Kind(can)
        assert _launched(kind, "chromium") == "browser"
        assert kind.tried == tried


def test_a_picture_not_drawn_in_time_frees_its_place(server, monkeypatch):
    monkeypatch.setattr(picture, "__defaults__", (0.3,))
    _, press = pressed(server)
    with page(server) as (socket, _):
        socket.send(press)
        until_asked(socket)
        heard_until(socket, lambda told: "did not draw it within" in str(told))
        socket.send(press)
        until_asked(socket)
