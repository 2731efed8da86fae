"""How much there may be of what pages take: connections, messages and bytes."""

import ipaddress
import resource
import threading
import time
from collections import Counter
from collections.abc import Callable

MOST_CONNECTIONS = 400
"""In all, as far as the files a process may open allow."""

SPARE_FILES = 100
"""Open for whatever else the server does."""


class Places:
    """A bounded number of places, of which one client takes only some."""

    def __init__(self, most: int, most_of_one: int) -> None:
        """All are free.

        Args:
            most: places.
            most_of_one: of them that one client may have.
        """
        self._most, self._most_of_one = most, most_of_one
        self._lock = threading.Lock()
        self._taken: Counter[str] = Counter()

    def take(self, client: str, is_one: bool = True) -> bool:
        """Takes one; whether there was one for that client.

        Args:
            client: who takes it.
            is_one: whether it is one client, and not a proxy of many.
        """
        with self._lock:
            if not self._is_free(client, is_one):
                return False
            self._taken[client] += 1
            return True

    def leave(self, client: str) -> None:
        """Gives one back."""
        with self._lock:
            self._taken[client] -= 1
            if not self._taken[client]:
                del self._taken[client]

    def is_free(self, client: str) -> bool:
        """Whether a client would get one."""
        with self._lock:
            return self._is_free(client)

    def _is_free(self, client: str, is_one: bool = True) -> bool:
        most = self._most_of_one if is_one else self._most
        return self._taken.total() < self._most and self._taken[client] < most


class Allowance:
    """So much a second, of which what is not used is kept up to a bound."""

    def __init__(
        self, per_second: float, most: float, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Starts with all that can be kept.

        Args:
            per_second: what is added.
            most: what is kept.
            clock: tells the time, s.
        """
        self._per_second, self._most, self._clock = per_second, most, clock
        self._left, self._seen = most, clock()
        self._lock = threading.Lock()

    def take(self, amount: float = 1.0) -> float:
        """Takes some, and gives how long to wait until it is there, s; 0 if it is."""
        with self._lock:
            now = self._clock()
            self._left = min(self._left + (now - self._seen) * self._per_second, self._most) - amount
            self._seen = now
            return max(0.0, -self._left / self._per_second)

    @property
    def is_plenty(self) -> bool:
        """Whether more than half of what can be kept was there when some was last taken."""
        return self._left > self._most / 2


def most_connections() -> int:
    """Return the number of connections that there may be at once."""
    files, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return max(min(MOST_CONNECTIONS, files - SPARE_FILES), 10)


def client_of(address: str) -> str:
    """Who is counted as one: an IPv4 address, or the network of 2⁶⁴ that one has in IPv6."""
    plain = address.partition("%")[0]
    try:
        ip = ipaddress.ip_address(plain)
    except ValueError:
        return "a client"
    if isinstance(ip, ipaddress.IPv4Address) or ip.is_loopback:
        return str(ip)
    return str(ip.ipv4_mapped or ipaddress.ip_network((ip, 64), strict=False))
