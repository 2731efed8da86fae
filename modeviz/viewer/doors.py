"""Who gets in: viser's server behind our handshake and our gate, silent on the terminal.

Its web server is built inside `ViserServer.__init__`, so the handshake is put in while that runs.
tests/browser/test_doors.py fails when viser changes.
"""

import errno
import io
import re
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout

import viser
import websockets.asyncio.server
from viser import _messages

from modeviz.errors import ModevizError
from modeviz.viewer.gate import gate_messages
from modeviz.viewer.handshake import LOOPBACK, Door, ProcessRequest

_one_server_at_a_time = threading.Lock()


class Server(viser.ViserServer):
    """viser's server behind a door, silent on the terminal."""

    def __init__(self, host: str, port: int, token: str | None, title: str) -> None:
        door = Door(host, token, title)
        with _handshake_guarded_by(door), redirect_stdout(io.StringIO()):
            super().__init__(host=host, port=port, label=title, verbose=False)
        if not door.is_hung:
            self.stop()
            raise RuntimeError("viser no longer starts through websockets.asyncio.server.serve")
        for request in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self._websock_server.unregister_handler(request)
        gate_messages(self)
        self._door = door
        door.is_open = True

    @property
    def link(self) -> str:
        """What opens the page in a browser of this machine, with its token; ready for `&name=value`."""
        host = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(self._door.host, self._door.host)
        bracketed = f"[{host}]" if ":" in host else host
        token = self._door.token or ""
        return f"http://{bracketed}:{self.get_port()}/?token={token}"

    def request_share_url(self, verbose: bool = True) -> str | None:
        """Never opens viser's public tunnel."""
        return None

    def stop(self) -> None:
        with redirect_stdout(io.StringIO()):
            super().stop()


def open_server(
    host: str = "127.0.0.1", port: int = 8080, token: str | None = None, title: str = "modeviz"
) -> Server:
    """A viser server that only the user of this machine, or who has the token, can reach.

    Args:
        host: the address to listen on.
        port: to listen on; 0 takes a free one.
        token: what a link must carry, `?token=…`; needed beyond this machine.
        title: of the page.

    Raises:
        ModevizError: the port is none or in use, the address is not this machine's, or the token is
            missing.
    """
    if host not in LOOPBACK and not token:
        raise ModevizError(f"other machines reach {host}: a token is needed, give one with --token")
    if token and not re.fullmatch(r"[\w.~-]+", token, re.ASCII):
        raise ModevizError("token: expected letters, digits, '-', '.', '_' and '~' only")
    if not 0 <= port <= 65535:
        raise ModevizError(f"port: found {port}, expected 0 to 65535")
    _check_free(host, port)
    server = Server(host, port, token, title)
    if port and server.get_port() != port:
        server.stop()
        raise ModevizError(_in_use(host, port))
    return server


def _check_free(host: str, port: int) -> None:
    """Raises ModevizError if nothing can listen there; viser would silently take the next port."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            raise ModevizError(_in_use(host, port)) from None
        raise ModevizError(f"cannot listen on port {port} of {host}: {error.strerror}") from None


def _in_use(host: str, port: int) -> str:
    return f"port {port} of {host} is in use: choose another with --port"


@contextmanager
def _handshake_guarded_by(door: Door) -> Iterator[None]:
    """While this lasts, a server that viser starts asks `door` first."""
    serve = websockets.asyncio.server.serve

    def guarded_serve(*args, process_request: ProcessRequest, **options):
        return serve(*args, process_request=door.guard(process_request), **options)

    with _one_server_at_a_time:
        websockets.asyncio.server.serve = guarded_serve
        try:
            yield
        finally:
            websockets.asyncio.server.serve = serve
