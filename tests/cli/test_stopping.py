"""A server that is told to stop: pages are told, it ends soon and well, and has logged it."""

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
from usual_signals import usual_signals
from visitors import wait_until
from websockets.exceptions import ConnectionClosed

from benchmarks.page_client import session_query
from benchmarks.websocket import open_websocket
from modeviz.cli import interrupt, main
from modeviz.cli.logs import LogOptions, logged
from modeviz.compute.stop import Stop
from modeviz.viewer.page.server import STOPPED
from modeviz.viewer.serving import serve as serving

SOON = 30


@contextmanager
def viewing(folder, *options, before=""):
    """`modeviz view` in a program of its own, and the port it serves at."""
    code = f"{before}\nimport sys\nfrom modeviz.cli import main\nsys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, "view", folder, "--port", "0", "--no-study", *options]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with (
        usual_signals(),
        subprocess.Popen(command, env={**os.environ, "MODEVIZ_TOKEN": ""}, **pipes) as run,
    ):
        try:
            said = re.search(r"http://127\.0\.0\.1:(\d+)/(\S*)", run.stdout.readline())
            yield run, int(said[1]), said[2]
        finally:
            run.kill()


def told_why(port, run, ending):
    """What a page is told when the server is sent a signal."""
    with open_websocket(port, session_query(port)) as page:
        page.recv(timeout=SOON)
        run.send_signal(ending)
        try:
            while True:
                page.recv(timeout=SOON)
        except ConnectionClosed as closed:
            return closed.rcvd


def test_a_signal_tells_pages_and_ends_the_server_soon_and_well(folder, tmp_path):
    log = tmp_path / "log"
    with viewing(folder, "--no-token", "--log", str(log), "--log-format", "json") as (run, port, _):
        told = told_why(port, run, signal.SIGHUP)
        assert (told.code, told.reason) == (1001, STOPPED)
        begin = time.monotonic()
        assert run.wait(SOON) == 0
        assert time.monotonic() - begin < 5
        said = run.stderr.read()
        assert "modeviz: stopping; SIGHUP again ends it at once" in said
        assert "Traceback" not in said
    events = [json.loads(line)["event"] for line in log.read_text().splitlines()]
    assert events[0] == "started"
    assert events[-1] == "stopped"


HANGS = """
import modeviz.analysis.preparation, time
def prepare(*given, **named):
    time.sleep(60)
modeviz.analysis.preparation.prepare = prepare
"""


def test_a_server_that_still_prepares_stops_as_soon(folder):
    with viewing(folder, "--no-token", before=HANGS) as (run, _, _):
        run.send_signal(signal.SIGTERM)
        begin = time.monotonic()
        assert run.wait(SOON) == 0
        assert time.monotonic() - begin < 5


@pytest.fixture
def exits(monkeypatch):
    """The statuses with which the program would have been ended."""
    statuses = []
    monkeypatch.setattr(interrupt.os, "_exit", statuses.append)
    with usual_signals():
        yield statuses


@pytest.mark.parametrize("ending", interrupt.ENDINGS)
def test_every_signal_stops_and_a_second_one_ends_at_once(exits, ending, capsys):
    with interrupt.stopped_by_signal() as stop:
        signal.raise_signal(ending)
        stop.wait()
        assert exits == []
        assert "again ends it at once" in capsys.readouterr().err
        signal.raise_signal(signal.SIGTERM)
        assert exits == [128 + signal.SIGTERM]


def test_what_does_not_come_to_its_end_is_ended(exits, monkeypatch):
    monkeypatch.setattr(interrupt, "STOPS_WITHIN", 0.05)
    with interrupt.stopped_by_signal():
        signal.raise_signal(signal.SIGTERM)
        wait_until(lambda: exits == [128 + signal.SIGTERM])


def test_an_ignored_signal_stays_ignored(exits):
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with interrupt.stopped_by_signal() as stop:
        signal.raise_signal(signal.SIGHUP)
        assert not stop.is_told


def test_what_fails_beside_is_raised_and_ends_the_wait():
    def fail():
        raise IndexError("a bug")

    with pytest.raises(IndexError, match="a bug"):
        Stop().wait(fail)


def test_a_log_that_cannot_be_written_is_refused(folder, capsys, tmp_path):
    assert main(["view", folder, "--log", str(tmp_path / "none" / "log")]) == 2
    assert "--log" in capsys.readouterr().err


def test_what_nobody_caught_in_a_thread_is_logged_under_a_number(tmp_path, capsys):
    def fail():
        raise IndexError("a bug")

    log = tmp_path / "log"
    with logged(LogOptions(log=log, log_format="json")):
        thread = threading.Thread(target=fail)
        thread.start()
        thread.join()
    mistake, stopped = map(json.loads, log.read_text().splitlines())
    assert mistake["event"] == "mistake"
    assert "IndexError: a bug" in mistake["message"]
    assert stopped["event"] == "stopped"
    assert f"modeviz: mistake {mistake['id']}" in capsys.readouterr().err


def test_serve_reads_every_folder_and_makes_none_ready(folder, monkeypatch, capsys):
    asked = []
    monkeypatch.setattr(serving, "serve", lambda benches, *_, **named: asked.append((benches, named)))
    assert main(["serve", folder, "--no-token", "--no-study", "--port", "0"]) == 0
    ((benches, named),) = asked
    assert named["is_lazy"]
    (name,) = benches
    assert name == Path(folder).name
    assert not benches[name].is_prepared
    assert main(["serve", folder, folder, "--no-token", "--no-study"]) == 2
    assert "is there twice" in capsys.readouterr().err
