import ipaddress
import socket

import pytest

from modeviz.viewer.page.doors.links import link, local_link
from modeviz.viewer.page.server import open_server


@pytest.mark.parametrize(
    ("host", "token", "expected"),
    [
        ("127.0.0.1", None, "http://127.0.0.1:8080/"),
        ("127.0.0.1", "secret", "http://127.0.0.1:8080/?token=secret"),
        ("::1", "secret", "http://[::1]:8080/?token=secret"),
        ("tool", "secret", "http://tool:8080/?token=secret"),
    ],
)
def test_link_opens_the_address_that_is_listened_on(host, token, expected):
    assert link(host, 8080, token) == expected


def own_way(sockets):
    """A machine that has ways to the world, or none."""

    class Asked:
        def __init__(self, family, kind):
            assert kind == socket.SOCK_DGRAM
            self.family = family

        def __enter__(self):
            return self

        def __exit__(self, *_):
            pass

        def connect(self, address):
            assert ipaddress.ip_address(address[0]).is_private or "192.0.2" in address[0]
            if self.family not in sockets:
                raise OSError("Network is unreachable")

        def getsockname(self):
            return sockets[self.family], 1

    return Asked


def test_a_server_on_all_addresses_has_a_link_that_colleagues_can_open(monkeypatch):
    ways = {socket.AF_INET: "10.1.2.3", socket.AF_INET6: "2001:db8::7"}
    monkeypatch.setattr(socket, "socket", own_way(ways))
    assert link("0.0.0.0", 80, "t") == "http://10.1.2.3:80/?token=t"
    assert link("::", 80, "t") == "http://[2001:db8::7]:80/?token=t"


def test_a_machine_without_a_network_has_a_link_with_its_name(monkeypatch):
    monkeypatch.setattr(socket, "socket", own_way({}))
    monkeypatch.setattr(socket, "gethostname", lambda: "bench")
    assert link("0.0.0.0", 80, "t") == "http://bench:80/?token=t"
    assert link("::", 80, "t") == "http://[::1]:80/?token=t"


def test_a_browser_of_this_machine_needs_no_network():
    assert local_link("0.0.0.0", 80, None) == "http://127.0.0.1:80/?token="
    assert local_link("::", 80, "t") == "http://[::1]:80/?token=t"


def test_a_free_port_is_in_the_link_as_it_is():
    server = open_server(port=0)
    try:
        assert server.link == f"http://127.0.0.1:{server.get_port()}/"
        assert server.get_port() > 0
    finally:
        server.stop()
