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

LINK = re.compile(r"(\S+) is at (http://\S+)  \(Ctrl\+C ends\)\n")


@contextmanager
def served(folder, *options, token=""):
    """The link that is printed while the page is served."""
    command = [sys.executable, "-m", "modeviz", "view", folder, "--port", "0", *options]
    environment = {**os.environ, "MODEVIZ_TOKEN": token}
    with (
        usual_signals(),
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run,
    ):
        assert run.stdout
        match = LINK.fullmatch(run.stdout.readline())
        assert match
        try:
            yield match[2]
        finally:
            run.send_signal(signal.SIGINT)
            run.wait(30)


def status(link):
    url = urlsplit(link)
    connection = http.client.HTTPConnection(url.hostname or "", url.port, timeout=20)
    connection.request("GET", f"{url.path}?{url.query}")
    return connection.getresponse().status


def test_the_link_carries_a_new_token_and_opens_the_page(folder):
    with served(folder) as link:
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=[\w-]{40,}", link)
        assert status(link) == 303
        assert status(link.partition("?")[0]) == 403


def test_without_a_token_whoever_is_on_this_machine_gets_in(folder):
    with served(folder, "--no-token", token="found-outside-of-it") as link:
        assert re.fullmatch(r"http://127\.0\.0\.1:\d+/", link)
        assert status(link) == 200


def test_a_token_comes_from_the_environment_or_a_file(folder, tmp_path):
    file = tmp_path / "token"
    file.write_text("read-from-the-file\n", encoding="utf-8")
    with served(folder, token="found-outside-of-it") as link:
        assert link.endswith("/?token=found-outside-of-it")
    with served(folder, "--token-file", str(file), token="found-outside-of-it") as link:
        assert link.endswith("/?token=read-from-the-file")
        assert status(link) == 303


def test_the_link_of_a_server_for_others_names_an_address_of_this_machine(folder):
    with served(folder, "--host", "0.0.0.0") as link:
        assert urlsplit(link).hostname not in ("0.0.0.0", None)
        assert status(link) == 303


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--host", "0.0.0.0", "--no-token"], "a token is needed, so leave out --no-token"),
        (["--token", "sesame"], "--token: found 6 characters, expected 12 to 256"),
        (["--token", ""], "--token: expected letters"),
        (["--token-file", "no/such/file"], "--token-file no/such/file: No such file"),
        (["--public-name", "http://tool/"], "--public-name: found 'http://tool/'"),
    ],
)
def test_what_would_let_others_in_or_nobody_is_refused(folder, capsys, arguments, message):
    assert main(["view", folder, "--port", "0", *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert message in captured.err
    assert captured.err.count("\n") == 1
