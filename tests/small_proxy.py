"""A proxy between browser and server, which passes on what it is told to."""

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

Change = Callable[[str, dict[str, str]], tuple[str, dict[str, str]] | None]
"""Gives the path and the headers that are passed on for those that came; None passes nothing on."""


@contextmanager
def proxy(port: int, change: Change, is_mute: bool = False) -> Iterator[int]:
    """Passes on every connection to a port of this machine; gives the port to ask instead.

    A mute one lets websockets be opened, and passes nothing on that comes through them.
    """
    with socket.create_server(("127.0.0.1", 0), backlog=50) as listening:
        threading.Thread(target=_listen, args=(listening, port, change, is_mute), daemon=True).start()
        yield listening.getsockname()[1]


def _listen(listening: socket.socket, port: int, change: Change, is_mute: bool) -> None:
    with suppress(OSError):
        while True:
            asking, _ = listening.accept()
            threading.Thread(target=_pass_on, args=(asking, port, change, is_mute), daemon=True).start()


def _pass_on(asking: socket.socket, port: int, change: Change, is_mute: bool) -> None:
    with asking, suppress(OSError, ValueError):
        request = b""
        while b"\r\n\r\n" not in request and (more := asking.recv(65536)):
            request += more
        head, _, rest = request.partition(b"\r\n\r\n")
        first, *lines = head.decode("latin-1").split("\r\n")
        method, path, version = first.split(" ")
        changed = change(path, dict(line.split(": ", 1) for line in lines))
        if changed is None:
            asking.recv(1)  # until the browser gives up
            return
        path, headers = changed
        lines = [f"{method} {path} {version}", *(f"{name}: {value}" for name, value in headers.items())]
        with socket.create_connection(("127.0.0.1", port)) as answering:
            answering.sendall("\r\n".join([*lines, "", ""]).encode("latin-1") + rest)
            if is_mute and "Upgrade" in headers:
                asking.sendall(_head(answering))
                while asking.recv(65536):  # until the browser gives up
                    pass
                return
            back = threading.Thread(target=_copy, args=(answering, asking), daemon=True)
            back.start()
            _copy(asking, answering)
            back.join()


def _head(answering: socket.socket) -> bytes:
    """What an answer begins with, up to the empty line."""
    head = b""
    while not head.endswith(b"\r\n\r\n") and (more := answering.recv(1)):
        head += more
    return head


def _copy(source: socket.socket, to: socket.socket) -> None:
    with suppress(OSError):
        while content := source.recv(65536):
            to.sendall(content)
    with suppress(OSError):
        to.shutdown(socket.SHUT_WR)
