"""The link that opens a page: an address under which a browser reaches the server."""

import socket

EVERYWHERE = {
    "0.0.0.0": (socket.AF_INET, "192.0.2.1"),
    "": (socket.AF_INET, "192.0.2.1"),
    "::": (socket.AF_INET6, "2001:db8::1"),
}
"""Addresses that mean all of this machine's, and of each kind one that nobody has."""


def local_link(host: str, port: int, token: str | None, prefix: str = "") -> str:
    """The address of the page for a browser of this machine; ready for `&name=value`."""
    family, _ = EVERYWHERE.get(host, (None, ""))
    here = {socket.AF_INET: "127.0.0.1", socket.AF_INET6: "::1", None: host}[family]
    return f"{_site(here, port)}{prefix}/?token={token or ''}"


def link(host: str, port: int, token: str | None, prefix: str = "") -> str:
    """Return the address for everybody who can reach a server that listens on `host`."""
    query = f"?token={token}" if token else ""
    return f"{_site(_reachable(host), port)}{prefix}/{query}"


def _site(host: str, port: int) -> str:
    bracketed = f"[{host}]" if ":" in host else host
    return f"http://{bracketed}:{port}"


def _reachable(host: str) -> str:
    """An address of this machine under which others reach it, if `host` means all of its addresses."""
    if host not in EVERYWHERE:
        return host
    family, elsewhere = EVERYWHERE[host]
    try:
        with socket.socket(family, socket.SOCK_DGRAM) as asked:
            asked.connect((elsewhere, 9))  # sends nothing, but finds the way
            return asked.getsockname()[0]
    except OSError:
        return "::1" if family == socket.AF_INET6 else socket.gethostname()
