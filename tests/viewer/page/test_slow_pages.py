"""Pages that read slowly or not at all, and what is left of pages that have gone."""

import gc
import os
import threading
import time
import weakref

import pytest
from visitors import CAMERA, encoded, visit, wait_until

from benchmarks.slow_page import slow_page
from modeviz.viewer.page.server import open_server
from modeviz.viewer.page.wire import slow_readers


@pytest.fixture
def server(monkeypatch):
    monkeypatch.setattr(slow_readers, "READS_WITHIN", 1.0)
    server = open_server(port=0)
    yield server
    server.stop()


def live(server):
    return [*server._websock_server._live_connections.values()]


@pytest.fixture
def talking(server):
    """Says much to all pages, ten times a second and of ever the same widget; grows as it does."""
    text, ended, said = server.gui.add_html(""), threading.Event(), []

    def talk():
        for n in range(10_000):
            if ended.wait(0.1):
                return
            text.content = os.urandom(500_000).hex()  # of which nothing is to be saved on the way
            said.append(n)

    thread = threading.Thread(target=talk)
    thread.start()
    yield said
    ended.set()
    thread.join()


def test_a_page_that_does_not_read_is_closed_and_others_are_told_as_ever(server, talking, capfd):
    with visit(server) as good, slow_page(server.get_port()):
        good.send(encoded(CAMERA))
        wait_until(lambda: len(live(server)) == 2)
        longest, begin = 0.0, time.monotonic()
        while len(live(server)) == 2:
            before = time.monotonic()
            good.recv(timeout=5)
            longest = max(longest, time.monotonic() - before)
            assert time.monotonic() - begin < 20
        assert longest < 0.9 * (time.monotonic() - begin)
    assert "127.0.0.1 reads too slowly" in capfd.readouterr().err


def test_a_page_that_reads_ten_bytes_a_second_is_closed(server, talking):
    with slow_page(server.get_port()) as page:
        wait_until(lambda: live(server))
        begin = time.monotonic()
        while live(server):
            page.recv(1)
            time.sleep(0.1)
            assert time.monotonic() - begin < 20


def test_a_page_on_a_slow_line_stays(server, monkeypatch, talking):
    """What it reads in a second is little, and more than the least."""
    monkeypatch.setattr(slow_readers, "SLOWEST", 4e3)  # a twentieth of what is read on an idle machine
    with slow_page(server.get_port()) as page:
        wait_until(lambda: live(server))
        end = time.monotonic() + 4
        while time.monotonic() < end:
            assert page.recv(8192)
            time.sleep(0.1)
        assert live(server)


def test_what_waits_for_a_page_that_does_not_read_does_not_grow(server, talking, monkeypatch):
    monkeypatch.setattr(slow_readers, "READS_WITHIN", 60.0)
    with slow_page(server.get_port()):
        wait_until(lambda: any(each.transport.get_write_buffer_size() for each in live(server)))
        buffer = server._websock_server._broadcast_buffer
        n_kept = len(buffer.message_from_id)
        waiting = [each.transport.get_write_buffer_size() for each in live(server)]
        n_said = len(talking)
        wait_until(lambda: len(talking) > n_said + 5)
        assert len(buffer.message_from_id) == n_kept
        assert [each.transport.get_write_buffer_size() for each in live(server)] == waiting


def test_nothing_is_left_of_pages_that_have_gone(server):
    gone = []
    for _ in range(10):
        with visit(server) as page:
            page.send(encoded(CAMERA))
            wait_until(lambda: server.get_clients())
            gone += [weakref.ref(each) for each in live(server)]
            gone += [weakref.ref(each) for each in server.get_clients().values()]
        wait_until(lambda: not server.get_clients())
    assert len(gone) == 20

    def n_left():
        gc.collect()
        return sum(each() is not None for each in gone)

    wait_until(lambda: n_left() <= 2, 5)  # of the last: a timer that was cancelled lies until it is due
