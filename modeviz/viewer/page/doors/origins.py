"""Where requests come from: whether under a name of this server, and from a page of its own."""

import ipaddress
import re
import socket
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlsplit

from websockets.http11 import Request

from modeviz.viewer.page.doors.surroundings import Surroundings
from modeviz.viewer.page.wire.request_head import is_websocket

LOOPBACK = ("127.0.0.1", "localhost", "::1")
REFUSED_PARAMETERS = ("websocket", "playbackPath")
"""In a link they make the page load a scene, with its scripts, from somewhere else."""

HOST = re.compile(r"(?:\[([0-9a-f:.]+)\]|([\w.-]+))(?::\d+)?", re.ASCII | re.IGNORECASE)
"""A Host header: an IPv6 address in brackets or a name, and a port."""


@dataclass(frozen=True)
class Origins:
    """Tells requests that come to this server under its names, from its own pages."""

    host: str
    """The address the server is bound to."""
    around: Surroundings
    is_any_name: bool
    """Whether it takes any name for its own, as behind a notebook's server."""

    def refusal(self, request: Request) -> str | None:
        """Return why a request of or for another site is refused, None for a good one."""
        hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
        if len(hosts) != 1 or not self._is_known(hosts[0]):
            name = ", ".join(hosts)
            return f"{name} is not a name of this server: if it should be, start it with --public-name"
        if (origins or is_websocket(request)) and not self._is_same_site(origins, hosts[0]):
            return (
                "a page of another site may not use this server: this one is at "
                f"{', '.join(origins) or 'no address'}, and the server is asked as {hosts[0]}; "
                "a proxy between them has to pass the header Host on, or with --trust-proxy "
                "X-Forwarded-Host"
            )
        for name, _ in parse_qsl(urlsplit(request.path).query, keep_blank_values=True):
            if name in REFUSED_PARAMETERS:
                return f"the parameter {name!r} is refused"
        return None

    def _is_known(self, host: str) -> bool:
        """Whether a Host header names this server, so that no foreign name was pointed at it.

        An address cannot be pointed anywhere else, so any will do on a server that is open to others.
        """
        match = HOST.fullmatch(host)
        if match is None:
            return False
        name = (match[1] or match[2]).lower()
        if name in self.around.public_names or self.is_any_name:
            return True
        if name in LOOPBACK or self.host in LOOPBACK:
            return name in LOOPBACK
        return name in (self.host, socket.gethostname().lower()) or _is_address(name)

    def _is_same_site(self, origins: list[str], host: str) -> bool:
        """Whether a request is of a page of the host that it asks, or of a public name of it."""
        if len(origins) != 1:
            return False
        scheme, _, site = origins[0].lower().partition("://")
        if scheme not in ("http", "https"):
            return False
        match = HOST.fullmatch(site)
        is_public = match is not None and (match[1] or match[2]) in self.around.public_names
        return site == host.lower() or is_public


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
