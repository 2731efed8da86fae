import pytest

from modeviz.errors import ModevizError
from modeviz.viewer.page.tokens import (
    DELAY,
    FREE_GUESSES,
    LOCKED_S,
    MOST_CLIENTS,
    MOST_GUESSES,
    Guesses,
    checked_token,
    chosen_token,
    is_equal,
)

GIVEN, OF_FILE, OF_ENVIRONMENT = "given-on-the-line", "read-from-the-file", "found-outside-of-it"


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "token"
    path.write_text(f"{OF_FILE}\r\n", encoding="utf-8-sig")
    return path


def test_a_token_is_the_one_given_or_of_the_file_or_of_the_environment(monkeypatch, file):
    monkeypatch.setenv("MODEVIZ_TOKEN", OF_ENVIRONMENT)
    assert chosen_token(GIVEN, None, True) == GIVEN
    assert chosen_token(None, file, True) == OF_FILE
    assert chosen_token(None, None, True) == OF_ENVIRONMENT
    assert chosen_token(None, None, False) is None


def test_without_any_there_is_a_new_one_each_time(monkeypatch):
    monkeypatch.delenv("MODEVIZ_TOKEN", raising=False)
    tokens = {chosen_token(None, None, True) for _ in range(10)}
    assert len(tokens) == 10
    for token in tokens:
        assert len(checked_token(token, "token")) > 30


@pytest.mark.parametrize("token", ["", "short", "a" * 11, "a" * 300, "a b c d e f g h", "ä" * 20])
def test_a_token_that_is_short_or_does_not_go_into_a_link_is_refused(monkeypatch, tmp_path, token):
    with pytest.raises(ModevizError, match=r"^--token: "):
        chosen_token(token, None, True)
    file = tmp_path / "token"
    file.write_text(token, encoding="utf-8")
    with pytest.raises(ModevizError, match=r"^--token-file .*: "):
        chosen_token(None, file, True)
    if token:
        monkeypatch.setenv("MODEVIZ_TOKEN", token)
        with pytest.raises(ModevizError, match=r"^MODEVIZ_TOKEN: "):
            chosen_token(None, None, True)


def test_a_file_that_cannot_be_read_is_an_error_that_says_so(tmp_path):
    with pytest.raises(ModevizError, match="No such file"):
        chosen_token(None, tmp_path / "nothing", True)
    large = tmp_path / "large"
    large.write_bytes(b"\xff" * 10_000_000)
    with pytest.raises(ModevizError, match="not text"):
        chosen_token(None, large, True)


def test_tokens_that_are_no_ascii_or_no_text_are_merely_not_equal():
    for given in ("é", "\udcff\udce9", "", GIVEN + "x"):
        assert not is_equal(given, GIVEN)
    assert is_equal(GIVEN, GIVEN)


def test_who_guesses_waits_and_is_locked_out_and_others_are_not():
    now = [0.0]
    guesses = Guesses(lambda: now[0])
    delays = []
    for _ in range(MOST_GUESSES):
        assert not guesses.locked("a")
        delays.append(guesses.delay("a"))
        guesses.note("a")
    assert delays == [0.0] * FREE_GUESSES + [DELAY] * (MOST_GUESSES - FREE_GUESSES)
    assert guesses.locked("a") == LOCKED_S
    assert not guesses.locked("b")
    now[0] = LOCKED_S + 1
    assert not guesses.locked("a")


def test_the_right_token_makes_wrong_ones_forgotten():
    guesses = Guesses()
    for _ in range(3 * MOST_GUESSES):
        guesses.note("a")
        guesses.forget("a")
    assert not guesses.locked("a")


def test_few_clients_are_remembered():
    guesses = Guesses()
    clients = [f"client {i}" for i in range(3 * MOST_CLIENTS)]
    for i, client in enumerate(clients):
        for _ in range(MOST_GUESSES if i % 2 else 1):
            guesses.note(client)
    remembered = [client for client in clients if guesses.locked(client)]
    assert 0 < len(remembered) <= MOST_CLIENTS
    assert guesses.locked(clients[-1])
