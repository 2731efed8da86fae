"""A real Jupyter server with a real notebook, and its cells in a browser."""

import json
import os
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from pages import wait_for
from playwright.sync_api import Page

TESTS = Path(__file__).parents[1]
TOKEN = "a-token-of-jupyter"
PATIENCE_S = 60.0


class NotebookServer:
    """An open Jupyter server of a folder, which has jupyter-server-proxy."""

    def __init__(self, folder: Path, port: int) -> None:
        self.folder, self.port = folder, port

    def write(self, name: str, cells: Sequence[str], outputs: Sequence[dict] = ()) -> None:
        """Writes a notebook with cells; the first may have outputs."""
        kernel = {"name": "python3", "display_name": "Python 3"}
        content = {
            "nbformat": 4,
            "nbformat_minor": 5,
            "metadata": {"kernelspec": kernel},
            "cells": [
                {
                    "id": f"cell{number}",
                    "cell_type": "code",
                    "metadata": {},
                    "execution_count": None,
                    "outputs": [] if number else [*outputs],
                    "source": source,
                }
                for number, source in enumerate(cells)
            ],
        }
        (self.folder / f"{name}.ipynb").write_text(json.dumps(content), encoding="utf-8")

    def open(self, page: Page, name: str, host: str = "localhost") -> None:
        """Opens a notebook in a page, under a name of this machine, and waits for its kernel."""
        page.goto(f"http://{host}:{self.port}/notebooks/{name}.ipynb?token={TOKEN}")
        wait_for(page, "window.Jupyter?.notebook?.kernel?.is_connected()")

    def ask(self, method: str, path: str) -> list[dict]:
        """The answer of the server's own interface."""
        request = urllib.request.Request(
            f"http://127.0.0.1:{self.port}/api/{path}",
            method=method,
            headers={"Authorization": f"token {TOKEN}"},
        )
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return json.loads(answer.read() or b"[]")


def run(page: Page, cell: int) -> None:
    """Runs a cell of the notebook in a page."""
    page.evaluate("(cell) => Jupyter.notebook.execute_cells([cell])", cell)


def printed(page: Page, cell: int) -> str:
    """What a cell prints when it is run now, once it has run."""
    page.evaluate("(cell) => Jupyter.notebook.get_cell(cell).clear_output()", cell)
    run(page, cell)
    text = "Jupyter.notebook.get_cell(a.cell).element.find('.output_stdout').text()"
    return wait_for(page, text, cell=cell).strip()


def shown(page: Page, cell: int) -> str:
    """The text that a cell shows, without what is in frames."""
    return page.evaluate("(cell) => Jupyter.notebook.get_cell(cell).element[0].innerText", cell)


@contextmanager
def notebook_server(folder: Path) -> Iterator[NotebookServer]:
    """A Jupyter server of a folder that knows nothing of the user's settings."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    places = ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")
    own = {place: str(folder / ".jupyter" / place) for place in places}
    command = [sys.executable, "-m", "nbclassic", "--no-browser", "--allow-root"]
    options = {
        "port": port,
        "ip": "127.0.0.1",
        "root_dir": folder,
        "allow_remote_access": True,
    }
    log = folder / "jupyter.log"
    with log.open("w") as written:
        process = subprocess.Popen(
            [*command, *(f"--ServerApp.{name}={value}" for name, value in options.items())],
            env={**os.environ, **own, "PYTHONPATH": str(TESTS), "JUPYTER_TOKEN": TOKEN},
            stdout=written,
            stderr=subprocess.STDOUT,
        )
    try:
        server = NotebookServer(folder, port)
        _wait_until_open(server, log)
        yield server
    finally:
        process.terminate()
        process.wait(PATIENCE_S)


def _wait_until_open(server: NotebookServer, log: Path) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while True:
        try:
            server.ask("GET", "status")
        except (urllib.error.URLError, ConnectionError):
            assert time.monotonic() < deadline, log.read_text("utf-8")
            time.sleep(0.1)
        else:
            return
