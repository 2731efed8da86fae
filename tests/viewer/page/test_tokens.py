import pytest

from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.kept_tokens import kept_token
from modeviz.viewer.page.doors.secret import chosen_secret
from modeviz.viewer.page.doors.tokens import checked_token, is_equal

GIVEN, OF_FILE, OF_ENVIRONMENT = "given-on-the-line", "read-from-the-file", "found-outside-of-it"


def chosen_token(token, file, is_wanted=True, what=(), tell=pytest.fail):
    secret = chosen_secret(token, file, is_wanted, what, tell)
    return secret and secret.token


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "token"
    path.write_text(f"{OF_FILE}\r\n", encoding="utf-8-sig")
    return path


def test_a_token_is_the_one_given_or_of_the_file_or_of_the_environment(monkeypatch, file):
    monkeypatch.setenv("MODEVIZ_TOKEN", OF_ENVIRONMENT)
    assert chosen_token(GIVEN, None) == GIVEN
    assert chosen_token(None, file) == OF_FILE
    assert chosen_token(None, None) == OF_ENVIRONMENT
    assert chosen_token(None, None, False) is None


def test_without_any_there_is_one_that_is_kept_for_what_is_shown(monkeypatch, tmp_path):
    monkeypatch.delenv("MODEVIZ_TOKEN", raising=False)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    truck, cabin = ([tmp_path / name] for name in ("truck", "cabin"))
    token = chosen_token(None, None, what=truck)
    assert len(checked_token(token, "token")) > 30
    assert chosen_token(None, None, what=truck) == token == kept_token(truck).held()
    assert chosen_token(None, None, what=cabin) != token


def test_where_none_can_be_kept_it_is_a_new_one_each_time_and_said(monkeypatch, tmp_path):
    monkeypatch.delenv("MODEVIZ_TOKEN", raising=False)
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "file"))
    said = []
    tokens = {chosen_token(None, None, tell=said.append) for _ in range(10)}
    assert len(tokens) == 10
    assert "cannot be kept" in said[0]
    assert "Not a directory" in said[0]


@pytest.mark.parametrize("token", ["", "short", "a" * 11, "a" * 300, "a b c d e f g h", "ä" * 20])
def test_a_token_that_is_short_or_does_not_go_into_a_link_is_refused(monkeypatch, tmp_path, token):
    with pytest.raises(ModevizError, match=r"^--token: "):
        chosen_token(token, None)
    file = tmp_path / "token"
    file.write_text(token, encoding="utf-8")
    with pytest.raises(ModevizError, match=r"^--token-file .*: "):
        chosen_token(None, file)
    if token:
        monkeypatch.setenv("MODEVIZ_TOKEN", token)
        with pytest.raises(ModevizError, match=r"^MODEVIZ_TOKEN: "):
            chosen_token(None, None)


def test_a_file_that_cannot_be_read_is_an_error_that_says_so(tmp_path):
    with pytest.raises(ModevizError, match="No such file"):
        chosen_token(None, tmp_path / "nothing")
    large = tmp_path / "large"
    large.write_bytes(b"\xff" * 10_000_000)
    with pytest.raises(ModevizError, match="not text"):
        chosen_token(None, large)


def test_tokens_that_are_no_ascii_or_no_text_are_merely_not_equal():
    for given in ("é", "\udcff\udce9", "", GIVEN + "x"):
        assert not is_equal(given, GIVEN)
    assert is_equal(GIVEN, GIVEN)
