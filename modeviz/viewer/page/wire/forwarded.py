"""Proxies before the server: which are believed, and what these tell of who asked them.

Forwarded (RFC 7239) is not read: a proxy that writes the headers X-Forwarded-… passes that on as its
client wrote it.
"""

import ipaddress
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from ipaddress import IPv4Address, IPv4Network, IPv6Address, IPv6Network

from websockets import Headers

from modeviz.errors import ModevizError

Address = IPv4Address | IPv6Address

HOP = re.compile(r"\[([0-9a-f:.]+)\](?::\d+)?|(\d+\.\d+\.\d+\.\d+):\d+", re.ASCII | re.IGNORECASE)
"""An address in X-Forwarded-For as some proxies write it: with its port."""


@dataclass(frozen=True)
class Asked:
    """Who asks, and where; as the nearest proxy tells it, if it is believed."""

    client: str
    """An address."""
    host: str | None
    """In place of the header Host."""
    is_secure: bool
    """Whether it came by TLS."""


@dataclass(frozen=True)
class Proxies:
    """Those that are believed."""

    networks: tuple[IPv4Network | IPv6Network, ...] = ()

    def trusts(self, address: str) -> bool:
        """Whether a client's address is of one of them."""
        found = _address(address)
        return found is not None and any(found in network for network in self.networks)

    def asked(self, peer: str, headers: Headers) -> Asked:
        """Return who asks in truth.

        Whoever asks a proxy can write headers, too: of the addresses in X-Forwarded-For, to which each
        proxy adds the one that asked it, the last counts that is none of a proxy that is believed.

        Args:
            peer: the address of who is connected.
            headers: of the request.
        """
        if not self.trusts(peer):
            return Asked(peer, None, False)
        client = peer
        for hop in reversed(_listed(headers, "X-Forwarded-For")):
            address = _address(hop)
            if address is None:
                break
            client = str(address)
            if not self.trusts(client):
                break
        host = _listed(headers, "X-Forwarded-Host")[-1:]
        scheme = _listed(headers, "X-Forwarded-Proto")[-1:]
        return Asked(client, host[0] if host else None, scheme == ["https"])


NO_PROXIES = Proxies()
"""None is believed."""


def proxies_at(addresses: Sequence[str]) -> Proxies:
    """Return proxies at addresses such as 127.0.0.1, or in networks such as 10.0.0.0/8.

    Raises:
        ModevizError: one is none.
    """
    try:
        return Proxies(tuple(ipaddress.ip_network(address) for address in addresses))
    except ValueError:
        wrong = next(filter(_is_no_network, addresses))
        raise ModevizError(
            f"--trust-proxy: found {wrong!r}, expected an address such as 127.0.0.1, or a network such "
            "as 10.0.0.0/8"
        ) from None


def _is_no_network(address: str) -> bool:
    try:
        ipaddress.ip_network(address)
    except ValueError:
        return True
    return False


def _listed(headers: Headers, name: str) -> list[str]:
    """The values of a header that has several, in the order in which they were added."""
    return list(_values(headers.get_all(name)))


def _values(lines: list[str]) -> Iterator[str]:
    for line in lines:
        yield from filter(None, map(str.strip, line.split(",")))


def _address(text: str) -> Address | None:
    if match := HOP.fullmatch(text):
        text = match[1] or match[2]
    try:
        found = ipaddress.ip_address(text.partition("%")[0])
    except ValueError:
        return None
    return getattr(found, "ipv4_mapped", None) or found
