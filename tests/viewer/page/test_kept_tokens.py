"""The files in which tokens are kept for a user."""

import os
import stat

import pytest

from modeviz.viewer.page.doors.kept_tokens import LIFE_S, KeptToken, kept_token, kept_tokens

DAY = 86400.0


class Clock:
    """Tells the time that it was set to."""

    now = 1_000_000_000.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def kept(tmp_path, clock):
    return KeptToken(tmp_path / "modeviz" / "tokens" / "ab", ("/truck",), clock)


def test_a_token_stays_the_same_and_nobody_else_reads_it(kept):
    token = kept.token()
    assert len(token) > 40
    assert kept.token() == token == KeptToken(kept.path, kept.opens, kept.clock).token()
    assert stat.S_IMODE(kept.path.stat().st_mode) == 0o600
    assert stat.S_IMODE(kept.path.parent.stat().st_mode) == 0o700
    assert list(kept.path.parent.iterdir()) == [kept.path]


def test_its_life_ends_a_while_after_it_was_last_asked_for(kept, clock):
    token = kept.token()
    for _ in range(10):
        clock.now += 0.9 * LIFE_S
        assert kept.token() == token
    clock.now += 1.1 * LIFE_S
    assert kept.held() is None
    assert kept.token() != token


def test_looking_at_a_token_does_not_lengthen_its_life(kept, clock):
    kept.token()
    clock.now += 20 * DAY
    assert kept.held()
    assert kept.age() == pytest.approx(20 * DAY)
    kept.token()
    assert kept.age() == pytest.approx(0.0)


def test_a_clock_that_is_set_back_ends_no_token_and_makes_none_immortal(kept, clock):
    token = kept.token()
    clock.now -= 400 * DAY
    assert kept.token() == token
    clock.now += 1.1 * LIFE_S
    assert kept.token() != token


def test_a_token_that_others_could_read_or_that_is_none_is_replaced(kept, tmp_path):
    tokens = [kept.token()]
    kept.path.chmod(0o644)
    tokens.append(kept.token())
    kept.path.write_text("short\n")
    tokens.append(kept.token())
    kept.path.unlink()
    (tmp_path / "elsewhere").write_text("of-another-place-1")
    (tmp_path / "elsewhere").chmod(0o600)
    kept.path.symlink_to(tmp_path / "elsewhere")
    tokens.append(kept.token())
    kept.path.unlink()
    os.mkfifo(kept.path, 0o600)  # from which nothing ever comes
    tokens.append(kept.token())
    assert len(set(tokens)) == 5
    assert all(len(token) > 40 for token in tokens)


def test_a_token_in_a_place_that_can_no_longer_be_written_still_holds(kept, clock, monkeypatch):
    token = kept.token()
    clock.now += 2 * DAY

    def read_only(*_):
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(os, "utime", read_only)
    assert kept.token() == token


def test_tokens_are_listed_with_what_they_open_and_those_that_have_ended_deleted(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert list(kept_tokens()) == []
    truck, cabin = kept_token([tmp_path / "truck"]), kept_token([tmp_path / "a", tmp_path / "b"])
    tokens = {truck.token(), cabin.token()}
    found = list(kept_tokens())
    assert {kept.held() for kept in found} == tokens
    assert {kept.opens for kept in found} == {truck.opens, (str(tmp_path / "a"), str(tmp_path / "b"))}
    ended = os.stat(cabin.path).st_mtime - 1.1 * LIFE_S
    os.utime(cabin.path, (ended, ended))
    assert [kept.path for kept in kept_tokens()] == [truck.path]
    assert not cabin.path.exists()


def test_a_place_for_what_a_program_remembers_is_a_whole_path(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    for chosen in ("", "a/b"):
        monkeypatch.setenv("XDG_STATE_HOME", chosen)
        assert kept_token([]).path.is_relative_to(tmp_path)
