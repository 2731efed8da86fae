"""A real nginx before a server, with a certificate of its own making."""

import os
import re
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

NAME = "tool.example.com"

FRAME = """{user}
daemon off;
worker_processes 1;
pid {folder}/nginx.pid;
events {{ worker_connections 256; }}
http {{
    access_log off;
    client_body_temp_path {folder}/body;
    proxy_temp_path {folder}/proxy;
    fastcgi_temp_path {folder}/fastcgi;
    uwsgi_temp_path {folder}/uwsgi;
    scgi_temp_path {folder}/scgi;
    {servers}
}}
"""


@contextmanager
def nginx(folder: Path, servers: str, ports: list[int]) -> Iterator[None]:
    """Runs as long as it lasts; waits until it listens."""
    beside = [str(Path("/usr", place)) for place in ("sbin", "local/sbin")]
    program = shutil.which("nginx", path=os.pathsep.join([os.environ["PATH"], *beside]))
    assert program, "the tests need nginx: install the package nginx-light"
    user = "user root;" if os.geteuid() == 0 else ""  # else it reads no folder of root's
    config = folder / "nginx.conf"
    config.write_text(FRAME.format(user=user, folder=folder, servers=servers))
    command = [program, "-e", "stderr", "-p", folder, "-c", config]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as running:
        assert running.stderr
        try:
            for port in ports:
                _wait_for(port, running)
            yield
        finally:
            running.terminate()


def certificate(folder: Path) -> tuple[Path, Path]:
    """A self-made certificate of `NAME` and this machine, and its key."""
    made, key = folder / "made.pem", folder / "made.key"
    names = f"subjectAltName=DNS:{NAME},DNS:localhost,IP:127.0.0.1"
    kind = [
        "-x509",
        "-newkey",
        "ec",
        "-pkeyopt",
        "ec_paramgen_curve:prime256v1",
        "-nodes",
        "-days",
        "2",
    ]
    about = ["-subj", f"/CN={NAME}", "-addext", names]
    command = ["openssl", "req", *kind, *about, "-out", str(made), "-keyout", str(key)]
    subprocess.run(command, check=True, capture_output=True)
    return made, key


def documented(docs: str, port: int, to: int, made: Path, key: Path) -> str:
    """The example in the documentation, at other ports and with another certificate."""
    example = re.search(r"```nginx\n(.*?)```", docs, re.DOTALL)
    assert example
    changes = {
        "listen 443": f"listen 127.0.0.1:{port}",
        "127.0.0.1:8080": f"127.0.0.1:{to}",
        "/etc/ssl/tool.example.com.pem": str(made),
        "/etc/ssl/tool.example.com.key": str(key),
    }
    text = example[1]
    for before, after in changes.items():
        assert text.count(before) == 1
        text = text.replace(before, after)
    return text


def free_port() -> int:
    """One that nobody listens on."""
    with socket.create_server(("127.0.0.1", 0)) as found:
        return found.getsockname()[1]


def _wait_for(port: int, running: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 20.0
    while True:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1.0).close()
            return
        except OSError:
            assert running.poll() is None, running.stderr and running.stderr.read()
            assert time.monotonic() < deadline
            time.sleep(0.02)
