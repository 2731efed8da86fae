"""Changes that wait for a disk: fewer of them come to the same."""

import random

import pytest
from journal_studies import KEY, change, opened

from modeviz.journal import changes, compaction
from modeviz.journal.compaction import MERGED, compacted


def random_changes(chance, n, depth=0):
    """What a session may accept, as `History` does; of before it begins so many steps are there."""
    value, past, future, last = depth, [(i, i + 1) for i in range(depth)], [], ""
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


def left_by(path, before, waiting):
    """The session that changes leave, and how many there were."""
    study = opened(path)
    study.begin(KEY)
    for each in (*before, *waiting):
        study.record(KEY, each)
    session = study.restore(KEY)
    study.close()
    return session


@pytest.mark.parametrize("seed", range(12))
def test_as_much_can_be_undone_and_redone_after_fewer_changes(tmp_path, seed):
    chance = random.Random(seed)
    before = [change(i, i + 1) for i in range(4)]
    waiting = [*random_changes(chance, 60, depth=4)]
    fewer = compacted(waiting)
    every, few = (left_by(tmp_path / str(len(c)), before, c) for c in (waiting, fewer))
    assert len(fewer) < len(waiting)
    assert (few.past, few.future) == (every.past, every.future)
    assert (few.state, few.tuning) == (every.state, every.tuning)


@pytest.mark.parametrize("seed", range(3))
def test_however_many_changes_wait_a_bounded_number_is_kept(monkeypatch, seed):
    monkeypatch.setattr(compaction, "LONGEST", 20)
    chance, kept = random.Random(seed), ()
    for each in random_changes(chance, 3000):
        kept = compacted((*kept, each)) if len(kept) > 100 else (*kept, each)
    assert len(kept) <= 101


def test_steps_that_nobody_can_undo_any_more_are_one_from_the_first_to_the_last(monkeypatch):
    monkeypatch.setattr(compaction, "LONGEST", 2)
    merged, *rest = compacted([change(i, i + 1, author="Ada") for i in range(5)])
    assert (merged.before, merged.after, merged.title) == ("state 0", "state 3", MERGED)
    (difference,) = merged.differences
    assert (difference.before, difference.after) == ("0 N/mm", "3 N/mm")
    assert rest == [change(3, 4), change(4, 5)]
    assert changes.LONGEST == 500
