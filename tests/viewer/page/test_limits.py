import pytest

from modeviz.viewer.page.wire.limits import Allowance, Places, client_of, most_connections


def test_one_client_takes_only_some_of_the_places_and_all_no_more_than_there_are():
    places = Places(most=3, most_of_one=2)
    assert [places.take("a") for _ in range(3)] == [True, True, False]
    assert [places.take("b") for _ in range(2)] == [True, False]
    places.leave("a")
    assert places.is_free("b")
    assert places.take("b")
    assert not places.is_free("c")


def test_an_allowance_is_kept_up_to_its_bound_and_then_has_to_be_waited_for():
    now = [0.0]
    allowance = Allowance(10.0, 5.0, lambda: now[0])
    assert [allowance.take() for _ in range(6)] == [0.0] * 5 + [pytest.approx(0.1)]
    now[0] = 100.0
    assert [allowance.take() for _ in range(5)] == [0.0] * 5
    assert allowance.take(3.0) == pytest.approx(0.3)


def test_over_a_long_time_there_is_no_more_than_the_rate_allows():
    now, n = [0.0], 0
    allowance = Allowance(100.0, 300.0, lambda: now[0])
    while now[0] < 60.0:
        now[0] += allowance.take()
        n += 1
    assert n == pytest.approx(300 + 60 * 100, abs=2)


@pytest.mark.parametrize(
    ("address", "client"),
    [
        ("192.0.2.7", "192.0.2.7"),
        ("::1", "::1"),
        ("::ffff:192.0.2.7", "192.0.2.7"),
        ("2001:db8:1:2:3:4:5:6", "2001:db8:1:2::/64"),
        ("fe80::1%eth0", "fe80::/64"),
        ("", "a client"),
    ],
)
def test_a_client_is_an_address_or_the_network_one_has_in_ipv6(address, client):
    assert client_of(address) == client


def test_there_are_files_left_when_all_connections_are_there(monkeypatch):
    for n_files, expected in ((1024, 400), (256, 156), (64, 10)):
        monkeypatch.setattr("resource.getrlimit", lambda _, n=n_files: (n, n))
        assert most_connections() == expected
