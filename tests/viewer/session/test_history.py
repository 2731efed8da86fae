import pytest

from modeviz.viewer.session import history
from modeviz.viewer.session.history import History


@pytest.fixture
def clock(monkeypatch):
    """The time that a history sees, to be set."""
    now = [0.0]
    monkeypatch.setattr(history.time, "monotonic", lambda: now[0])
    return now


def test_what_is_undone_comes_back_until_something_else_is_done():
    values = History(1)
    values.put(2)
    values.put(3)
    assert values.undo()
    assert values.undo()
    assert values.value == 1
    assert not values.undo()
    assert values.redo()
    assert values.value == 2
    values.put(9)
    assert not values.can_redo
    assert values.undo()
    assert values.value == 2


def test_many_quick_changes_of_one_kind_are_undone_together(clock):
    values = History(0)
    for value in range(1, 6):
        clock[0] += 0.2
        values.put(value, kind="a")
    values.put(7, kind="b")
    assert values.undo()
    assert values.value == 5
    assert values.undo()
    assert values.value == 0


def test_slow_changes_of_one_kind_are_undone_one_by_one(clock):
    values = History(0)
    for value in (1, 2):
        clock[0] += 1.5
        values.put(value, kind="a")
    assert values.undo()
    assert values.value == 1


def test_a_change_right_after_an_undo_can_be_undone(clock):
    values = History(0)
    values.put(1, kind="a")
    values.put(2, kind="b")
    values.undo()
    values.put(3, kind="a")
    values.undo()
    assert values.value == 1


def test_nothing_new_is_no_step():
    values = History(1)
    values.put(1)
    assert not values.can_undo


def test_a_long_history_forgets_its_beginning():
    values = History(0)
    for value in range(1, 2 * history.LONGEST):
        values.put(value)
    steps = 0
    while values.undo():
        steps += 1
    assert steps == history.LONGEST


def test_changes_may_follow_each_other_slowly_if_that_is_said(clock):
    values = History(0)
    for value in (1, 2):
        clock[0] += 100
        values.put(value, kind="a", within=1000)
    assert values.undo()
    assert values.value == 0


def test_changes_of_one_kind_that_lead_all_the_way_back_leave_no_step(clock):
    values = History(0)
    values.put(1)
    for value in (2, 3, 1):
        values.put(value, kind="a")
    values.undo()
    assert values.value == 0
    assert not values.can_undo
