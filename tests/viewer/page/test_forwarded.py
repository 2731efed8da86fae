"""What proxies tell of who asked them, and which of that is believed."""

import pytest
from websockets import Headers

from modeviz.errors import ModevizError
from modeviz.viewer.page.wire.forwarded import NO_PROXIES, proxies_at

OURS, THEIRS, STRANGER = "127.0.0.1", "10.1.2.3", "203.0.113.9"


@pytest.fixture
def believed():
    return proxies_at([OURS, "10.0.0.0/8", "fd00::/8"])


def headers(*lines):
    return Headers(lines)


def test_who_is_no_proxy_is_not_believed(believed):
    told = headers(
        ("X-Forwarded-For", "198.51.100.1"),
        ("X-Forwarded-Host", "tool.example.com"),
        ("X-Forwarded-Proto", "https"),
    )
    for proxies, peer in ((NO_PROXIES, OURS), (believed, STRANGER)):
        asked = proxies.asked(peer, told)
        assert (asked.client, asked.host, asked.is_secure) == (peer, None, False)
    asked = believed.asked(OURS, told)
    assert (asked.client, asked.host) == ("198.51.100.1", "tool.example.com")
    assert asked.is_secure


@pytest.mark.parametrize(
    ("told", "client"),
    [
        ([STRANGER], STRANGER),
        ([f"1.2.3.4, {STRANGER}"], STRANGER),  # which the client has written itself
        ([f"1.2.3.4, {STRANGER}, {THEIRS}"], STRANGER),
        (["1.2.3.4", f"{STRANGER},{THEIRS}"], STRANGER),
        ([f"{STRANGER}:4711"], STRANGER),
        (["[2001:db8::7]:443"], "2001:db8::7"),
        (["2001:db8::7, fd00::1"], "2001:db8::7"),
        ([f"::ffff:{STRANGER}"], STRANGER),
        ([THEIRS], THEIRS),
        ([f"{STRANGER}, unknown, {THEIRS}"], THEIRS),  # who knows whose
        (["", ","], OURS),
        (["a" * 10_000], OURS),
        ([], OURS),
    ],
)
def test_a_client_is_the_last_that_is_no_proxy(believed, told, client):
    lines = [("X-Forwarded-For", line) for line in told]
    assert believed.asked(OURS, headers(*lines)).client == client


def test_what_proxies_pass_on_as_a_client_wrote_it_is_not_believed(believed):
    told = headers(("Forwarded", f"for={STRANGER};host=tool.example.com;proto=https"))
    asked = believed.asked(OURS, told)
    assert (asked.client, asked.host, asked.is_secure) == (OURS, None, False)


def test_a_proxy_is_the_same_under_its_old_address_in_the_new_kind(believed):
    assert believed.trusts("::ffff:127.0.0.1")
    assert believed.trusts("::ffff:10.9.9.9")
    assert not believed.trusts("::ffff:203.0.113.9")
    assert not believed.trusts("no address")


@pytest.mark.parametrize("wrong", ["nginx", "10.0.0.1/8", "10.0.0.0/99", "", "http://10.0.0.1"])
def test_a_proxy_that_is_no_address_is_refused(wrong):
    with pytest.raises(ModevizError, match=r"^--trust-proxy: found '.*', expected an address such as"):
        proxies_at([OURS, wrong])
