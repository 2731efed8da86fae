"""The limits that all connections to an address share, whichever session they are of."""

from dataclasses import dataclass, field

from modeviz.viewer.page.wire.forwarded import NO_PROXIES, Proxies
from modeviz.viewer.page.wire.limits import Allowance, Places, most_connections
from modeviz.viewer.page.wire.notices import Notices

MOST_OF_ONE = 200
"""Connections of one client: a browser opens six for a page, and colleagues may share a proxy."""

MOST_PAGES, MOST_PAGES_OF_ONE = 100, 60

OPENINGS_PER_S, MOST_OPENINGS = 5.0, 20.0
"""Pages that are sent the whole scene."""


@dataclass
class House:
    """Places for connections and pages, and who is told of those that go too far."""

    notices: Notices
    proxies: Proxies = NO_PROXIES
    """Whose connections are those of many clients."""
    arrivals: Places = field(default_factory=lambda: Places(most_connections(), MOST_OF_ONE))
    """Of connections that have not said yet what they want."""
    connections: Places = field(default_factory=lambda: Places(most_connections(), MOST_OF_ONE))
    pages: Places = field(default_factory=lambda: Places(MOST_PAGES, MOST_PAGES_OF_ONE))
    openings: Allowance = field(default_factory=lambda: Allowance(OPENINGS_PER_S, MOST_OPENINGS))
