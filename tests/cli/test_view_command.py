"""The command that serves the page: its link, and the token that the link has."""

import http.client
import os
import re
import signal
import subprocess
import sys
from contextlib import contextmanager
from urllib.parse import urlsplit

import pytest
from usual_signals import usual_signals

from modeviz.cli import main
from modeviz.viewer.page.server import open_server

LINK = re.compile(r"(\S+) is at (http://\S+)  \(Ctrl\+C ends\)\n")


def status(link):
    url = urlsplit(link)
    connection = http.client.HTTPConnection(url.hostname or "", url.port, timeout=20)
    connection.request("GET", f"{url.path}?{url.query}")
    return connection.getresponse().status


@contextmanager
def viewed(folder, port=0):
    """What `modeviz view` is at, as it prints that, and the program."""
    command = [sys.executable, "-m", "modeviz", "view", folder, "--port", str(port)]
    environment = {**os.environ, "MODEVIZ_TOKEN": ""}
    with (
        usual_signals(),
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run,
    ):
        assert run.stdout
        match = LINK.fullmatch(run.stdout.readline())
        assert match
        try:
            yield match[2], run
        finally:
            run.send_signal(signal.SIGINT)
            run.wait(30)


def test_the_link_carries_a_token_that_is_kept_until_it_is_revoked(folder, capsys):
    """In two programs one after the other, which takes a second each."""
    with viewed(folder) as (link, _):
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{40,}", link)
        assert status(link) == 303
        assert status(link.partition("?")[0]) == 403
    with viewed(folder) as (again, run):
        token = again.partition("=")[2]
        assert link.partition("=")[2] == token
        assert main(["token", folder]) == 0
        assert re.fullmatch(rf"{token}  (29|30) days  {folder}\n", capsys.readouterr().out)
        assert main(["token", folder, "--revoke"]) == 0
        revoked = capsys.readouterr().out.split()[0]
        assert status(again) == 403
        assert status(again.replace(token, revoked)) == 303
        assert run.stdout.readline().endswith(f" is now at {again.replace(token, revoked)}\n")


def test_a_token_of_what_was_never_shown_is_none(capsys, tmp_path):
    assert main(["token", str(tmp_path)]) == 2
    assert "no token is kept of that" in capsys.readouterr().err


@pytest.fixture
def link(monkeypatch, folder):
    """The link of the server that a command opens, on which no page is built."""
    servers = []

    def serve(benches, host, port, token, *_):
        servers.append(open_server(host, port, token))

    def link(*options, token=""):
        monkeypatch.setenv("MODEVIZ_TOKEN", token)
        assert main(["view", folder, "--port", "0", *options]) == 0
        return servers[-1].link

    monkeypatch.setattr("modeviz.viewer.serving.serve.serve", serve)
    yield link
    for server in servers:
        server.stop()


def test_without_a_token_whoever_is_on_this_machine_gets_in(link):
    own = link("--no-token", token="found-outside-of-it")
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/", own)
    assert status(own) == 200


def test_a_token_comes_from_the_environment_or_a_file(link, tmp_path):
    file = tmp_path / "token"
    file.write_text("read-from-the-file\n", encoding="utf-8")
    assert link(token="found-outside-of-it").endswith("/?token=found-outside-of-it")
    own = link("--token-file", str(file), token="found-outside-of-it")
    assert own.endswith("/?token=read-from-the-file")
    assert status(own) == 303


def test_the_link_of_a_server_for_others_names_an_address_of_this_machine(link):
    own = link("--host", "0.0.0.0")
    assert urlsplit(own).hostname not in ("0.0.0.0", None)
    assert status(own) == 303


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--host", "0.0.0.0", "--no-token"], "a token is needed, so leave out --no-token"),
        (["--token", "sesame"], "--token: found 6 characters, expected 12 to 256"),
        (["--token", ""], "--token: expected letters"),
        (["--token-file", "no/such/file"], "--token-file no/such/file: No such file"),
        (["--public-name", "http://tool/"], "--public-name: found 'http://tool/'"),
        (["--state", "http://tool/?view=x"], "state link: found 'x', which is cut off or altered"),
    ],
)
def test_what_lets_others_in_or_nobody_or_is_no_view_is_refused(folder, capsys, arguments, message):
    assert main(["view", folder, "--port", "0", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert message in captured.err
    assert captured.err.count("\n") == 1
