"""Changes that wait for a disk: fewer of them come to the same."""

import random
import sqlite3
from contextlib import closing

import pytest
from journal_studies import KEY, VEHICLE, change

from modeviz.journal import compaction, sessions
from modeviz.journal.compaction import MERGED, compacted
from modeviz.journal.schema import create


def random_changes(chance, n):
    """What a session may accept from its beginning, as `History` does."""
    value, past, future, last = 0, [], [], ""
    for number in range(n):
        kinds = ["step"] * 3 + ["longer", "back"] * (last in ("step", "longer"))
        kinds += ["undo"] * 2 * bool(past) + ["redo"] * 2 * bool(future)
        last = chance.choice(kinds)
        new = 1000 + number
        if last == "undo":
            future.append(past.pop())
            before, after = future[-1]
        elif last == "redo":
            past.append(future.pop())
            before, after = past[-1]
        elif last == "back":
            before, after = past.pop()[0], value
        else:
            first = past.pop()[0] if last == "longer" else value
            past.append((first, new))
            future.clear()
            before, after = past[-1]
        yield change(before, after, last)
        value = before if last in ("undo", "back") else after


def left_by(before, waiting):
    """The session that changes leave."""
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as connection:
        create(connection, "Truck", 0.0)
        sessions.begin(connection, KEY, VEHICLE, "Ada", "", 0.0)
        for each in (*before, *waiting):
            sessions.record(connection, KEY, each, 0.0)
        session = sessions.restore(connection, KEY)
    assert session
    return session.past, session.future, session.state, session.tuning


@pytest.mark.parametrize("seed", range(400))
def test_as_much_can_be_undone_and_redone_after_fewer_changes(seed):
    chance = random.Random(seed)
    every = [*random_changes(chance, 30)]
    n_written = chance.randrange(20)
    before, waiting = every[:n_written], every[n_written:]
    fewer = compacted(waiting)
    assert len(fewer) < len(waiting)
    assert left_by(before, fewer) == left_by(before, waiting)


def test_a_step_that_was_taken_back_still_ends_what_could_be_redone():
    """So that a step which was written before cannot be redone after it."""
    waiting = [change(0, 1, "undo"), change(0, 2), change(0, 2, "back")]
    assert not left_by([change(0, 1)], waiting)[1]
    assert not left_by([change(0, 1)], compacted(waiting))[1]
    undone = [change(0, 1), change(0, 1, "undo")]
    assert not left_by(undone, compacted(waiting[1:]))[1]


def test_the_end_of_a_drag_that_leads_back_takes_the_step_from_the_file():
    drag = [change(0, 2, "longer"), change(0, 2, "back")]
    assert left_by([change(0, 1)], compacted(drag)) == left_by([change(0, 1)], drag)
    assert compacted(drag) == tuple(drag[1:])


@pytest.mark.parametrize("seed", range(3))
def test_however_many_changes_wait_a_bounded_number_is_kept(monkeypatch, seed):
    monkeypatch.setattr(compaction, "LONGEST", 20)
    chance, kept = random.Random(seed), ()
    for each in random_changes(chance, 3000):
        kept = compacted((*kept, each)) if len(kept) > 100 else (*kept, each)
    assert len(kept) <= 101


def test_steps_after_one_that_was_taken_back_are_one_too(monkeypatch):
    monkeypatch.setattr(compaction, "LONGEST", 2)
    back = [change(0, 1, "undo"), change(0, 2), change(0, 2, "back")]
    kept = compacted([*back, *(change(i, i + 1) for i in range(9))])
    assert kept[:3] == tuple(back)
    assert [each.before for each in kept[3:]] == ["state 0", "state 7", "state 8"]


def test_steps_that_nobody_can_undo_any_more_are_one_from_the_first_to_the_last(monkeypatch):
    monkeypatch.setattr(compaction, "LONGEST", 2)
    merged, *rest = compacted([change(i, i + 1, author="Ada") for i in range(5)])
    assert (merged.before, merged.after, merged.title) == ("state 0", "state 3", MERGED)
    (difference,) = merged.differences
    assert (difference.before, difference.after) == ("0 N/mm", "3 N/mm")
    assert rest == [change(3, 4), change(4, 5)]
