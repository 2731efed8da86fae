"""Time left: a straight line through what has been done so far."""

import pytest

from modeviz.text.time_left import TimeLeft


def told(*steps):
    """What is said last of (time, fraction done)."""
    clock = iter([time for time, _ in steps])
    left = TimeLeft(lambda: next(clock))
    return [left.words(done) for _, done in steps][-1]


@pytest.mark.parametrize(
    ("steps", "words"),
    [
        ([(100.0, 0.0), (110.0, 0.25)], "30 s left"),
        ([(100.0, 0.5), (110.0, 0.75)], "10 s left"),
        ([(0.0, 0.0), (60.0, 0.25)], "3 min left"),
        ([(0.0, 0.0), (5.0, 0.1), (10.0, 0.5)], "10 s left"),
    ],
)
def test_what_is_left_takes_as_long_as_as_much_took_before(steps, words):
    assert told(*steps) == words


@pytest.mark.parametrize(
    "steps",
    [
        [(0.0, 0.0)],
        [(0.0, 0.0), (0.5, 0.1)],
        [(0.0, 0.0), (10.0, 0.0)],
        [(0.0, 0.2), (10.0, 0.9), (11.0, 0.95)],
    ],
    ids=["begun", "too early to tell", "stuck", "nearly done"],
)
def test_nothing_is_said_where_nobody_knows_or_it_is_soon_over(steps):
    assert told(*steps) == ""


def test_each_thing_has_its_own_time(monkeypatch):
    from modeviz.cli import terminal

    said = []
    monkeypatch.setattr(terminal, "say", said.append)
    clock = iter([0.0, 10.0, 20.0, 24.0])
    monkeypatch.setattr(terminal, "TimeLeft", lambda: TimeLeft(lambda: next(clock)))
    tell = terminal.Teller()
    for what, done in (("preparing", 0.0), ("preparing", 0.5), ("drawing", 0.0), ("drawing", 0.5)):
        tell(what, done)
    assert said == [
        "preparing   0%",
        "preparing  50%, 10 s left",
        "drawing   0%",
        "drawing  50%, 4 s left",
    ]
