"""Cookies that stand for a token, and what becomes of them when it changes."""

import pytest
from test_kept_tokens import Clock
from visitors import TOKEN, wait_until

from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.kept_tokens import LIFE_S
from modeviz.viewer.page.doors.secret import Secret


@pytest.fixture
def clock():
    return Clock()


def test_a_cookie_holds_for_every_server_with_that_token_until_its_life_ends(clock):
    cookie = Secret(TOKEN, clock).cookie()
    again = Secret(TOKEN, clock)
    assert again.age(cookie) == pytest.approx(0.0, abs=1.0)
    clock.now += LIFE_S - 5
    assert again.age(cookie) == pytest.approx(LIFE_S - 5, abs=1.0)
    clock.now += 10
    assert again.age(cookie) is None


def test_a_cookie_of_another_token_or_time_or_of_none_is_refused(clock):
    secret = Secret(TOKEN, clock)
    issued, signature = secret.cookie().split(".")
    other = Secret("another-token-1", clock)
    assert secret.age(other.cookie()) is None
    wrong = [
        "",
        TOKEN,
        issued,
        f"{issued}.",
        f".{signature}",
        f"{int(issued) + 1}.{signature}",
        f"0{issued}.{signature}",
        f"{issued}.{signature}x",
        f"{issued}.{signature[:-1]}",
        f"{'9' * 5000}.{signature}",
        f"\u0661.{signature}",
        "\udcff\udce9",
    ]
    assert [secret.age(cookie) for cookie in wrong] == [None] * len(wrong)


def test_a_cookie_tells_nothing_of_the_token(clock):
    cookies = [Secret(token, clock).cookie() for token in (TOKEN, TOKEN + "x", "another-token-1")]
    signatures = [cookie.partition(".")[2] for cookie in cookies]
    shared = [
        sum(a == b for a, b in zip(signatures[0], other, strict=True)) for other in signatures[1:]
    ]
    assert max(shared) < 10  # of 43; of 64 letters one is the same by chance
    assert not any(token in cookie for token in (TOKEN, "another") for cookie in cookies)


def test_a_token_that_changes_ends_old_cookies_and_is_told(tmp_path):
    file, told = tmp_path / "token", []

    def write(token):
        (tmp_path / "new").write_text(token)
        (tmp_path / "new").replace(file)

    def source():
        text = file.read_text()
        if not text:
            raise ModevizError("no token")
        return text

    write(TOKEN)
    secret = Secret(source)
    cookie = secret.cookie()
    secret.listen(lambda: told.append(secret.token))
    write("another-token-1")
    wait_until(lambda: told, 5.0)  # without anybody asking
    assert secret.age(cookie) is None
    assert not secret.is_token(TOKEN)
    assert secret.is_token("another-token-1")
    cookie = secret.cookie()
    write("")
    assert not secret.is_token("")
    assert secret.age(cookie) is None
    assert secret.age(secret.cookie()) is None
    assert secret.token is None
    write("another-token-1")
    assert secret.age(cookie) is not None
    assert told[0] == "another-token-1"


def test_a_token_whose_place_is_away_for_a_while_stays(tmp_path):
    file = tmp_path / "token"
    file.write_text(TOKEN)
    secret = Secret(file.read_text)
    file.unlink()
    assert secret.token == TOKEN
