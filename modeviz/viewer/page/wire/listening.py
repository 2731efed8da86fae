"""The socket that has a server's address."""

import errno
import socket

from modeviz.errors import ModevizError


def listening_socket(host: str, port: int) -> socket.socket:
    """Return a socket that has an address, and does not listen yet.

    Raises:
        ModevizError: the port is in use, or the address is not this machine's.
    """
    try:
        family, kind, _, _, address = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        listening = socket.socket(family, kind)
    except OSError as error:
        raise _refused(host, port, error) from None
    try:
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listening.setblocking(False)
        listening.bind(address)
    except OSError as error:
        listening.close()
        raise _refused(host, port, error) from None
    return listening


def _refused(host: str, port: int, error: OSError) -> ModevizError:
    if error.errno == errno.EADDRINUSE:
        return ModevizError(f"port {port} of {host} is in use: choose another with --port")
    return ModevizError(f"cannot listen on port {port} of {host}: {error.strerror}")
